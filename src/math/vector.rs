//! Vectors of one ray or of eight.
//!
//! Sums are taken in the order in which `glam` takes them, so that a vector of one has the bits of a `DVec3`.

use std::ops::{Add, BitAnd, Div, Mul, Neg, Sub};

use super::number::{Mask, Number};
use super::{DMat3, DVec3, Ray};

/// A vector whose components are a [`Number`].
#[derive(Clone, Copy, Debug)]
pub struct Vector<N> {
    /// Along x.
    pub x: N,
    /// Along y.
    pub y: N,
    /// Along z.
    pub z: N,
}

/// One ray, or as many as a [`Number`] has.
#[derive(Clone, Copy, Debug)]
pub struct Rays<N> {
    /// Where each starts.
    pub o: Vector<N>,
    /// Where each goes; the length is 1 within rounding.
    pub d: Vector<N>,
}

impl From<&Ray> for Rays<f64> {
    #[inline(always)]
    fn from(ray: &Ray) -> Self {
        Self { o: ray.o.into(), d: ray.d.into() }
    }
}

impl From<DVec3> for Vector<f64> {
    #[inline(always)]
    fn from(v: DVec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<Vector<f64>> for DVec3 {
    #[inline(always)]
    fn from(v: Vector<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl<N: Number> Rays<N> {
    /// The point of each at its distance.
    #[inline(always)]
    pub fn at(&self, t: N) -> Vector<N> {
        self.o + self.d * t
    }
}

impl<N: Number> Vector<N> {
    /// `v` for all: as many as there are in `self`.
    #[inline(always)]
    #[must_use]
    pub fn same(self, v: DVec3) -> Self {
        Self { x: self.x.same(v.x), y: self.y.same(v.y), z: self.z.same(v.z) }
    }

    /// The component along an axis, 0 to 2.
    #[inline(always)]
    pub fn along(self, axis: usize) -> N {
        match axis {
            0 => self.x,
            1 => self.y,
            _ => self.z,
        }
    }

    /// The dot product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The dot product with one vector.
    #[inline(always)]
    pub fn dot_one(self, other: DVec3) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The cross product.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    /// The dot product with itself.
    #[inline(always)]
    pub fn length_squared(self) -> N {
        self.dot(self)
    }

    /// Its length.
    #[inline(always)]
    pub fn length(self) -> N {
        self.length_squared().root()
    }

    /// The same at length 1; where its length is 0 or not finite, `fallback`.
    #[inline(always)]
    #[must_use]
    pub fn normalized_or(self, fallback: Self) -> Self {
        let zero = self.x.same(0.0);
        let inverse = zero.same(1.0) / self.length();
        let usable = inverse.is_below(zero.same(f64::INFINITY)) & inverse.is_above(zero);
        Self::choose(usable, self * inverse, fallback)
    }

    /// The absolute values of its components.
    #[inline(always)]
    #[must_use]
    pub fn magnitude(self) -> Self {
        Self { x: self.x.magnitude(), y: self.y.magnitude(), z: self.z.magnitude() }
    }

    /// Its image under a linear map.
    #[inline(always)]
    #[must_use]
    pub fn mapped(self, map: &DMat3) -> Self {
        Self { x: self.dot_one(map.row(0)), y: self.dot_one(map.row(1)), z: self.dot_one(map.row(2)) }
    }

    /// Of each, the one where the answer is yes, the other where it is no.
    #[inline(always)]
    pub fn choose(mask: N::Mask, yes: Self, no: Self) -> Self {
        Self { x: mask.choose(yes.x, no.x), y: mask.choose(yes.y, no.y), z: mask.choose(yes.z, no.z) }
    }

    /// Whether all three components of each answer yes.
    #[inline(always)]
    pub fn all(self, question: impl Fn(N) -> N::Mask) -> N::Mask
    where
        N::Mask: BitAnd<Output = N::Mask>,
    {
        question(self.x) & question(self.y) & question(self.z)
    }
}

impl<N: Number> Add for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<N: Number> Sub for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<N: Number> Sub<DVec3> for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: DVec3) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<N: Number> Mul<N> for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: N) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl<N: Number> Div<N> for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, by: N) -> Self {
        Self { x: self.x / by, y: self.y / by, z: self.z / by }
    }
}

impl<N: Number> Neg for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}
