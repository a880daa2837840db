//! The knobs that buy speed with accuracy, a row each: what is tried of each, how the command line says it,
//! and whether it changes on purpose what is shown.

use crate::frame::Request;
use crate::glyph::GlyphMode;
use crate::plan::{CUTOFF, ERROR, EngineChoice, PrecisionChoice, Shading, StructureChoice};

use super::setting::{Setting, cells};

/// A knob.
#[derive(Clone, Copy, Debug)]
pub struct Knob {
    /// What it is called.
    pub name: &'static str,
    /// Where it stands, as options of the command line.
    argument: fn(&Setting) -> String,
    /// Where else it may stand, from a setting, that of the request.
    others: fn(&Setting, &Request) -> Vec<Setting>,
    /// Puts it where it stands in the second.
    set: fn(&mut Setting, &Setting),
    /// Between two places, where it has numbers and the two have room between them.
    between: fn(&Setting, &Setting) -> Option<Setting>,
    /// Whether the first shows something else than the second on purpose.
    another_picture: fn(&Setting, &Setting) -> bool,
    /// Whether another knob's option says where it stands.
    is_implied: fn(&Setting) -> bool,
}

/// Rays per dot along each axis that are tried.
const SAMPLES: [u32; 5] = [1, 2, 3, 4, 6];

/// Errors of a dot, as shares of a level, that are tried with as many rays as each dot needs.
const ERRORS: [f64; 4] = [4.0 * ERROR, 2.0 * ERROR, ERROR, 0.5 * ERROR];

/// Generations of mirror and Snell rays that are tried.
const DEPTHS: [u32; 6] = [0, 1, 2, 4, 8, 16];

/// Cut-offs that are tried: the default's multiples, and none but the smallest, since a scene of much glass
/// has twice the rays with each generation.
const CUTOFFS: [f64; 4] = [10.0 * CUTOFF, 3.0 * CUTOFF, CUTOFF, 0.1 * CUTOFF];

/// Characters of fewer and fewer dots. Those of ink alone are for other terminals, not for more speed.
const GLYPHS: [GlyphMode; 4] = [GlyphMode::Blocks, GlyphMode::Quadrant, GlyphMode::Half, GlyphMode::Shade];

