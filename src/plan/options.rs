//! What the person asked for, beside the scene and the view.

/// Choices that change what is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The illumination model.
    pub shading: Shading,
    /// Whether lights are tested for what stands before them.
    pub shadows: bool,
    /// How space is cut into cells.
    pub structure: StructureChoice,
    /// Rays per dot along each axis; 1 or more. The light of a dot is their mean.
    pub samples: u32,
    /// Whether the light of each dot is wanted by its three primaries, and not its luminance only. A `color`
    /// palette wants it by itself.
    pub color: bool,
    /// Worker threads; 0 takes one per processor.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            shading: Shading::Phong,
            shadows: true,
            structure: StructureChoice::Auto,
            samples: 1,
            color: false,
            threads: 0,
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
}

impl Shading {
    /// All models, in the paper's order.
    pub const ALL: [Self; 3] = [Self::Lambert, Self::Depth, Self::Phong];

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
}
