//! What the terminal is asked about its colors, and what its answers make of the palette.
//!
//! Nobody's colors are changed; they are asked for (OSC 4 and OSC 11, of xterm), in one write with a status
//! request behind it, so that a terminal that does not know the questions is not waited for.

use super::input::{Answer, Colored};
use super::settings::{Questions, Settings};
use crate::glyph::{FourGrays, Ground, Palette};
use crate::math::DVec3;
use crate::shade::luminance;
use crate::tone::{light_of_srgb, lightness};

/// The attributes of the four grays, from the darkest.
const ATTRIBUTES: [u8; 4] = [0, 8, 7, 15];

impl Questions {
    /// What to send.
    pub fn text(self, palette: Palette) -> Vec<u8> {
        let mut text = String::new();
        if self.grays && matches!(palette, Palette::Dos(_)) {
            text.extend(ATTRIBUTES.map(|attribute| format!("\x1b]4;{attribute};?\x1b\\")));
        }
        if self.ground {
            text.push_str("\x1b]11;?\x1b\\");
        }
        text.into_bytes()
    }
}

impl Settings {
    /// Takes what the terminal has answered in the place of what was taken for it. Where its attributes are
    /// no grays, and it has no others, they are sent as they are.
    pub fn take_in(&mut self, answers: &[Answer]) {
        if self.questions.ground
            && let Some(ground) = shown(answers, Colored::Background).map(ground)
        {
            self.ground = ground;
        }
        if self.questions.grays
            && matches!(self.palette, Palette::Dos(_))
            && let [Some(a), Some(b), Some(c), Some(d)] =
                ATTRIBUTES.map(|index| shown(answers, Colored::Index(index)))
            && let Some(grays) = FourGrays::of_attributes([a, b, c, d])
        {
            self.palette = Palette::Dos(grays);
        }
    }
}

/// The color that the terminal says it shows, as bytes.
fn shown(answers: &[Answer], what: Colored) -> Option<[u8; 3]> {
    answers.iter().find_map(|answer| match answer {
        // The highest byte, as X11 takes it for a screen of 24 bits.
        Answer::Color { of, rgb } if *of == what => Some(rgb.map(|channel| (channel >> 8) as u8)),
        _ => None,
    })
}

/// Light is what is nearer to white than to black.
fn ground(background: [u8; 3]) -> Ground {
    let light = luminance(DVec3::from(background.map(light_of_srgb)));
    if lightness(light) > 50.0 { Ground::Light } else { Ground::Dark }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::input::in_command;

    /// The answers of a terminal of these colors, in the words that it uses, to the questions for attributes
    /// 0, 8, 7 and 15 and for the background.
    fn answers(colors: [&str; 4], background: &str) -> Vec<Answer> {
        let spec = |rgb: &str| {
            let [r, g, b] = [0, 2, 4].map(|at| rgb[at..at + 2].repeat(2));
            format!("rgb:{r}/{g}/{b}")
        };
        let mut answers: Vec<Answer> = ATTRIBUTES
            .into_iter()
            .zip(colors)
            .flat_map(|(index, color)| in_command(&format!("4;{index};{}", spec(color))))
            .collect();
        answers.extend(in_command(&format!("11;{}", spec(background))));
        answers
    }

    fn settings(palette: Palette) -> Settings {
        Settings { palette, questions: Questions { grays: true, ground: true }, ..Settings::default() }
    }

    const INDEXED: Palette = Palette::Dos(FourGrays::Indexed);

    #[test]
    fn the_grays_of_the_terminal_are_taken_where_they_are_grays() {
        let terminals = [
            // xterm 388, PuTTY 0.83, Linux 6 (which does not answer; these are its colors), macOS Terminal's
            // Basic.
            (["000000", "7f7f7f", "e5e5e5", "ffffff"], "ffffff", true),
            (["000000", "555555", "bbbbbb", "ffffff"], "000000", true),
            (["000000", "555555", "aaaaaa", "ffffff"], "000000", true),
            (["000000", "666666", "bfbfbf", "e5e5e5"], "ffffff", true),
            // Solarized dark and light: 8 is darker than 0.
            (["073642", "002b36", "eee8d5", "fdf6e3"], "002b36", false),
            (["073642", "002b36", "eee8d5", "fdf6e3"], "fdf6e3", false),
            // Dracula's 8 is blue; Nord's 15 is no lighter than its 7.
            (["21222c", "6272a4", "f8f8f2", "ffffff"], "282a36", false),
            (["3b4252", "4c566a", "e5e9f0", "eceff4"], "2e3440", false),
        ];
        for (colors, background, fits) in terminals {
            let answers = answers(colors, background);
            let mut settings = settings(INDEXED);
            settings.take_in(&answers);
            let bytes =
                colors.map(|color| [0, 2, 4].map(|at| u8::from_str_radix(&color[at..at + 2], 16).unwrap()));
            let own = Palette::Dos(FourGrays::Attributes(bytes));
            assert_eq!(settings.palette, if fits { own } else { INDEXED }, "{colors:?}");
            let light = ["ffffff", "fdf6e3"].contains(&background);
            assert_eq!(settings.ground == Ground::Light, light, "{background}");
        }
    }

    #[test]
    fn without_all_the_answers_it_stays_as_it_was() {
        let mut all = answers(["000000", "7f7f7f", "e5e5e5", "ffffff"], "ffffff");
        all.remove(2);
        for palette in [INDEXED, Palette::DOS] {
            for answers in [&all[..], &all[..1], &[]] {
                let mut settings = settings(palette);
                settings.take_in(answers);
                assert_eq!(settings.palette, palette);
            }
        }
    }

    #[test]
    fn what_an_option_says_is_not_asked() {
        let all = answers(["000000", "7f7f7f", "e5e5e5", "ffffff"], "ffffff");
        let mut settings = Settings { questions: Questions::default(), ..settings(Palette::DOS) };
        assert_eq!(settings.questions.text(settings.palette), b"");
        settings.take_in(&all);
        assert_eq!((settings.palette, settings.ground), (Palette::DOS, Ground::Dark));
        let asks = Questions { grays: true, ground: true };
        assert_eq!(asks.text(Palette::MONO), b"\x1b]11;?\x1b\\", "ink has no grays");
        assert_eq!(asks.text(Palette::DOS).split(|&byte| byte == b'?').count(), 6);
    }
}
