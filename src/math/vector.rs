//! Vectors of one ray or of eight.
//!
//! Sums are taken in the order in which `glam` takes them, so that a vector of one has the bits of a `DVec3`.

use std::ops::{Add, BitAnd, Mul, Neg, Sub};

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
        let component = |x: f64, y: f64, z: f64| self.x * x + self.y * y + self.z * z;
        Self {
            x: component(map.x_axis.x, map.y_axis.x, map.z_axis.x),
            y: component(map.x_axis.y, map.y_axis.y, map.z_axis.y),
            z: component(map.x_axis.z, map.y_axis.z, map.z_axis.z),
        }
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

impl<N: Number> Neg for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}
