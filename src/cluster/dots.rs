//! The dots of a share of a picture's tiles: out of a frame, through bytes, and into a frame.

use std::io::{self, Read, Write};
use std::sync::Arc;

use crate::frame::Frame;
use crate::math::{DVec3, Grid, Size};
use crate::shade::Channel;
use crate::view::TileShare;

use super::values::{self, DotValue};

/// Which values there are of each dot, beside its light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "one for each grid of a frame")]
pub struct DotChannels {
    /// The light by its three primaries, and not in gray alone.
    pub color: bool,
    /// [`Frame::depth`].
    pub depth: bool,
    /// [`Frame::normal`].
    pub normal: bool,
    /// [`Frame::object`].
    pub object: bool,
}

impl DotChannels {
    /// Those of a frame.
    pub const fn of(frame: &Frame) -> Self {
        Self {
            color: frame.color.is_some(),
            depth: frame.depth.is_some(),
            normal: frame.normal.is_some(),
            object: frame.object.is_some(),
        }
    }

    /// A frame without characters, whose dots are dark and see nothing, with room for these.
    pub(super) fn room(self, dots: Size) -> Frame {
        Frame {
            color: self.color.then(|| Arc::new(Grid::filled(dots, DVec3::ZERO))),
            depth: self.depth.then(|| Arc::new(Grid::filled(dots, f64::INFINITY))),
            normal: self.normal.then(|| Arc::new(Grid::filled(dots, DVec3::ZERO))),
            object: self.object.then(|| Arc::new(Grid::filled(dots, 0))),
            cells: None,
            ..Frame::blank(dots, Grid::from_values(Size::new(0, 0), Vec::new()))
        }
    }
}

/// The values of a share's dots, channel by channel: of its tiles in scan order, and of each tile's dots in
/// scan order. What there is none of is empty.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ShareDots {
    /// In gray, where there is no colour.
    light: Vec<f64>,
    color: Vec<DVec3>,
    depth: Vec<f64>,
    normal: Vec<DVec3>,
    object: Vec<u32>,
}

impl ShareDots {
    /// Those of a frame.
    pub fn of(frame: &Frame, share: TileShare) -> Self {
        let gray = frame.color.is_none().then_some(&frame.light);
        Self {
            light: gathered(gray, share),
            color: gathered(frame.color.as_ref(), share),
            depth: gathered(frame.depth.as_ref(), share),
            normal: gathered(frame.normal.as_ref(), share),
            object: gathered(frame.object.as_ref(), share),
        }
    }

    /// Puts them into their places in a frame that has room for all of them.
    pub fn put_into(self, frame: &mut Frame, share: TileShare) {
        if frame.color.is_some() {
            let light: Vec<f64> = self.color.iter().map(|&color| f64::from_rgb(color)).collect();
            scatter(&light, Some(&mut frame.light), share);
        }
        if !self.light.is_empty() {
            scatter(&self.light, Some(&mut frame.light), share);
        }
        scatter(&self.color, frame.color.as_mut(), share);
        scatter(&self.depth, frame.depth.as_mut(), share);
        scatter(&self.normal, frame.normal.as_mut(), share);
        scatter(&self.object, frame.object.as_mut(), share);
    }

    /// Writes them.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        values::write(&self.light, out)?;
        values::write(&self.color, out)?;
        values::write(&self.depth, out)?;
        values::write(&self.normal, out)?;
        values::write(&self.object, out)
    }

    /// Reads what [`ShareDots::write`] wrote of so many dots.
    pub fn read(dots: usize, channels: DotChannels, from: &mut impl Read) -> io::Result<Self> {
        let DotChannels { color, depth, normal, object } = channels;
        Ok(Self {
            light: read_if(!color, dots, from)?,
            color: read_if(color, dots, from)?,
            depth: read_if(depth, dots, from)?,
            normal: read_if(normal, dots, from)?,
            object: read_if(object, dots, from)?,
        })
    }
}

fn read_if<T: DotValue>(is_there: bool, dots: usize, from: &mut impl Read) -> io::Result<Vec<T>> {
    values::read(if is_there { dots } else { 0 }, from)
}

/// The values of a share's dots; none where there is no grid.
fn gathered<T: Copy>(grid: Option<&Arc<Grid<T>>>, share: TileShare) -> Vec<T> {
    let Some(grid) = grid else { return Vec::new() };
    share.tiles(grid.size()).iter().flat_map(|tile| tile.dots().map(|at| grid[at])).collect()
}

/// Sets a share's dots to these values, of which there is one for each.
fn scatter<T: Copy>(values: &[T], grid: Option<&mut Arc<Grid<T>>>, share: TileShare) {
    let Some(grid) = grid else { return };
    let grid = Arc::make_mut(grid);
    let dots = share.tiles(grid.size()).into_iter().flat_map(|tile| tile.dots());
    for (at, value) in dots.zip(values) {
        grid[at] = *value;
    }
}
