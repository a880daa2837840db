//! `text`: letters, in a font of the machine.

use super::Builder;
use super::arguments::BoundArguments;
use super::lost::Lost;
use super::origin::Origin;
use crate::scene::Diagnostic;
use crate::scene::lettering::{AlignedAcross, AlignedUp, NotWritten, TextLine, WrittenText, written};
use crate::scene::profile::{Figure, Fragments, MOST_CORNERS, wound};

/// What there is to choose from, by the words for it.
type Choice<T> = [(&'static str, T)];

const ACROSS: &Choice<AlignedAcross> =
    &[("left", AlignedAcross::Left), ("center", AlignedAcross::Center), ("right", AlignedAcross::Right)];

const UP: &Choice<AlignedUp> = &[
    ("baseline", AlignedUp::Baseline),
    ("bottom", AlignedUp::Bottom),
    ("center", AlignedUp::Center),
    ("top", AlignedUp::Top),
];

const DIRECTIONS: &Choice<&str> = &[("", ""), ("ltr", "ltr"), ("rtl", "rtl"), ("ttb", "ttb"), ("btt", "btt")];

impl Builder {
    pub(super) fn text(
        &mut self,
        arguments: &BoundArguments<'_, '_>,
        fragments: Fragments,
        origin: Origin,
    ) -> Result<Figure, Lost> {
        let sink = &mut self.sink;
        let size = arguments.number("size", sink)?.unwrap_or(10.0);
        // OpenSCAD's rule for the curves of letters, which are short.
        let sides = (fragments.of_circle(size) / 8.0).floor() + 1.0;
        let line = TextLine {
            text: arguments.any_text("text", sink)?.unwrap_or(""),
            font: arguments.any_text("font", sink)?.unwrap_or(""),
            size,
            spacing: arguments.number("spacing", sink)?.unwrap_or(1.0),
            language: arguments.any_text("language", sink)?.unwrap_or("en"),
            script: arguments.any_text("script", sink)?.unwrap_or(""),
            direction: self.chosen("direction", DIRECTIONS, arguments)?,
            across: self.chosen("halign", ACROSS, arguments)?,
            up: self.chosen("valign", UP, arguments)?,
            sides: sides.clamp(2.0, MOST_CORNERS) as u32,
        };
        if line.text.is_empty() {
            return Ok(Figure::default());
        }
        let text = written(&line, MOST_CORNERS as usize, &mut self.fonts).map_err(|why| match why {
            NotWritten::TooMany => self.too_many(origin),
            NotWritten::NoFont => {
                let help =
                    "install one, such as the package fonts-liberation; --skip-unsupported shows the rest";
                self.can_not_be_shown("there is no font on this machine", help, origin)
            }
            NotWritten::Unreadable => {
                let help = "name another font; --skip-unsupported shows the rest of the scene";
                self.can_not_be_shown("the font can not be read", help, origin)
            }
        })?;
        self.note_font(&text, arguments);
        self.check_corners(text.outlines.iter().map(Vec::len).sum::<usize>() as f64, origin)?;
        if text.outlines.iter().flatten().any(|corner| !corner.is_finite()) {
            let error = Diagnostic::error(origin.name, "its letters are larger than a 64-bit float holds");
            return Err(arguments.refuse(error, Lost::Empty, &mut self.sink));
        }
        wound(&text.outlines, 0.0).map_err(|_| self.tangled(origin))
    }

    /// What a word of a few stands for; the first of them where it is not given.
    fn chosen<T: Copy>(
        &mut self,
        name: &str,
        choice: &'static Choice<T>,
        arguments: &BoundArguments<'_, '_>,
    ) -> Result<T, Lost> {
        let word = arguments.any_text(name, &mut self.sink)?.unwrap_or(choice[0].0);
        if let Some(&(_, meant)) = choice.iter().find(|(known, _)| known.eq_ignore_ascii_case(word)) {
            return Ok(meant);
        }
        let known: Vec<_> =
            choice.iter().map(|(known, _)| *known).filter(|known| !known.is_empty()).collect();
        let message = format!("`{name}` of `text` takes {}", known.join(", "));
        let place = arguments.place_of(name);
        // As in OpenSCAD: where a program wrote it, it is as if it were not given.
        if self.sink.leaves_out() {
            self.sink.note(Diagnostic::note(place, message));
            return Ok(choice[0].1);
        }
        Err(self.sink.report(Diagnostic::error(place, message)).into())
    }

    /// Says where letters are not in the font that was named.
    fn note_font(&mut self, text: &WrittenText, arguments: &BoundArguments<'_, '_>) {
        let place = arguments.place_of("font");
        if let Some([wanted, taken]) = &text.font.replaced {
            let message = format!("there is no font `{wanted}` on this machine: `{taken}` is taken");
            self.sink.note(Diagnostic::note(place, message));
        }
        if let Some([style, family]) = &text.font.without_style {
            let message = format!("`{family}` has no style `{style}`: the plain one is taken");
            self.sink.note(Diagnostic::note(place, message));
        }
        if text.any_unknown {
            let message =
                "a letter of `text` is none of its font, and is drawn as that shows what it has not";
            self.sink.note(Diagnostic::note(arguments.place_of("text"), message));
        }
    }
}
