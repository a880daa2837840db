//! Numbers short enough for a panel.

/// Bytes of a kilobyte, as DOS counted them.
const KILO: f64 = 1024.0;

/// A count in at most 7 columns: digits in groups of three up to 999 999, then three digits and a unit.
pub(crate) fn count(n: u64) -> String {
    match n {
        0..1_000 => n.to_string(),
        1_000..1_000_000 => format!("{} {:03}", n / 1_000, n % 1_000),
        1_000_000..999_500_000 => format!("{} M", three_digits(n as f64 / 1e6)),
        _ => format!("{} G", three_digits(n as f64 / 1e9)),
    }
}

/// A mean per ray; absent where there was no ray.
pub(crate) fn per_ray(n: u64, rays: u64) -> Option<String> {
    let mean = (rays > 0).then(|| n as f64 / rays as f64)?;
    Some(match mean {
        // The smallest that a tenth shows: more than nothing must not read as nothing.
        mean if n > 0 && mean < 0.05 => "<0.1/ray".to_owned(),
        mean if mean < 99.95 => format!("{mean:.1}/ray"),
        mean if mean < 9_999.5 => format!("{mean:.0}/ray"),
        mean => format!("{:.0}k/ray", mean / 1e3),
    })
}

/// A number of bytes.
pub(crate) fn bytes(n: usize) -> String {
    let n = n as f64;
    if n < KILO {
        format!("{n:.0} B")
    } else if n < KILO * KILO {
        format!("{} KB", three_digits(n / KILO))
    } else {
        format!("{} MB", three_digits(n / (KILO * KILO)))
    }
}

/// Tenths below 10, whole numbers above.
fn three_digits(x: f64) -> String {
    if x < 9.95 { format!("{x:.1}") } else { format!("{x:.0}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_fit_seven_columns() {
        let shown =
            [0, 999, 1_000, 30_832, 999_999, 1_000_000, 9_960_000, 999_499_999, 1_234_567_890].map(count);
        assert_eq!(
            shown,
            ["0", "999", "1 000", "30 832", "999 999", "1.0 M", "10 M", "999 M", "1.2 G"].map(str::to_owned)
        );
        assert!(shown.iter().all(|text| text.len() <= 7));
    }

    #[test]
    fn means_are_absent_without_rays() {
        assert_eq!(per_ray(5, 0), None);
        assert_eq!(per_ray(0, 5).unwrap(), "0.0/ray");
        assert_eq!(per_ray(1, 500).unwrap(), "<0.1/ray");
        assert_eq!(per_ray(21, 10).unwrap(), "2.1/ray");
        assert_eq!(per_ray(1_234, 1).unwrap(), "1234/ray");
        assert_eq!(per_ray(12_345, 1).unwrap(), "12k/ray");
    }

    #[test]
    fn bytes_have_a_unit() {
        assert_eq!(
            [0, 1_023, 1_946, 20_480, 3 << 20].map(bytes),
            ["0 B", "1023 B", "1.9 KB", "20 KB", "3.0 MB"]
        );
    }
}
