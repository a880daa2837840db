//! Which fonts stand for one that is not there: those of the same widths, then those that fontconfig prefers
//! for Latin text of the same kind.

use super::request::key;

/// Families whose letters are as wide, one for one, as fontconfig's `30-metric-aliases.conf` has them.
const SAME_WIDTHS: [&[&str]; 7] = [
    &[
        "Arial",
        "Arimo",
        "Liberation Sans",
        "Albany",
        "Albany AMT",
        "Helvetica",
        "Nimbus Sans",
        "Nimbus Sans L",
        "TeX Gyre Heros",
    ],
    &[
        "Times New Roman",
        "Tinos",
        "Liberation Serif",
        "Thorndale",
        "Thorndale AMT",
        "Times",
        "Nimbus Roman",
        "Nimbus Roman No9 L",
        "TeX Gyre Termes",
    ],
    &[
        "Courier New",
        "Cousine",
        "Liberation Mono",
        "Cumberland",
        "Cumberland AMT",
        "Courier",
        "Nimbus Mono",
        "Nimbus Mono L",
        "Nimbus Mono PS",
        "TeX Gyre Cursor",
    ],
    &["Arial Narrow", "Liberation Sans Narrow", "Helvetica Narrow", "Nimbus Sans Narrow"],
    &["Calibri", "Carlito"],
    &["Cambria", "Caladea"],
    &["Georgia", "Gelasio"],
];

/// What fontconfig prefers for Latin text without serifs, as `60-latin.conf` has it.
const SANS: [&str; 13] = [
    "Noto Sans",
    "DejaVu Sans",
    "Bitstream Vera Sans",
    "Verdana",
    "Arial",
    "Liberation Sans",
    "Albany AMT",
    "Luxi Sans",
    "Nimbus Sans L",
    "Nimbus Sans",
    "Helvetica",
    "Lucida Sans Unicode",
    "Tahoma",
];

/// With serifs.
const SERIF: [&str; 12] = [
    "Noto Serif",
    "DejaVu Serif",
    "Bitstream Vera Serif",
    "Times New Roman",
    "Liberation Serif",
    "Thorndale AMT",
    "Luxi Serif",
    "Nimbus Roman No9 L",
    "Nimbus Roman",
    "Times",
    "Georgia",
    "Cambria",
];

/// With letters that are all as wide.
const MONOSPACE: [&str; 14] = [
    "Noto Sans Mono",
    "DejaVu Sans Mono",
    "Bitstream Vera Sans Mono",
    "Inconsolata",
    "Andale Mono",
    "Courier New",
    "Liberation Mono",
    "Cumberland AMT",
    "Luxi Mono",
    "Nimbus Mono L",
    "Nimbus Mono",
    "Nimbus Mono PS",
    "Courier",
    "Consolas",
];

/// The families that stand for one, the best first; that itself is among them.
pub fn stand_ins(family: &str) -> Vec<&'static str> {
    let wanted = key(family);
    let is_among = |names: &&[&str]| names.iter().any(|name| key(name) == wanted);
    let same = SAME_WIDTHS.iter().copied().find(is_among).unwrap_or_default();
    let kinds: [(&str, &[&str]); 2] = [("serif", &SERIF), ("monospace", &MONOSPACE)];
    let is_like = |names: &&[&str]| is_among(names) || names.iter().any(|name| same.contains(name));
    let kind = kinds.iter().find(|(name, names)| wanted == *name || is_like(names));
    same.iter().copied().chain(kind.map_or(SANS.as_slice(), |(_, names)| names).iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_font_is_stood_for_by_one_of_its_kind() {
        assert_eq!(stand_ins("liberation sans")[0], "Arial");
        assert!(stand_ins("liberation sans").contains(&"DejaVu Sans"));
        assert!(stand_ins("Times").contains(&"DejaVu Serif"));
        assert!(stand_ins("Cousine").contains(&"DejaVu Sans Mono"));
        assert_eq!(stand_ins("Comic Sans MS")[0], "Noto Sans");
    }
}
