//! What a ray from the eye met, and all that came of it, in one number to compare.

/// The faces that a ray from the eye met and that the mirror and Snell rays after it met, with the lamps that
/// each surface saw: rays of one history crossed the same faces in the same order, so that light changes
/// smoothly from one to the next (Akimoto, Mase, Suenaga: Pixel-selected ray tracing, 1991). A hash: of two
/// histories that differ, one pair in 2⁶⁴ has the same number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct History(u64);

/// An odd number whose bits are even: 2⁶⁴ over the golden ratio (Knuth: The art of computer programming 3,
/// section 6.4).
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

impl History {
    /// That of a ray that met nothing.
    pub const MISS: Self = Self(0);

    /// That of a ray that is not followed.
    pub const TRUNCATED: Self = Self(GOLDEN);

    /// That of a ray that has met a face, and nothing has come of it yet.
    #[inline]
    pub fn hit(object: u32, primitive: u32, surface: u32) -> Self {
        let face = u64::from(primitive) << 32 | u64::from(surface);
        Self(GOLDEN).with(face).with(u64::from(object))
    }

    /// After the surface has seen a lamp of which this share reaches it: 0 where it is hidden or behind.
    #[inline]
    pub fn lit(self, visible: f64) -> Self {
        self.with(visible.to_bits())
    }

    /// After the surface has sent on a ray, which had a history of its own.
    #[inline]
    pub fn sent_on(self, ray: Self) -> Self {
        self.with(ray.0)
    }

    #[inline]
    fn with(self, number: u64) -> Self {
        let mixed = (self.0.rotate_left(23) ^ number).wrapping_mul(GOLDEN);
        Self(mixed ^ mixed >> 32)
    }
}
