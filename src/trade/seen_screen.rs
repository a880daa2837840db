//! What an eye sees of a screen of characters, beside what it ought to see.

use crate::frame::Request;
use crate::glyph::{Cell, Palette, appearance};
use crate::math::{Grid, Size};

use super::eye_filter::{EyeDistance, EyeFilter};
use super::layers::CharacterError;
use super::many_rays::MeanLight;
use super::measures::{resized, rms, shown, steps_apart};
use super::setting::cells;

/// A cell's appearance is computed in so many dots: the edges of shapes are exact.
const CELL_DOTS: Size = Size::new(2, 4);

/// A screen of the reference's characters.
#[derive(Debug)]
pub(super) struct SeenScreen {
    cells: Grid<Cell>,
    filter: EyeFilter,
    /// The light of its characters through the eye's filter, 0 to 1.
    seen: Grid<f64>,
    /// The light that they stand for through the eye's filter, 0 to 1.
    meant: Grid<f64>,
    /// How much of its characters flickers, where that is known.
    shimmer: Option<f64>,
}

impl SeenScreen {
    /// Of a picture by its light, and of the shimmer of two pictures of which the view of one is turned a
    /// little, where there are two. `None` where the picture has no characters, in whole cells.
    pub fn new(
        base: &Request,
        eye: EyeDistance,
        mean: &MeanLight,
        turned: Option<[&MeanLight; 2]>,
    ) -> Option<Self> {
        let size = cells(base)?;
        let size = Size::new(size.width * CELL_DOTS.width, size.height * CELL_DOTS.height);
        let per_cell = base.glyphs.dots_per_cell();
        let cell_aspect = base.dot_aspect * f64::from(per_cell.width) / f64::from(per_cell.height);
        let across = eye.degrees_per_cell / f64::from(CELL_DOTS.width);
        let down = eye.degrees_per_cell / cell_aspect / f64::from(CELL_DOTS.height);
        let filter = EyeFilter::new([across, down], size);
        let cells = mean.composed(base);
        let shimmer = turned.map(|turned| {
            let [still, moved] = turned.map(|mean| seen(&filter, &mean.composed(base), base.palette));
            apart(&still, &moved)
        });
        let light = resized(&mean.light, size).map(|light| shown(base.tone, *light));
        Some(Self {
            seen: seen(&filter, &cells, base.palette),
            meant: clamped(&filter.seen(&light)),
            shimmer,
            cells,
            filter,
        })
    }

    /// How much of its own characters flickers, where that is known.
    pub const fn shimmer(&self) -> Option<f64> {
        self.shimmer
    }

    /// What is seen of its own characters that is not the light that they stand for.
    pub fn shown(&self) -> f64 {
        apart(&self.seen, &self.meant)
    }

    /// How far off other characters of the same screen are; `moved` are those of the view turned a little.
    pub fn error(&self, cells: &Grid<Cell>, moved: Option<&Grid<Cell>>, palette: Palette) -> CharacterError {
        let own = seen(&self.filter, cells, palette);
        let others = cells.values().iter().zip(self.cells.values()).filter(|(own, other)| own != other);
        CharacterError {
            cells: cells.size().area(),
            others: others.count(),
            seen: apart(&own, &self.seen),
            shown: apart(&own, &self.meant),
            shimmer: moved.map(|moved| apart(&own, &seen(&self.filter, moved, palette))),
        }
    }
}

/// The light of characters as an eye sees it.
fn seen(filter: &EyeFilter, cells: &Grid<Cell>, palette: Palette) -> Grid<f64> {
    clamped(&filter.seen(&appearance(cells, palette, CELL_DOTS)))
}

/// What the eye takes away around a bright place may leave less than no light, and more than white in it.
fn clamped(light: &Grid<f64>) -> Grid<f64> {
    light.map(|light| light.clamp(0.0, 1.0))
}

fn apart(own: &Grid<f64>, other: &Grid<f64>) -> f64 {
    rms(own.values(), other.values(), steps_apart)
}