/// All knobs.
pub const KNOBS: [Knob; 11] = [
    Knob {
        name: "engine",
        argument: |s| format!("--engine {}", s.options.engine.name()),
        others: |s, _| {
            let engines = [EngineChoice::Exact, EngineChoice::Auto];
            with(s, engines.into_iter(), |s, engine| {
                s.options.engine = engine;
                // Only the fast engine has single precision.
                if engine == EngineChoice::Exact {
                    s.options.precision = PrecisionChoice::Auto;
                }
            })
        },
        set: |s, to| s.options.engine = to.options.engine,
        ..WORD
    },
    Knob {
        name: "precision",
        argument: |s| format!("--precision {}", s.options.precision.name()),
        others: |s, _| {
            let all = [PrecisionChoice::Auto, PrecisionChoice::Single, PrecisionChoice::Double];
            with(s, all.into_iter(), |s, precision| s.options.precision = precision)
        },
        set: |s, to| s.options.precision = to.options.precision,
        ..WORD
    },
    Knob {
        name: "samples",
        argument: |s| format!("--samples {}", s.options.samples),
        others: |s, _| with(s, SAMPLES.into_iter(), take_samples),
        set: |s, to| take_samples(s, to.options.samples),
        between: |a, b| {
            let [low, high] = ordered(a.options.samples, b.options.samples);
            middle(low, high).map(|samples| changed(a, |s| take_samples(s, samples)))
        },
        ..WORD
    },
    Knob {
        name: "error",
        argument: |s| {
            s.options.adaptive.map_or("--aa off".to_owned(), |e| format!("--aa adaptive --error {e}"))
        },
        others: |s, _| with(s, ERRORS.map(Some).into_iter().chain([None]), take_error),
        set: |s, to| take_error(s, to.options.adaptive),
        between: |a, b| {
            let middle = rounded((a.options.adaptive? * b.options.adaptive?).sqrt());
            let is_new = ![a.options.adaptive, b.options.adaptive].contains(&Some(middle));
            is_new.then(|| changed(a, |s| take_error(s, Some(middle))))
        },
        // Several rays for each dot are what `--samples` says alone; `--aa off` would take them back.
        is_implied: |s| s.options.adaptive.is_none() && s.options.samples > 1,
        ..WORD
    },
    Knob {
        name: "shading",
        argument: |s| format!("--shading {}", s.options.shading.number()),
        others: |s, _| with(s, Shading::ALL.into_iter(), |s, shading| s.options.shading = shading),
        set: |s, to| s.options.shading = to.options.shading,
        another_picture: |s, base| s.options.shading != base.options.shading,
        ..WORD
    },
    Knob {
        name: "shadows",
        argument: |s| if s.options.shadows { "--shadows" } else { "--no-shadows" }.to_owned(),
        others: |s, _| with(s, [false, true].into_iter(), |s, shadows| s.options.shadows = shadows),
        set: |s, to| s.options.shadows = to.options.shadows,
        another_picture: |s, base| s.options.shadows != base.options.shadows,
        ..WORD
    },
    Knob {
        name: "depth",
        argument: |s| format!("--depth {}", s.options.depth),
        others: |s, _| with(s, DEPTHS.into_iter(), |s, depth| s.options.depth = depth),
        set: |s, to| s.options.depth = to.options.depth,
        between: |a, b| {
            let [low, high] = ordered(a.options.depth, b.options.depth);
            middle(low, high).map(|depth| changed(a, |s| s.options.depth = depth))
        },
        another_picture: |s, base| (s.options.depth == 0) != (base.options.depth == 0),
        ..WORD
    },
    Knob {
        name: "cut-off",
        argument: |s| format!("--cutoff {}", s.options.cutoff),
        others: |s, _| with(s, CUTOFFS.into_iter(), |s, cutoff| s.options.cutoff = rounded(cutoff)),
        set: |s, to| s.options.cutoff = to.options.cutoff,
        between: |a, b| {
            let middle = rounded((a.options.cutoff * b.options.cutoff).sqrt());
            let is_new = ![0.0, a.options.cutoff, b.options.cutoff].contains(&middle);
            is_new.then(|| changed(a, |s| s.options.cutoff = middle))
        },
        ..WORD
    },
    Knob {
        name: "structure",
        argument: |s| format!("--structure {}", s.options.structure.name()),
        others: |s, _| {
            use StructureChoice::{Auto, Boxes, Lattice, None, Tree};
            // Only boxes are gone through by the fast engine.
            let exact = s.options.engine == EngineChoice::Exact;
            let all = [Auto, None, Lattice, Tree, Boxes].into_iter();
            let fitting = all.filter(|&structure| {
                s.options.engine != EngineChoice::Fast || matches!(structure, Auto | Boxes)
            });
            // Any engine that may choose goes through boxes as it does by itself.
            let new = fitting.filter(|&structure| exact || structure != Boxes);
            with(s, new, |s, structure| {
                s.options.structure = structure;
                if !matches!(structure, Auto | Boxes) {
                    s.options.precision = PrecisionChoice::Auto;
                }
            })
        },
        set: |s, to| s.options.structure = to.options.structure,
        ..WORD
    },
    Knob {
        name: "threads",
        argument: |s| format!("--threads {}", s.options.threads),
        others: |s, _| {
            // 0 is all of them.
            let all = std::thread::available_parallelism().map_or(1, usize::from);
            let most = if s.options.threads == 0 { all - 1 } else { all };
            let numbers = std::iter::successors(Some(1), |n| Some(2 * n)).take_while(|&n| n <= most);
            with(s, numbers, |s, threads| s.options.threads = threads)
        },
        set: |s, to| s.options.threads = to.options.threads,
        ..WORD
    },
    Knob {
        name: "dots a cell",
        argument: |s| format!("--glyphs {}", s.glyphs.name()),
        others: |s, base| {
            let turns = cells(base).is_some() && GLYPHS.contains(&base.glyphs);
            with(s, GLYPHS.into_iter().filter(|_| turns), |s, glyphs| s.glyphs = glyphs)
        },
        set: |s, to| s.glyphs = to.glyphs,
        ..WORD
    },
];

