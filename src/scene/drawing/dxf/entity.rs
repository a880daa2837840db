//! An entity of a DXF file: what its groups say.

use super::groups::DxfGroup;
use crate::math::DVec2;
use crate::scene::drawing::{DrawingFault, DrawingRequest};

/// What stands between two groups of code 0. OpenSCAD reads a code as one thing, whatever the entity: what
/// that makes of ellipses that are moved or scaled is what is printed, and so what is shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DxfEntity {
    /// What it is, such as `LINE`.
    pub name: String,
    /// The line of its name.
    pub line: usize,
    /// Code 8.
    pub layer: String,
    /// Code 2: the name of a section, or of a block.
    pub of: String,
    xs: Vec<f64>,
    ys: Vec<f64>,
    /// Code 40: a radius, or the ratio of the axes of an ellipse.
    pub radius: f64,
    /// Codes 41 and 42: the ends of an ellipse, in radians; the factors of an INSERT.
    pub pair: DVec2,
    /// Codes 50 and 51: the ends of an arc, in degrees; by how many degrees an INSERT is turned.
    pub angles: [f64; 2],
    /// Code 70: whether a polyline is closed, and more.
    pub flags: i64,
    /// Whether a polyline has a side that is an arc.
    pub has_bulge: bool,
}

impl DxfEntity {
    /// One that begins.
    pub fn new(name: impl Into<String>, line: usize) -> Self {
        let name = name.into();
        // An INSERT that says nothing of factors has none.
        let pair = if name == "INSERT" { DVec2::ONE } else { DVec2::ZERO };
        Self { name, line, pair, ..Self::default() }
    }

    /// Whether OpenSCAD makes sides of it.
    pub fn is_drawn(&self) -> bool {
        ["LINE", "LWPOLYLINE", "CIRCLE", "ARC", "ELLIPSE", "INSERT"].contains(&self.name.as_str())
    }

    /// Takes a group. Outside of blocks coordinates are moved and scaled as `request` says.
    pub fn take(
        &mut self,
        group: &DxfGroup<'_>,
        request: Option<&DrawingRequest>,
    ) -> Result<(), DrawingFault> {
        match group.code {
            2 => self.of = group.value.to_string(),
            8 => self.layer = group.value.to_string(),
            _ if !self.is_drawn() => {}
            10 | 11 => {
                let x = group.number()?;
                self.xs.push(request.map_or(x, |request| (x - request.origin.x) * request.scale));
            }
            20 | 21 => {
                let y = group.number()?;
                self.ys.push(request.map_or(y, |request| (y - request.origin.y) * request.scale));
            }
            40 => self.radius = group.number()? * request.map_or(1.0, |request| request.scale),
            41 => self.pair.x = group.number()?,
            42 => {
                self.pair.y = group.number()?;
                self.has_bulge |= self.name == "LWPOLYLINE" && self.pair.y != 0.0;
            }
            50 => self.angles[0] = group.number()?,
            51 => self.angles[1] = group.number()?,
            70 => {
                let expected = || DrawingFault::at(group.line, "a whole number is expected here");
                self.flags = group.value.parse().map_err(|_| expected())?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Its places, `least` of them or more.
    pub fn places(&self, least: usize) -> Result<Vec<DVec2>, DrawingFault> {
        if self.xs.len() != self.ys.len() || self.xs.len() < least {
            let message = format!("this {} lacks a coordinate", self.name);
            return Err(DrawingFault::at(self.line, message));
        }
        let places: Vec<DVec2> = self.xs.iter().zip(&self.ys).map(|(&x, &y)| DVec2::new(x, y)).collect();
        // What is written is finite, but not always what it is scaled to.
        if places.iter().all(|place| place.is_finite()) { Ok(places) } else { Err(self.too_far()) }
    }

    /// The error of an entity that reaches beyond all numbers.
    pub fn too_far(&self) -> DrawingFault {
        DrawingFault::at(self.line, format!("this {} reaches farther than a 64-bit float does", self.name))
    }
}
