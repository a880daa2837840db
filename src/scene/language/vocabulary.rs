//! What a word of the language is: its arguments, what they take, their defaults. The words themselves are
//! in [`super::words`]; the builder, the messages and a test of `docs/scene-language.md` all read that table.

/// The settings that OpenSCAD passes down to every word.
pub const FRAGMENT_SETTINGS: [&str; 3] = ["$fn", "$fa", "$fs"];

/// Words of OpenSCAD's programs: they never stand in a `.csg` file.
pub const PROGRAM_WORDS: [&str; 13] = [
    "module",
    "function",
    "for",
    "intersection_for",
    "if",
    "else",
    "let",
    "assign",
    "use",
    "include",
    "echo",
    "assert",
    "each",
];

/// A word of the language.
#[derive(Debug)]
pub struct Word {
    pub name: &'static str,
    pub meaning: Meaning,
    /// Those that may be given without their name come first, in their order.
    pub arguments: &'static [Parameter],
    /// One sentence for the documentation.
    pub summary: &'static str,
}

/// What the builder does with a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    Solid(SolidWord),
    /// The solids of a mesh file, or the figure of a drawing.
    Import,
    Figure(FigureWord),
    Form(FormWord),
    Operator(OperatorWord),
    Map(MapWord),
    Color,
    Material,
    Object,
    Camera,
    Light,
    World,
}

/// Words for primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidWord {
    Cube,
    Sphere,
    Cylinder,
    Cone,
    Polyhedron,
    Patch,
    Patches,
    Surface,
}

/// Words for plane figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureWord {
    Circle,
    Square,
    Polygon,
    Text,
}

/// Words that make something new of what their children are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormWord {
    LinearExtrude,
    RotateExtrude,
    Hull,
    Minkowski,
    Offset,
    Fill,
    Projection,
    Resize,
}

/// Words that put their children together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperatorWord {
    Union,
    Intersection,
    Difference,
}

/// Words that move their children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapWord {
    Multmatrix,
    Translate,
    Rotate,
    Scale,
    Mirror,
}

/// An argument of a word.
#[derive(Debug)]
pub struct Parameter {
    pub name: &'static str,
    pub takes: Takes,
    /// Whether it may be given by its position, without its name.
    pub by_position: bool,
    /// For the documentation; `–` where there is none.
    pub default: &'static str,
    /// For the documentation: what it does, and its unit.
    pub summary: &'static str,
}

/// What an argument takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Takes {
    /// Any number.
    Number,
    /// A number above 0.
    Positive,
    /// A number that is 0 or more.
    NotNegative,
    /// A number in `0..=1`.
    Share,
    /// `true` or `false`.
    Flag,
    /// A text that is not empty.
    Text,
    /// A text that may be empty.
    AnyText,
    /// `[x, y, z]`.
    Point,
    /// `[x, y, z]` or `[x, y]`.
    Offset,
    /// A number or `[x, y, z]`, above 0.
    Size,
    /// A number or `[x, y, z]` or `[x, y]`, not 0.
    Factor,
    /// A number or `[x, y, z]` or `[x, y]`.
    Angles,
    /// `[across, down]`, each in `0 < angle < 180`.
    Field,
    /// A colour.
    Color,
    /// A number or `[r, g, b]`, 0 or more.
    Glow,
    /// Three or four rows of four numbers.
    Matrix,
    /// A number or `[x, y]`, above 0.
    FlatSize,
    /// A number or `[x, y]`, 0 or more.
    FlatFactor,
    /// `[x, y, z]` or `[x, y]`, each 0 or more.
    NewSize,
    /// A flag, or a list of them.
    Flags,
    /// A list of points.
    Points,
    /// Four rows of four points.
    Net,
    /// A list of points of a plane.
    FlatPoints,
    /// A list of indices, or of lists of them.
    Paths,
    /// A list of lists of indices of points.
    Faces,
    /// Anything: read for OpenSCAD's sake, without effect.
    Ignored,
}

impl Takes {
    /// Whether two numbers may stand for three.
    pub fn is_flat(self) -> bool {
        matches!(
            self,
            Self::Offset | Self::Angles | Self::Factor | Self::FlatSize | Self::FlatFactor | Self::NewSize
        )
    }

    /// For messages and the documentation.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Number => "a number",
            Self::Positive => "a number above 0",
            Self::NotNegative => "a number, 0 or more",
            Self::Share => "a number from 0 to 1",
            Self::Flag => "true or false",
            Self::Text | Self::AnyText => "a text in double quotes",
            Self::Point => "[x, y, z]",
            Self::Offset => "[x, y, z] or [x, y]",
            Self::Size => "a number or [x, y, z], above 0",
            Self::Factor => "a number or [x, y, z] or [x, y], not 0",
            Self::Angles => "a number or [x, y, z] or [x, y]",
            Self::Field => "[across, down], each above 0 and below 180",
            Self::Color => "[r, g, b] from 0 to 1, or a colour's name",
            Self::Glow => "a number or [r, g, b], 0 or more",
            Self::Matrix => "4 or 3 rows of 4 numbers",
            Self::FlatSize => "a number or [x, y], above 0",
            Self::FlatFactor => "a number or [x, y], 0 or more",
            Self::NewSize => "[x, y, z] or [x, y], each 0 or more",
            Self::Flags => "true or false, or a list of them",
            Self::Points => "a list of [x, y, z]",
            Self::Net => "four rows of four [x, y, z]",
            Self::FlatPoints => "a list of [x, y]",
            Self::Paths => "a list of indices, or of lists of them",
            Self::Faces => "a list of lists of indices",
            Self::Ignored => "anything",
        }
    }
}
