//! The four grays that a terminal shows for attributes 0, 8, 7 and 15, which are not the same everywhere.

use super::paint::Paint;
use crate::math::DVec3;
use crate::shade::luminance;
use crate::tone::{GRAYS, lab_of_color, light_of_srgb, lightness};

/// How far from gray a color may be, in chroma of CIE L*a*b*. The ISCC-NBS names of colors call it a gray, if
/// a bluish one, up to a Munsell chroma of 2, and a step of that is about 5 here. GNOME's black has 9.9.
const MOST_CHROMA: f64 = 10.0;

/// How much lighter each gray has to be than the one before it, in L*: the narrowest step between two levels.
/// Less would be no step.
const LEAST_STEP: f64 = 4.7;

/// How four neighbouring grays are sent, and what they look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FourGrays {
    /// By attributes 0, 8, 7 and 15, which the terminal shows as these sRGB bytes.
    Attributes([[u8; 3]; 4]),
    /// By numbers 16, 240, 248 and 231 of xterm's 256 colours, which nobody changes: 00, 58, A8 and FF, the
    /// nearest to the PC's own 00, 55, AA and FF.
    Indexed,
}

impl Default for FourGrays {
    fn default() -> Self {
        Self::VGA
    }
}

impl FourGrays {
    /// The attributes as a PC shows them.
    pub const VGA: Self = Self::Attributes([[0x00; 3], [0x55; 3], [0xAA; 3], [0xFF; 3]]);

    /// What to send to a terminal that shows attributes 0, 8, 7 and 15 as these sRGB bytes. `None` where they
    /// are no grays, each lighter than the one before it: Solarized has 8 darker than 0, Dracula's 8 is blue,
    /// Nord's 15 is no lighter than its 7. Then the levels made of them would be in no order, or of a color.
    pub fn of_attributes(colors: [[u8; 3]; 4]) -> Option<Self> {
        let labs = colors.map(|bytes| lab_of_color(DVec3::from(bytes.map(light_of_srgb))));
        let gray = labs.iter().all(|[_, a, b]| (a * a + b * b).sqrt() <= MOST_CHROMA);
        let in_order = labs.windows(2).all(|pair| pair[1][0] - pair[0][0] >= LEAST_STEP);
        (gray && in_order).then_some(Self::Attributes(colors))
    }

    /// The paints, from the darkest.
    pub const fn paints(self) -> [Paint; 4] {
        match self {
            Self::Attributes(_) => [Paint::Black, Paint::DarkGray, Paint::LightGray, Paint::White],
            Self::Indexed => {
                [Paint::Indexed(16), Paint::Indexed(240), Paint::Indexed(248), Paint::Indexed(231)]
            }
        }
    }

    /// Their linear light, against the lightest as white: the eye takes for white what is whitest on the
    /// screen, as L* does.
    pub fn lights(self) -> [f64; 4] {
        match self {
            // To the bit those that the levels are made of.
            Self::VGA => GRAYS,
            Self::Attributes(colors) => {
                let lights = colors.map(|bytes| luminance(DVec3::from(bytes.map(light_of_srgb))));
                lights.map(|light| light / lights[3])
            }
            Self::Indexed => self.paints().map(|paint| paint.light().unwrap_or_default()),
        }
    }

    /// The light of one of the paints.
    pub fn light(self, paint: Paint) -> Option<f64> {
        let place = self.paints().iter().position(|&one| one == paint)?;
        Some(self.lights()[place])
    }

    /// Their L*.
    pub fn lightnesses(self) -> [f64; 4] {
        self.lights().map(lightness)
    }
}