/// So many rays for each dot: then not as many as it needs.
fn take_samples(setting: &mut Setting, samples: u32) {
    setting.options.samples = samples;
    if samples > 1 {
        setting.options.adaptive = None;
    }
}

/// As many rays as each dot needs, where there is an error: then not as many for each.
fn take_error(setting: &mut Setting, error: Option<f64>) {
    setting.options.adaptive = error;
    if error.is_some() {
        setting.options.samples = 1;
    }
}

/// What a knob has that has words and no numbers, and gives the same picture or a worse one of the same.
const WORD: Knob = Knob {
    name: "",
    argument: |_| String::new(),
    others: |_, _| Vec::new(),
    set: |_, _| (),
    between: |_, _| None,
    another_picture: |_, _| false,
    is_implied: |_| false,
};

impl Knob {
    /// Whether it stands elsewhere in one setting than in another.
    pub fn differs(&self, own: &Setting, other: &Setting) -> bool {
        (self.argument)(own) != (self.argument)(other)
    }

    /// Where it stands, as options of the command line.
    pub fn argument(&self, setting: &Setting) -> String {
        (self.argument)(setting)
    }
}

impl Setting {
    /// The options of the command line that make this of `other`, which is what they are where none is
    /// given; empty where there is no difference.
    pub fn arguments(&self, other: &Self) -> String {
        let given = KNOBS.iter().filter(|knob| knob.differs(self, other) && !(knob.is_implied)(self));
        given.map(|knob| knob.argument(self)).collect::<Vec<_>>().join(" ")
    }

    /// Whether it shows something else than `base` on purpose, and not the same worse or better: by another
    /// shading model, without shadows, without mirrors and glass.
    pub fn shows_another_picture(&self, base: &Self) -> bool {
        KNOBS.iter().any(|knob| (knob.another_picture)(self, base))
    }

    /// `base` with what this setting shows otherwise on purpose.
    #[must_use]
    pub fn what_is_meant(&self, base: &Self) -> Self {
        let meant = KNOBS.iter().filter(|knob| (knob.another_picture)(self, base));
        meant.fold(*base, |mut setting, knob| {
            (knob.set)(&mut setting, self);
            setting
        })
    }

    /// The settings that differ from this one by a single knob, which is that of the request: of each knob
    /// one, then of each another, so that any first few of them tell of all.
    pub fn alone(&self, base: &Request) -> Vec<Self> {
        let is_other = |other: &Self| other.is_possible() && other != self;
        let of_each = KNOBS.iter().map(|knob| (knob.others)(self, base).into_iter().filter(is_other));
        let mut of_each: Vec<_> = of_each.collect();
        let mut all = Vec::new();
        loop {
            let before = all.len();
            all.extend(of_each.iter_mut().filter_map(Iterator::next));
            if all.len() == before {
                return all;
            }
        }
    }

    /// Settings between two: one with a single knob as in the other, and for a knob of numbers that alone
    /// differs what lies in the middle.
    pub fn between(&self, other: &Self) -> Vec<Self> {
        let different: Vec<_> = KNOBS.iter().filter(|knob| knob.differs(self, other)).collect();
        let mixed = different.iter().flat_map(|knob| {
            [(self, other), (other, self)].map(|(from, to)| changed(from, |s| (knob.set)(s, to)))
        });
        let found: Vec<Self> = match &different[..] {
            [knob] => (knob.between)(self, other).into_iter().collect(),
            _ => mixed.collect(),
        };
        found.into_iter().filter(|s| s.is_possible() && s != self && s != other).collect()
    }

