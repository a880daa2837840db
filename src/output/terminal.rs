//! What a terminal can be told and what it can draw, by what its environment says of it: `docs/terminals.md`.

use super::terminfo::Description;
use crate::glyph::{ColorDepth, GlyphMode};

/// What a program finds in its environment about its terminal. What is not set is empty, as POSIX has it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Environment {
    /// `TERM`: the name of the terminal.
    pub term: String,
    /// `COLORTERM`: `truecolor` or `24bit` where it takes colours of 24 bits
    /// (<https://github.com/termstandard/colors>).
    pub colorterm: String,
    /// `LC_ALL`, else `LC_CTYPE`, else `LANG`: the first of them that is set and not empty.
    pub locale: String,
    /// Whether the terminal is tmux's, which is called `screen` by some of its settings.
    pub tmux: bool,
    /// What the terminfo database has of `term`; looked up only where [`is_known`] does not know the name.
    pub description: Option<Description>,
}

/// How many colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Colors {
    /// The terminal's own ink and paper.
    None,
    /// Attributes 0 to 7: no dark gray and no white.
    Eight,
    /// Attributes 0 to 15 as ink.
    Sixteen,
    /// Those, and the 256 by number.
    Indexed,
    /// Those, and any by its bytes.
    Direct,
}

/// What a terminal can be told and what it can draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "one for each thing that a terminal can or can not")]
pub struct Capabilities {
    /// Whether the cursor can be sent to a place, as ECMA-48 has it. Without that there are stills only.
    pub cursor: bool,
    /// Whether the locale is one of UTF-8. Without that only ASCII is sent.
    pub utf8: bool,
    /// The colours.
    pub colors: Colors,
    /// Whether attributes 8 to 15 are there as paper.
    pub bright_papers: bool,
    /// Whether there is a second screen that leaves the first as it was.
    pub alternate_screen: bool,
    /// The finest set of characters that it is known to draw.
    pub glyphs: GlyphMode,
}

impl Default for Capabilities {
    /// Those of a terminal emulator of today.
    fn default() -> Self {
        Self { utf8: true, colors: Colors::Direct, ..XTERM }
    }
}

/// What terminals called `xterm` have had for decades. `utf8` is the locale's to say.
const XTERM: Capabilities = Capabilities {
    cursor: true,
    utf8: false,
    colors: Colors::Sixteen,
    bright_papers: true,
    alternate_screen: true,
    glyphs: GlyphMode::Blocks,
};

/// With 256 colours, whatever the name's ending says.
const MODERN: Capabilities = Capabilities { colors: Colors::Indexed, ..XTERM };

/// PuTTY, whose usual fonts lack quadrants.
const PUTTY: Capabilities = Capabilities { glyphs: GlyphMode::Cp437, ..MODERN };

/// GNU screen, which shows bright papers only where the terminal around it has them, and it can not be asked.
const SCREEN: Capabilities = Capabilities { bright_papers: false, glyphs: GlyphMode::Cp437, ..XTERM };

/// The Linux console: inks 0 to 15, papers 0 to 7, a font of 256 or 512 characters, one screen.
const CONSOLE: Capabilities = Capabilities { alternate_screen: false, ..SCREEN };

/// DEC's terminals: ink and paper, one screen. Where the locale says UTF-8 it is something that emulates one.
const VT: Capabilities = Capabilities { colors: Colors::None, ..CONSOLE };

/// What no cursor can be sent over.
const DUMB: Capabilities = Capabilities { cursor: false, ..VT };

/// The names that are known here, each with all that it is the start of up to a `-`: `xterm` stands for
/// `xterm-256color` too. A machine without terminfo, or with an old one, knows fewer.
const KNOWN: &[(&str, Capabilities)] = &[
    ("dumb", DUMB),
    ("unknown", DUMB),
    ("network", DUMB),
    ("dialup", DUMB),
    ("vt100", VT),
    ("vt102", VT),
    ("vt220", VT),
    ("vt320", VT),
    ("vt420", VT),
    ("vt510", VT),
    ("vt520", VT),
    ("linux", CONSOLE),
    ("screen", SCREEN),
    ("tmux", MODERN),
    ("xterm", XTERM),
    ("rxvt", XTERM),
    ("putty", PUTTY),
    ("alacritty", MODERN),
    ("foot", MODERN),
    ("kitty", MODERN),
    ("wezterm", MODERN),
    ("contour", MODERN),
    ("ghostty", MODERN),
    ("konsole", MODERN),
    ("vte", MODERN),
    ("gnome", MODERN),
    ("mintty", MODERN),
    ("mlterm", MODERN),
    ("st", MODERN),
];

