//! What the person asked for, beside the scene and the view.

/// Generations of mirror and Snell rays where nothing is asked for. With 16 no dot of any view of the scenes
/// inside is half a level off, with 12 some are nearly one, with 5 three (`docs/trade.md`): behind a tumbler
/// of water there are that many surfaces. What is too faint to see is left to the cut-off.
pub const DEPTH: u32 = 16;

/// The change of light that is too small to follow a ray for: half of the smallest step between two levels,
/// which is a quarter of the light of the darkest gray (0.0908 / 4 / 2 = 0.01136), rounded down to three
/// decimals.
pub const CUTOFF: f64 = 0.011;

/// The error that a dot is left with, as a share of a level, where none is asked for: with it as few dots
/// have a wrong level as with 16 rays for each (docs/performance.md).
pub const ERROR: f64 = 1.0 / 16.0;

/// Choices that change what is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The illumination model.
    pub shading: Shading,
    /// Generations of mirror and Snell rays after the rays from the eye.
    pub depth: u32,
    /// A mirror or Snell ray is followed only while it can still change the light of its dot by this much; 0
    /// or more.
    pub cutoff: f64,
    /// Whether lights are tested for what stands before them.
    pub shadows: bool,
    /// How space is cut into cells.
    pub structure: StructureChoice,
    /// What traces.
    pub engine: EngineChoice,
    /// In which precision the fast engine asks what rays from the eye meet.
    pub precision: PrecisionChoice,
    /// Rays per dot along each axis; 1 or more. The light of a dot is their mean.
    pub samples: u32,
    /// A dot gets more rays than the one through its middle where its level is not decided, until its error
    /// is this share of a level at most, above 0; `samples` says nothing then. Absent where each dot gets as
    /// many.
    pub adaptive: Option<f64>,
    /// Whether the light of each dot is wanted by its three primaries, and not its luminance only. A `color`
    /// palette wants it by itself.
    pub color: bool,
    /// Worker threads; 0 takes one per processor.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            shading: Shading::Whitted,
            depth: DEPTH,
            cutoff: CUTOFF,
            shadows: true,
            structure: StructureChoice::Auto,
            engine: EngineChoice::Auto,
            precision: PrecisionChoice::Auto,
            samples: 1,
            adaptive: None,
            color: false,
            threads: 0,
        }
    }
}

/// Options that rule each other out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OptionsError {
    /// The fast engine leads its rays through boxes, and another structure is asked for.
    #[error("the fast engine goes through boxes, not through {}", .0.name())]
    FastWithout(StructureChoice),
}

impl Options {
    /// What traces a picture of these options; never [`EngineChoice::Auto`].
    ///
    /// The fast engine finds the bits of the exact one whatever the scene, the view and their scales, since
    /// it asks that one wherever it is uncertain. So nothing but a wish decides.
    pub fn traced_by(&self) -> EngineChoice {
        match self.engine {
            EngineChoice::Auto if self.structure.allows_boxes() => EngineChoice::Fast,
            EngineChoice::Auto => EngineChoice::Exact,
            asked => asked,
        }
    }

    /// Whether all can be had together. Where they can not, a picture is drawn all the same: the engine that
    /// is asked for comes before the structure.
    pub fn check(&self) -> Result<(), OptionsError> {
        match (self.engine, self.structure) {
            (EngineChoice::Fast, structure) if !structure.allows_boxes() => {
                Err(OptionsError::FastWithout(structure))
            }
            _ => Ok(()),
        }
    }
}

/// The illumination models of the paper, by the number of their equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shading {
    /// Eq. (1): ambient and diffuse light.
    Lambert = 1,
    /// Eq. (2): the depth term, in a scene that gives `world(k = …)`.
    Depth = 2,
    /// Eq. (3): the highlight.
    Phong = 3,
    /// Eq. (4): what mirrors and glass show, on materials with `kr` or `kt`.
    Whitted = 4,
}

impl Shading {
    /// All models, in the paper's order.
    pub const ALL: [Self; 4] = [Self::Lambert, Self::Depth, Self::Phong, Self::Whitted];

    /// The number of the equation.
    pub const fn number(self) -> u8 {
        self as u8
    }
}

/// How space is cut into cells, as asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum StructureChoice {
    /// Whatever suits the scene.
    #[default]
    Auto,
    /// No structure: every ray is tested against every object.
    None,
    /// The paper's lattice; a tree where that would pass its budget.
    Lattice,
    /// Lattices within lattices.
    Tree,
    /// Boxes around boxes.
    Boxes,
}

impl StructureChoice {
    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::None => "none",
            Self::Lattice => "lattice",
            Self::Tree => "tree",
            Self::Boxes => "boxes",
        }
    }

    /// Whether boxes are what is asked for, or nothing.
    pub(super) const fn allows_boxes(self) -> bool {
        matches!(self, Self::Auto | Self::Boxes)
    }
}

/// What traces the rays, as asked for. Both find the same bits, for every scene and view that can be drawn,
/// where [`PrecisionChoice::Double`] is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EngineChoice {
    /// The fast one, unless a structure is asked for that it does not go through.
    #[default]
    Auto,
    /// Rays side by side, in tiles, through boxes.
    Fast,
    /// One ray after the other, through any structure.
    Exact,
}

impl EngineChoice {
    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Fast => "fast",
            Self::Exact => "exact",
        }
    }
}

/// In which precision rays from the eye are asked what they meet, as asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PrecisionChoice {
    /// Single precision, where that takes less time and nobody sees it: depths and normals are still off by
    /// 10⁻⁵ of the scene's size.
    #[default]
    Auto,
    /// Single precision, whether it is seen or not.
    Single,
    /// All.
    Double,
}

impl PrecisionChoice {
    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Single => "single",
            Self::Double => "double",
        }
    }
}
