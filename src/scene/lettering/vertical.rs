//! Lines from top to bottom in fonts that say nothing of them: as FreeType has it, each letter is in the
//! middle of a way that is as long as the font is high.

use harfrust::{FontFuncs, GlyphId, ShaperFont};
use skrifa::FontRef;
use skrifa::raw::TableProvider;

use super::scale::EM;

/// The way from letter to letter of a font without vertical metrics, at a size of [`EM`].
#[derive(Clone, Copy, Debug)]
pub struct EvenColumns {
    advance: i32,
}

impl EvenColumns {
    /// The way of a font; none where the font has ways of its own.
    pub fn of(font: &FontRef<'_>) -> Option<Self> {
        if font.vmtx().is_ok() {
            return None;
        }
        let height = match (font.os2(), font.hhea()) {
            (Ok(os2), _) => i64::from(os2.s_typo_ascender()) - i64::from(os2.s_typo_descender()),
            (_, Ok(hhea)) => i64::from(hhea.ascender().to_i16()) - i64::from(hhea.descender().to_i16()),
            _ => return None,
        };
        let of_em = i64::from(font.head().ok()?.units_per_em()).max(1);
        Some(Self { advance: (height * i64::from(EM) / of_em) as i32 })
    }
}

impl FontFuncs for EvenColumns {
    fn glyph_v_advance(&self, _: &ShaperFont<'_, '_>, _: GlyphId) -> i32 {
        -self.advance
    }

    fn glyph_v_origin(&self, font: &ShaperFont<'_, '_>, glyph: GlyphId) -> (i32, i32) {
        let [top, height] =
            font.glyph_extents(glyph).map_or([0; 2], |extents| [extents.y_bearing, extents.height]);
        // The height of a letter counts downwards.
        let above = self.advance.saturating_add(height) / 2;
        (font.glyph_h_advance(glyph) / 2, top.saturating_add(above))
    }
}