/// What the end of a name says of colours.
const ENDINGS: [(&str, Colors); 5] = [
    ("-direct", Colors::Direct),
    ("-256color", Colors::Indexed),
    ("-16color", Colors::Sixteen),
    ("-mono", Colors::None),
    ("-m", Colors::None),
];

/// Whether what a terminal of this name can do is known without a database.
pub fn is_known(term: &str) -> bool {
    known(term).is_some()
}

fn known(term: &str) -> Option<Capabilities> {
    let family =
        |name: &str| term.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'));
    KNOWN.iter().find(|(name, _)| family(name)).map(|&(_, capabilities)| capabilities)
}

impl Capabilities {
    /// What the environment says; of a name that nobody knows only that it is a terminal without a cursor.
    pub fn of(environment: &Environment) -> Self {
        let Environment { term, colorterm, locale, tmux, description } = environment;
        let family = if *tmux && term.starts_with("screen") { Some(MODERN) } else { known(term) };
        let mut found = match (family, description) {
            (Some(family), _) => family,
            (None, Some(description)) => described(*description),
            (None, None) => DUMB,
        };
        if let Some((_, colors)) = ENDINGS.iter().find(|(ending, _)| term.ends_with(ending)) {
            found.colors = *colors;
        }
        // A console that inherits the word, as from a desktop's settings, has no more colours for it.
        let console = term == "linux" || term.starts_with("linux-");
        if found.colors >= Colors::Sixteen && !console && matches!(colorterm.as_str(), "truecolor" | "24bit")
        {
            found.colors = Colors::Direct;
        }
        // Of screen with 256 colours the terminal around it has them, and bright papers with them.
        if found.cursor && found.colors >= Colors::Indexed && !found.bright_papers && !console {
            found.bright_papers = true;
            found.glyphs = GlyphMode::Blocks;
        }
        found.utf8 = is_utf8(locale);
        if !found.utf8 {
            found.glyphs = GlyphMode::Ascii;
        }
        found
    }

    /// How exactly it is told a colour by number or bytes, where it is asked for one.
    pub const fn color_depth(self) -> ColorDepth {
        match self.colors {
            Colors::Direct => ColorDepth::Direct,
            _ => ColorDepth::Indexed,
        }
    }

    /// Whether it has the four grays of the attributes 0, 7, 8 and 15 as ink.
    pub fn has_grays(self) -> bool {
        self.colors >= Colors::Sixteen
    }

    /// Whether it has the 256 colours by number.
    pub fn has_256_colors(self) -> bool {
        self.colors >= Colors::Indexed
    }

    /// Whether it can draw the characters of a mode, and on their papers: the DOS set has papers 0 and 7
    /// only, others have any of the four grays.
    pub fn draws(self, glyphs: GlyphMode) -> bool {
        match glyphs {
            GlyphMode::Ascii => true,
            GlyphMode::Cp437 => self.utf8,
            _ => self.utf8 && self.bright_papers,
        }
    }
}

/// As much as a description promises. Its characters are in doubt.
fn described(description: Description) -> Capabilities {
    if !description.cursor {
        return DUMB;
    }
    let colors = match description.colors {
        ..8 => Colors::None,
        8..16 => Colors::Eight,
        16..256 => Colors::Sixteen,
        256.. => Colors::Indexed,
    };
    Capabilities { colors, alternate_screen: description.alternate_screen, ..VT }
}

