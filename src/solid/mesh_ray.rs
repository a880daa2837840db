//! One ray of a packet against a mesh, where triangles are so small that a packet has too many of them
//! between its rays: the triangles ahead of its start, the nearest first, by the exact predicate.

use std::ops::ControlFlow;

use crate::math::Ray;

use super::mesh::TriangleMesh;
use super::ray_shear::{ONE_PLACE, STEEP};
use super::span::End;

/// What one ray crosses first of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FirstAhead {
    /// Certainly nothing.
    Nothing,
    /// This triangle, which is in one place with no other.
    Triangle(u32),
    /// What the exact engine says.
    Uncertain,
}

/// What a ray asks of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct AheadQuery {
    /// The triangle that it leaves.
    pub leaves: Option<u32>,
    /// How far it matters, and how far that may be off.
    pub limit: [f64; 2],
    /// How far any primitive may be off its place whose surface may be one place with the mesh's, or with the
    /// ray's start.
    pub neighbour_error: f64,
}

impl AheadQuery {
    /// How many times its error a crossing may lie from what is one place with it, or with the start.
    fn room(&self, mesh: &TriangleMesh) -> f64 {
        (ONE_PLACE + 4.0) * self.neighbour_error / mesh.place_error()
    }

    /// Where a walk has to begin.
    fn from(&self) -> f64 {
        -(ONE_PLACE + 4.0) * self.neighbour_error / STEEP
    }
}

impl TriangleMesh {
    /// What a ray crosses first.
    pub fn first_ahead(&self, ray: &Ray, asked: &AheadQuery) -> FirstAhead {
        let [limit, limit_error] = asked.limit;
        let mut first: Option<(End, f64)> = None;
        let mut second = limit - limit_error;
        let are_all_apart = self.walk_ahead(ray, asked, |end, own, to| {
            if asked.leaves == Some(end.surface) {
                return ControlFlow::Continue(());
            }
            // What is not a number is not known to be apart.
            let is_apart = end.t.abs() > own;
            if !is_apart {
                return ControlFlow::Break(());
            }
            if end.t > 0.0 {
                let is_nearer = first.is_none_or(|(known, _)| end.t < known.t);
                let other = if is_nearer { first.replace((end, own)) } else { Some((end, own)) };
                second = other.map_or(second, |(other, own)| second.min(other.t - own));
                *to = first.map_or(*to, |(end, own)| end.t + own);
            }
            ControlFlow::Continue(())
        });
        match first {
            _ if !are_all_apart => FirstAhead::Uncertain,
            None => FirstAhead::Nothing,
            Some((end, own)) if end.t + own < second && self.is_steep(&end) => {
                FirstAhead::Triangle(end.surface)
            }
            Some((end, own)) if end.t - own > limit + limit_error => FirstAhead::Nothing,
            Some(_) => FirstAhead::Uncertain,
        }
    }

    /// The triangles that a ray crosses ahead of its start, in no order, and the one that it leaves, where
    /// its line passes that. False where one may lie at the start itself, or is seen edge on.
    pub fn all_ahead(&self, ray: &Ray, asked: &AheadQuery, mut found: impl FnMut(u32)) -> bool {
        self.walk_ahead(ray, asked, |end, own, _| {
            let is_left = asked.leaves == Some(end.surface);
            let is_certain = end.t.abs() > own && self.is_steep(&end);
            if !is_left && !is_certain {
                return ControlFlow::Break(());
            }
            if is_left || end.t > 0.0 {
                found(end.surface);
            }
            ControlFlow::Continue(())
        })
    }

    /// Shows each crossing of a ray's line from a little before its start on, the nearest first but for those
    /// in boxes that overlap; how far from it another may be one place with it; and up to where crossings
    /// matter, which may come nearer. False where that was broken off.
    #[inline]
    fn walk_ahead(
        &self,
        ray: &Ray,
        asked: &AheadQuery,
        mut show: impl FnMut(End, f64, &mut f64) -> ControlFlow<()>,
    ) -> bool {
        let ([limit, limit_error], room) = (asked.limit, asked.room(self));
        let mut to = limit + limit_error;
        let crossed = self.crossed_by(ray);
        let end = self.boxes().walk(ray, asked.from(), to, &mut |surface: u32, _: f64| {
            if let Some(end) = crossed(surface) {
                show(end, room * end.error, &mut to)?;
            }
            ControlFlow::Continue(to)
        });
        end.is_none()
    }

    /// The nearest crossing of a ray, but that of the triangle that it `leaves` and those that lie at its
    /// start.
    pub fn first_crossing(
        &self,
        ray: &Ray,
        leaves: Option<u32>,
        at_start: impl Fn(&End) -> bool,
    ) -> Option<End> {
        let mut first: Option<End> = None;
        let crossed = self.crossed_by(ray);
        self.boxes().walk::<()>(ray, 0.0, f64::INFINITY, &mut |surface: u32, _: f64| {
            if leaves != Some(surface)
                && let Some(end) = crossed(surface).filter(|end| !at_start(end))
                && first.is_none_or(|known| (end.t, end.surface) < (known.t, known.surface))
            {
                first = Some(end);
            }
            ControlFlow::Continue(first.map_or(f64::INFINITY, |end| end.t))
        });
        first
    }

    /// Whether a crossing lies where the ray meets the plane of the triangle, whichever way that is computed.
    fn is_steep(&self, end: &End) -> bool {
        2.0 * STEEP * end.error <= self.place_error()
    }
}
