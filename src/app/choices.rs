//! What the keys choose between: sets of characters and shading models.

use super::model::Model;
use super::pace::Pace;
use crate::glyph::GlyphMode;
use crate::plan::Shading;

impl Model {
    /// The sets of characters that the terminal draws, the present one among them.
    pub fn glyph_modes(&self) -> Vec<GlyphMode> {
        let now = self.settings.glyphs;
        let dotted = |glyphs| matches!(glyphs, GlyphMode::Half | GlyphMode::Quadrant);
        let coarse = |glyphs| dotted(glyphs) && !self.settings.palette.has_levels();
        let drawn =
            |&glyphs: &GlyphMode| glyphs == now || self.settings.terminal.draws(glyphs) && !coarse(glyphs);
        GlyphMode::ALL.into_iter().filter(drawn).collect()
    }

    /// The next set of characters that the terminal draws; the present one where it draws no other.
    pub fn next_glyphs(&self) -> GlyphMode {
        after(&self.glyph_modes(), self.settings.glyphs)
    }

    /// Draws at this pace from now on, and says so.
    pub fn set_pace(&mut self, pace: Pace) {
        self.pace = pace;
        let name = pace.name();
        self.told = Some(if pace.turbo {
            format!("Turbo is on: as fast as it goes; off, as a PC/AT of {name}")
        } else {
            format!("Turbo is off: dot by dot, as a PC/AT of {name}; , and . take another, F5 all at once")
        });
    }

    /// The shading model one step away, or the present one where there is none.
    pub fn shading(&self, step: impl Fn(usize, usize) -> Option<usize>) -> Shading {
        let now = self.settings.options.shading;
        let place = Shading::ALL.iter().position(|&model| model == now);
        place
            .and_then(|place| step(place, 1))
            .and_then(|place| Shading::ALL.get(place))
            .copied()
            .unwrap_or(now)
    }
}

/// The element after `now`, the first after the last.
fn after<T: Copy + PartialEq>(all: &[T], now: T) -> T {
    let next = all.iter().skip_while(|&&one| one != now).nth(1);
    next.or(all.first()).copied().unwrap_or(now)
}