/// Whether a locale's characters are UTF-8: `C.UTF-8`, `de_DE.utf8@euro`, and macOS's plain `UTF-8`. None is
/// C, and a locale that names no character set has an old one.
fn is_utf8(locale: &str) -> bool {
    let set = locale.split('@').next().unwrap_or_default().rsplit('.').next().unwrap_or_default();
    set.eq_ignore_ascii_case("utf-8") || set.eq_ignore_ascii_case("utf8")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(term: &str, colorterm: &str, locale: &str) -> Capabilities {
        let environment = Environment {
            term: term.to_owned(),
            colorterm: colorterm.to_owned(),
            locale: locale.to_owned(),
            ..Environment::default()
        };
        Capabilities::of(&environment)
    }

    #[test]
    fn each_name_has_its_colours_and_glyphs() {
        use Colors::{Direct, Indexed, None, Sixteen};
        use GlyphMode::{Blocks, Cp437};
        // TERM, COLORTERM; colours, bright papers, alternate screen, glyphs.
        let table = [
            ("xterm", "", Sixteen, true, true, Blocks),
            ("xterm", "truecolor", Direct, true, true, Blocks),
            ("xterm-256color", "", Indexed, true, true, Blocks),
            ("xterm-256color", "24bit", Direct, true, true, Blocks),
            ("xterm-kitty", "truecolor", Direct, true, true, Blocks),
            ("xterm-direct", "", Direct, true, true, Blocks),
            ("xterm-mono", "", None, true, true, Blocks),
            ("rxvt", "", Sixteen, true, true, Blocks),
            ("rxvt-unicode-256color", "", Indexed, true, true, Blocks),
            ("screen", "", Sixteen, false, true, Cp437),
            ("screen-256color", "", Indexed, true, true, Blocks),
            ("tmux", "", Indexed, true, true, Blocks),
            ("tmux-256color", "truecolor", Direct, true, true, Blocks),
            ("putty", "", Indexed, true, true, Cp437),
            ("alacritty", "truecolor", Direct, true, true, Blocks),
            ("foot", "", Indexed, true, true, Blocks),
            ("linux", "", Sixteen, false, false, Cp437),
            ("linux", "truecolor", Sixteen, false, false, Cp437),
            ("linux-m", "", None, false, false, Cp437),
            ("vt100", "", None, false, false, Cp437),
            ("vt220", "truecolor", None, false, false, Cp437),
        ];
        for (term, colorterm, colors, bright_papers, alternate_screen, glyphs) in table {
            let expected =
                Capabilities { cursor: true, utf8: true, colors, bright_papers, alternate_screen, glyphs };
            assert_eq!(of(term, colorterm, "C.UTF-8"), expected, "{term} {colorterm}");
            // The locale decides the characters alone.
            let plain = Capabilities { utf8: false, glyphs: GlyphMode::Ascii, ..expected };
            assert_eq!(of(term, colorterm, ""), plain, "{term} {colorterm}");
        }
    }

    #[test]
    fn no_name_a_dumb_one_and_one_that_nobody_knows_have_no_cursor() {
        for term in ["", "dumb", "dumb-emacs", "unknown", "vt1000", "xtermx", "linuxes", "nonsense"] {
            assert!(!of(term, "truecolor", "C.UTF-8").cursor, "{term}");
            assert_eq!(of(term, "truecolor", "C.UTF-8").colors, Colors::None, "{term}");
        }
        assert!(is_known("xterm-kitty") && !is_known("xtermx") && !is_known(""));
    }

    #[test]
    fn what_is_offered_can_be_drawn() {
        let offered = |term: &str, locale: &str| {
            let found = of(term, "", locale);
            GlyphMode::ALL.into_iter().filter(|glyphs| found.draws(*glyphs)).collect::<Vec<_>>()
        };
        assert_eq!(offered("xterm", "C.UTF-8"), GlyphMode::ALL);
        assert_eq!(offered("xterm", "C"), [GlyphMode::Ascii]);
        for term in ["linux", "vt100", "screen"] {
            assert_eq!(offered(term, "C.UTF-8"), [GlyphMode::Cp437, GlyphMode::Ascii], "{term}");
        }
    }

    #[test]
    fn tmux_that_calls_itself_screen_is_no_screen() {
        let tmux = Environment { term: "screen".to_owned(), tmux: true, ..Environment::default() };
        assert!(Capabilities::of(&tmux).bright_papers && Capabilities::of(&tmux).has_256_colors());
    }

    #[test]
    fn a_description_says_what_a_strange_name_can_do() {
        let strange = |cursor, colors, alternate_screen| {
            let description = Some(Description { cursor, colors, alternate_screen });
            Capabilities::of(&Environment {
                term: "strange".to_owned(),
                description,
                ..Environment::default()
            })
        };
        assert!(!strange(false, 256, true).cursor);
        let colors = [0, 8, 16, 256, 1 << 24].map(|colors| strange(true, colors, true).colors);
        let expected = [Colors::None, Colors::Eight, Colors::Sixteen, Colors::Indexed, Colors::Indexed];
        assert_eq!(colors, expected);
        assert!(strange(true, 8, true).alternate_screen && !strange(true, 8, false).alternate_screen);
    }

    #[test]
    fn a_locale_names_its_characters() {
        for locale in ["C.UTF-8", "en_US.UTF-8", "de_DE.utf8@euro", "UTF-8", "ko_KR.utf-8"] {
            assert!(is_utf8(locale), "{locale}");
        }
        for locale in ["", "C", "POSIX", "en_US", "de_DE@euro", "ja_JP.eucJP", "UTF-80", "C.UTF-8x"] {
            assert!(!is_utf8(locale), "{locale}");
        }
    }
}
