//! The 13 levels in the colors of known terminals: with the attributes as a PC has them, and fitted to what
//! is there.

use std::io::{self, Write};

use ray13::glyph::{FourGrays, GlyphMode, Palette, appearance, compose};
use ray13::math::{Grid, Size};
use ray13::tone::{Level, Tone, lightness};

/// Terminals by name, with attributes 0, 8, 7 and 15 as they show them by default, and where that is written.
const TERMINALS: [(&str, [u32; 4], &str); 10] = [
    ("VGA", [0x00_0000, 0x55_5555, 0xAA_AAAA, 0xFF_FFFF], "the levels themselves"),
    ("xterm", [0x00_0000, 0x7F_7F7F, 0xE5_E5E5, 0xFF_FFFF], "XTerm-color: gray50, gray90"),
    ("PuTTY", [0x00_0000, 0x55_5555, 0xBB_BBBB, 0xFF_FFFF], "its settings, Window/Colours"),
    ("Linux console", [0x00_0000, 0x55_5555, 0xAA_AAAA, 0xFF_FFFF], "drivers/tty/vt/vt.c, default_red"),
    ("macOS Terminal", [0x00_0000, 0x66_6666, 0xBF_BFBF, 0xE5_E5E5], "Wikipedia, ANSI escape code"),
    ("Windows Terminal", [0x0C_0C0C, 0x76_7676, 0xCC_CCCC, 0xF2_F2F2], "Campbell, in its defaults.json"),
    ("GNOME Terminal", [0x17_1421, 0x5E_5C64, 0xD0_CFCC, 0xFF_FFFF], "its palette GNOME"),
    ("VTE", [0x00_0000, 0x3F_3F3F, 0xC0_C0C0, 0xFF_FFFF], "vte.cc, the palette without a profile"),
    ("Solarized dark", [0x07_3642, 0x00_2B36, 0xEE_E8D5, 0xFD_F6E3], "ethanschoonover.com/solarized"),
    ("Solarized light", [0x07_3642, 0x00_2B36, 0xEE_E8D5, 0xFD_F6E3], "the same 16 colours"),
];

/// Prints a table of L* against each terminal's own white.
pub fn table(out: &mut impl Write) -> io::Result<()> {
    let names: Vec<String> = Level::all().map(|level| level.get().to_string()).collect();
    writeln!(out, "| terminal | 0, 8, 7, 15 | | {} | away |", names.join(" | "))?;
    writeln!(out, "|---|---|---|{}---|", "---|".repeat(names.len()))?;
    for (name, colors, source) in TERMINALS {
        let colors = colors.map(u32::to_be_bytes).map(|[_, r, g, b]| [r, g, b]);
        let shown = FourGrays::Attributes(colors);
        let hex = colors.map(|[r, g, b]| format!("{r:02x}{g:02x}{b:02x}")).join(" ");
        let before = lightnesses(Palette::DOS, Palette::Dos(shown));
        row(out, &format!("{name} ({source})"), &hex, "as a PC's", before)?;
        let fitted = FourGrays::of_attributes(colors);
        let palette = Palette::Dos(fitted.unwrap_or(FourGrays::Indexed));
        let how = if fitted.is_some() { "fitted" } else { "by index" };
        row(out, "", "", how, lightnesses(palette, palette))?;
    }
    Ok(())
}

/// L* of even fields of each level, composed for one palette and seen in another.
fn lightnesses(composed: Palette, seen: Palette) -> [f64; 13] {
    std::array::from_fn(|k| {
        let level = Level::new(k as u8).expect("13 levels");
        let light = Grid::filled(Size::new(1, 1), level.light());
        let cells = compose(&light, GlyphMode::Shade, composed, Tone::default());
        lightness(appearance(&cells, seen, Size::new(1, 1))[(0, 0)])
    })
}

/// One row, with the root mean square of what the levels are away.
fn row(out: &mut impl Write, name: &str, colors: &str, how: &str, found: [f64; 13]) -> io::Result<()> {
    let squares = Level::all().zip(found).map(|(level, found)| {
        let away = found - lightness(level.light());
        away * away
    });
    let away = (squares.sum::<f64>() / 13.0).sqrt();
    let found = found.map(|lightness| format!("{lightness:.0}")).join(" | ");
    writeln!(out, "| {name} | {colors} | {how} | {found} | {away:.1} |")
}
