//! The name of a font, as OpenSCAD hands it to fontconfig: families, and what is asked of the face.

/// A font that is asked for: `Family, Other:style=Bold:weight=200`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FontRequest {
    /// The families, the one wanted most first.
    pub families: Vec<String>,
    /// The name of the style, such as `Bold Oblique`; empty where none is given.
    pub style: String,
    /// How heavy: 400 is regular, 700 bold.
    pub weight: u16,
    /// Whether it leans.
    pub is_slanted: bool,
    /// How wide: 5 is normal, 1 the narrowest, 9 the widest.
    pub width: u16,
}

/// The font that OpenSCAD takes where none is named.
const USUAL: &str = "Liberation Sans:style=Regular";

/// Words that fontconfig knows as properties by themselves: weights from 100 to 900.
const WEIGHTS: [(&str, u16); 14] = [
    ("thin", 100),
    ("extralight", 200),
    ("ultralight", 200),
    ("light", 300),
    ("book", 380),
    ("regular", 400),
    ("medium", 500),
    ("demibold", 600),
    ("semibold", 600),
    ("bold", 700),
    ("extrabold", 800),
    ("ultrabold", 800),
    ("black", 900),
    ("heavy", 900),
];

/// The same of widths.
const WIDTHS: [(&str, u16); 5] =
    [("ultracondensed", 1), ("extracondensed", 2), ("condensed", 3), ("semicondensed", 4), ("expanded", 7)];

/// Fontconfig's own weights, beside those of OpenType.
const SCALE: [(f64, f64); 10] = [
    (0.0, 100.0),
    (40.0, 200.0),
    (50.0, 300.0),
    (75.0, 380.0),
    (80.0, 400.0),
    (100.0, 500.0),
    (180.0, 600.0),
    (200.0, 700.0),
    (205.0, 800.0),
    (210.0, 900.0),
];

impl FontRequest {
    /// Reads a name; an empty one is that of the usual font.
    pub fn of(name: &str) -> Self {
        let name = if name.trim().is_empty() { USUAL } else { name.trim() };
        let mut request = Self { weight: 400, width: 5, ..Self::default() };
        let mut parts = split(name, ':').into_iter();
        // Behind a `-` stands a size, which OpenSCAD sets itself.
        let families = parts.next().unwrap_or_default();
        let families = split(&families, '-').into_iter().next().unwrap_or_default();
        let families = split(&families, ',');
        let plain = families.iter().map(|family| unescaped(family).trim().to_owned());
        request.families = plain.filter(|family| !family.is_empty()).collect();
        for part in parts {
            match part.split_once('=') {
                Some((name, value)) => request.property(&key(name), value.trim()),
                None => request.constant(&key(&part)),
            }
        }
        request
    }

    fn property(&mut self, name: &str, value: &str) {
        match name {
            "style" => self.style = unescaped(value),
            "slant" => self.is_slanted = value.parse::<f64>().map_or(key(value) != "roman", |x| x > 0.0),
            "weight" => match value.parse::<f64>() {
                Ok(weight) => self.weight = of_scale(weight),
                Err(_) => self.constant(&key(value)),
            },
            "width" => self.constant(&key(value)),
            _ => {}
        }
    }

    fn constant(&mut self, word: &str) {
        if let Some(&(_, weight)) = WEIGHTS.iter().find(|(name, _)| *name == word) {
            self.weight = weight;
        }
        if let Some(&(_, width)) = WIDTHS.iter().find(|(name, _)| *name == word) {
            self.width = width;
        }
        self.is_slanted |= ["italic", "oblique"].contains(&word);
    }
}

/// The weight in OpenType's numbers of one in fontconfig's.
fn of_scale(weight: f64) -> u16 {
    let above = SCALE.iter().position(|&(own, _)| own >= weight).unwrap_or(SCALE.len() - 1).max(1);
    let [(low, from), (high, to)] = [SCALE[above - 1], SCALE[above]];
    (from + (to - from) * ((weight - low) / (high - low)).clamp(0.0, 1.0)) as u16
}

/// Splits at a separator that no backslash stands before.
fn split(text: &str, separator: char) -> Vec<String> {
    let (mut parts, mut is_escaped) = (vec![String::new()], false);
    for letter in text.chars() {
        if letter == separator && !is_escaped {
            parts.push(String::new());
        } else if let Some(last) = parts.last_mut() {
            last.push(letter);
        }
        is_escaped = letter == '\\' && !is_escaped;
    }
    parts
}

fn unescaped(text: &str) -> String {
    let (mut plain, mut is_escaped) = (String::with_capacity(text.len()), false);
    for letter in text.chars() {
        is_escaped = letter == '\\' && !is_escaped;
        if !is_escaped {
            plain.push(letter);
        }
    }
    plain
}

/// What names are compared by: fontconfig minds neither case nor blanks.
pub fn key(name: &str) -> String {
    name.chars().filter(|letter| !letter.is_whitespace()).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_fontconfig_reads_them() {
        let usual = FontRequest::of(" ");
        assert_eq!((usual.families[0].as_str(), usual.style.as_str()), ("Liberation Sans", "Regular"));
        let request = FontRequest::of("POV\\-Ray Logo, Arial-12:style=Bold Oblique:weight=200");
        assert_eq!(request.families, ["POV-Ray Logo", "Arial"]);
        assert_eq!((request.style.as_str(), request.weight), ("Bold Oblique", 700));
        let request = FontRequest::of("Arial:bold:italic:condensed");
        assert_eq!((request.weight, request.is_slanted, request.width), (700, true, 3));
        assert_eq!(FontRequest::of(":::=:a=b=c\\").families, [""; 0]);
        assert_eq!([-1.0, 75.0, 190.0, 1e9].map(of_scale), [100, 380, 650, 900]);
    }
}