    /// Whether its options go together: single precision is refused where the exact engine traces.
    fn is_possible(&self) -> bool {
        let options = &self.options;
        let exact = options.traced_by() == EngineChoice::Exact;
        options.check().is_ok() && !(exact && options.precision == PrecisionChoice::Single)
    }
}

/// A setting with each value of a knob.
fn with<T>(from: &Setting, values: impl Iterator<Item = T>, set: impl Fn(&mut Setting, T)) -> Vec<Setting> {
    values.map(|value| changed(from, |setting| set(setting, value))).collect()
}

fn changed(from: &Setting, change: impl FnOnce(&mut Setting)) -> Setting {
    let mut setting = *from;
    change(&mut setting);
    setting
}

fn ordered(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// A number between two that are not neighbours.
fn middle(low: u32, high: u32) -> Option<u32> {
    (high - low > 1).then(|| u32::midpoint(low, high))
}

/// A number to two digits behind its first one that is not 0, below 1: as short on a command line.
fn rounded(number: f64) -> f64 {
    const DIGITS: f64 = 1e6;
    (number * DIGITS).round() / DIGITS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Options;

    const DEFAULT: fn() -> Setting = || Setting { options: Options::default(), glyphs: GlyphMode::default() };

    #[test]
    fn a_setting_says_what_differs() {
        let mut setting = DEFAULT();
        assert_eq!(setting.arguments(&DEFAULT()), "");
        setting.options.samples = 3;
        setting.options.shadows = false;
        setting.glyphs = GlyphMode::Half;
        assert_eq!(setting.arguments(&DEFAULT()), "--samples 3 --no-shadows --glyphs half");
        assert_eq!(DEFAULT().arguments(&setting), "--samples 1 --shadows --glyphs blocks");
    }

    /// `--samples 3 --aa off` is one ray a dot.
    #[test]
    fn anti_aliasing_is_not_turned_off_where_rays_for_each_dot_are_meant() {
        let adaptive = changed(&DEFAULT(), |s| take_error(s, Some(ERROR)));
        let fixed = changed(&adaptive, |s| take_samples(s, 3));
        assert_eq!(fixed.arguments(&adaptive), "--samples 3");
        assert_eq!(DEFAULT().arguments(&adaptive), "--aa off");
        assert_eq!(adaptive.arguments(&fixed), "--samples 1 --aa adaptive --error 0.0625");
    }

    #[test]
    fn what_is_shown_is_changed_by_models_shadows_and_mirrors_alone() {
        let with = |change: fn(&mut Setting)| changed(&DEFAULT(), change).shows_another_picture(&DEFAULT());
        assert!(with(|s| s.options.shading = Shading::Lambert));
        assert!(with(|s| s.options.shadows = false));
        assert!(with(|s| s.options.depth = 0));
        assert!(!with(|s| s.options.depth = 1));
        assert!(!with(|s| s.options.samples = 2));
        assert!(!with(|s| s.glyphs = GlyphMode::Shade));
    }

    #[test]
    fn between_two_settings_lie_their_mixtures_and_middles() {
        let [mut few, mut many] = [DEFAULT(); 2];
        (few.options.samples, many.options.samples) = (2, 6);
        let found = few.between(&many);
        assert_eq!(found.iter().map(|s| s.options.samples).collect::<Vec<_>>(), [4]);
        many.options.precision = PrecisionChoice::Single;
        let found: Vec<String> = few.between(&many).iter().map(|s| s.arguments(&DEFAULT())).collect();
        assert_eq!(found.len(), 4);
        assert!(found.contains(&"--precision single --samples 2".to_owned()), "{found:?}");
        assert!(found.contains(&"--samples 6".to_owned()), "{found:?}");
    }
}
