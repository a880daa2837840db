//! Numbers that count what is computed with them.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use ray13::math::{Mask, Number, Rays, Vector};

/// A number; what is computed with any is counted, by thread.
#[derive(Clone, Copy)]
pub struct Counted(f64);

/// How many operations of each kind.
#[derive(Clone, Copy, Default)]
pub struct Operations {
    /// Sums, products, signs, comparisons and choices.
    pub simple: f64,
    pub quotients: f64,
    pub roots: f64,
}

thread_local! {
    static COUNTS: Cell<Operations> = Cell::default();
}

/// What is counted while something is done.
pub fn during(work: impl FnOnce()) -> Operations {
    COUNTS.set(Operations::default());
    work();
    COUNTS.get()
}

impl Operations {
    /// A share of them.
    pub fn over(self, count: f64) -> Self {
        let Self { simple, quotients, roots } = self;
        Self { simple: simple / count, quotients: quotients / count, roots: roots / count }
    }
}

impl Counted {
    /// A ray of such numbers.
    pub fn of(rays: &Rays<f64>) -> Rays<Self> {
        Rays { o: vector(rays.o), d: vector(rays.d) }
    }
}

fn vector(v: Vector<f64>) -> Vector<Counted> {
    Vector { x: Counted(v.x), y: Counted(v.y), z: Counted(v.z) }
}

fn simple<T>(result: T) -> T {
    let counts = COUNTS.get();
    COUNTS.set(Operations { simple: counts.simple + 1.0, ..counts });
    result
}

fn quotient(result: f64) -> Counted {
    let counts = COUNTS.get();
    COUNTS.set(Operations { quotients: counts.quotients + 1.0, ..counts });
    Counted(result)
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        simple(Self(-self.0))
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident $count:expr, $op:tt;)*) => {$(
        impl $trait for Counted {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                $count(self.0 $op other.0)
            }
        }
        impl $trait<f64> for Counted {
            type Output = Self;
            fn $name(self, other: f64) -> Self {
                $count(self.0 $op other)
            }
        }
    )*};
}
operators! {
    Add add |x| simple(Counted(x)), +;
    Sub sub |x| simple(Counted(x)), -;
    Mul mul |x| simple(Counted(x)), *;
    Div div quotient, /;
}

impl Number for Counted {
    type Mask = bool;

    fn same(self, x: f64) -> Self {
        Self(x)
    }
    fn root(self) -> Self {
        let counts = COUNTS.get();
        COUNTS.set(Operations { roots: counts.roots + 1.0, ..counts });
        Self(self.0.sqrt())
    }
    fn magnitude(self) -> Self {
        simple(Self(self.0.abs()))
    }
    fn signed_as(self, sign: Self) -> Self {
        simple(Self(self.0.copysign(sign.0)))
    }
    fn fused(self, factor: Self, term: Self) -> Self {
        simple(Self(self.0.fused(factor.0, term.0)))
    }
    fn is_below(self, other: Self) -> bool {
        simple(self.0 < other.0)
    }
    fn is_at_most(self, other: Self) -> bool {
        simple(self.0 <= other.0)
    }
    fn is_above(self, other: Self) -> bool {
        simple(self.0 > other.0)
    }
    fn is_at_least(self, other: Self) -> bool {
        simple(self.0 >= other.0)
    }
    fn is_equal(self, other: Self) -> bool {
        simple(self.0 == other.0)
    }
}

impl Mask<Counted> for bool {
    fn choose(self, yes: Counted, no: Counted) -> Counted {
        simple(if self { yes } else { no })
    }
    fn any(self) -> bool {
        self
    }
    fn bits(self) -> u64 {
        u64::from(self)
    }
}
