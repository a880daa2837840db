//! Which SIMD levels are compiled.

/// Runs `$op` with the registers of `$level`, as [`fearless_simd::dispatch`] does, compiled for fewer levels
/// where nothing is built for speed: each level is all kernels once more. With debug assertions they are the
/// baseline and AVX2, in unit tests the baseline alone. That all levels give the same is held by the suite
/// `engines`, which `.ci/run` repeats as it is released.
#[cfg(not(all(target_arch = "x86_64", not(feature = "fallback"), any(test, debug_assertions))))]
macro_rules! dispatch {
    ($level:expr, $simd:pat => $op:expr) => {
        fearless_simd::dispatch!($level, $simd => $op)
    };
}

/// As in a build for speed; above is said why it differs.
#[cfg(all(target_arch = "x86_64", not(feature = "fallback"), any(test, debug_assertions)))]
macro_rules! dispatch {
    ($level:expr, $simd:pat => $op:expr) => {{
        #[inline(always)]
        fn opaque_level<S: fearless_simd::Simd>(simd: S) -> impl fearless_simd::Simd {
            simd
        }
        let level = $level;
        match level.as_avx2() {
            #[cfg(not(test))]
            Some(token) => {
                let $simd = opaque_level(token);
                fearless_simd::Simd::vectorize(
                    token,
                    #[inline(always)]
                    || $op,
                )
            }
            _ => {
                let Some(token) = level.as_sse2() else { unreachable!("every x86-64 has SSE2") };
                let $simd = opaque_level(token);
                fearless_simd::Simd::vectorize(
                    token,
                    #[inline(always)]
                    || $op,
                )
            }
        }
    }};
}

pub(crate) use dispatch;
