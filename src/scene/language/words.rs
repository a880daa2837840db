//! The table of every word, its arguments, their defaults and units.

use super::vocabulary::{
    FigureWord, FormWord, MapWord, Meaning, OperatorWord, Parameter, SolidWord, Takes, Word,
};

/// An argument that may be given by its position.
const fn placed(name: &'static str, takes: Takes, default: &'static str, summary: &'static str) -> Parameter {
    Parameter { name, takes, by_position: true, default, summary }
}

/// An argument that is given by its name only.
const fn named(name: &'static str, takes: Takes, default: &'static str, summary: &'static str) -> Parameter {
    Parameter { name, takes, by_position: false, default, summary }
}

const AT: Parameter = named("at", Takes::Point, "[0, 0, 0]", "the centre; only with `semi`");
const SEMI: Parameter =
    named("semi", Takes::Size, "–", "the half-sizes along x, y and z; replaces the sizes above");
const CENTER: Parameter = placed("center", Takes::Flag, "false", "whether the middle is at the origin");
const CONVEXITY: Parameter = placed("convexity", Takes::Ignored, "–", "without effect");

const fn word(
    name: &'static str,
    meaning: Meaning,
    arguments: &'static [Parameter],
    summary: &'static str,
) -> Word {
    Word { name, meaning, arguments, summary }
}

/// Every word, in the order of the documentation.
pub static WORDS: &[Word] = &[
    word(
        "cube",
        Meaning::Solid(SolidWord::Cube),
        &[placed("size", Takes::Size, "1", "edge lengths"), CENTER, AT, SEMI],
        "A box along the axes, from the origin towards +x, +y and +z.",
    ),
    word(
        "sphere",
        Meaning::Solid(SolidWord::Sphere),
        &[
            placed("r", Takes::Positive, "1", "radius"),
            named("d", Takes::Positive, "–", "diameter, in place of `r`"),
            AT,
            SEMI,
        ],
        "A sphere about the origin; with `semi` an ellipsoid.",
    ),
    word(
        "cylinder",
        Meaning::Solid(SolidWord::Cylinder),
        &[
            placed("h", Takes::Positive, "1", "height along z"),
            placed("r1", Takes::NotNegative, "1", "radius at the bottom"),
            placed("r2", Takes::NotNegative, "1", "radius at the top; one of the two may be 0"),
            CENTER,
            named("r", Takes::Positive, "–", "both radii"),
            named("d", Takes::Positive, "–", "both diameters"),
            named("d1", Takes::NotNegative, "–", "diameter at the bottom"),
            named("d2", Takes::NotNegative, "–", "diameter at the top"),
            AT,
            SEMI,
        ],
        "A cylinder, cone or truncated cone on the z axis, its bottom at z = 0.",
    ),
    word(
        "cone",
        Meaning::Solid(SolidWord::Cone),
        &[
            placed("h", Takes::Positive, "1", "height along z"),
            placed("r", Takes::Positive, "1", "radius of the base"),
            CENTER,
            named("d", Takes::Positive, "–", "diameter of the base, in place of `r`"),
            named("at", Takes::Point, "[0, 0, 0]", "the apex; only with `semi`"),
            named(
                "semi",
                Takes::Size,
                "–",
                "[a, b, c]: half-sizes of the base along x and y, and the height c down from the apex",
            ),
        ],
        "A cone on the z axis, its base at z = 0 and its apex above; with `semi` its apex at `at` and its base below.",
    ),
    word(
        "polyhedron",
        Meaning::Solid(SolidWord::Polyhedron),
        &[
            placed("points", Takes::Points, "–", "the corners"),
            placed(
                "faces",
                Takes::Faces,
                "–",
                "for each face its corners in order, as indices from 0; either way round",
            ),
            CONVEXITY,
            named("triangles", Takes::Faces, "–", "an old name of `faces`"),
        ],
        "A solid with flat faces. They must close: every edge belongs to two faces.",
    ),
    word(
        "patch",
        Meaning::Solid(SolidWord::Patch),
        &[placed("points", Takes::Net, "–", "the control points")],
        "A bicubic Bézier patch: a surface, which bounds no solid.",
    ),
    word(
        "patches",
        Meaning::Solid(SolidWord::Patches),
        &[
            placed("points", Takes::Points, "–", "the control points"),
            placed(
                "patches",
                Takes::Faces,
                "–",
                "for each patch its 16 control points, four rows of four, as indices from 0",
            ),
        ],
        "Bicubic Bézier patches: a solid, where every side belongs to two of them, else a surface.",
    ),
    word(
        "import",
        Meaning::Import,
        &[
            placed("file", Takes::Text, "–", "its name, from the scene's folder on"),
            placed("layer", Takes::AnyText, "\"\"", "the only layer that is read of a drawing"),
            CONVEXITY,
            placed("origin", Takes::Offset, "[0, 0]", "the place of a DXF drawing that comes to the origin"),
            placed("scale", Takes::Number, "1", "by what a DXF drawing is scaled, and nothing else is"),
            named("center", Takes::Flag, "false", "whether the middle of an SVG drawing comes to the origin"),
            named("dpi", Takes::Number, "72", "how many dots of an SVG drawing are an inch long"),
            named("id", Takes::AnyText, "\"\"", "the only element that is read of an SVG drawing"),
            named("timestamp", Takes::Ignored, "–", "without effect"),
        ],
        "The solids of a mesh file (docs/meshes.md), which must close, or the figure of a drawing (docs/openscad.md).",
    ),
    word(
        "surface",
        Meaning::Solid(SolidWord::Surface),
        &[
            placed(
                "file",
                Takes::Text,
                "–",
                "a PNG picture, or a table of numbers; in the folder of the scene",
            ),
            CENTER,
            CONVEXITY,
            named("invert", Takes::Flag, "false", "whether dark is high in a picture"),
            named("timestamp", Takes::Ignored, "–", "without effect"),
        ],
        "The solid under the heights of a file, one unit apart.",
    ),
    word(
        "circle",
        Meaning::Figure(FigureWord::Circle),
        &[
            placed("r", Takes::Positive, "1", "radius"),
            named("d", Takes::Positive, "–", "diameter, in place of `r`"),
        ],
        "A disc about the origin.",
    ),
    word(
        "square",
        Meaning::Figure(FigureWord::Square),
        &[placed("size", Takes::FlatSize, "1", "lengths of the sides"), CENTER],
        "A rectangle along the axes, from the origin towards +x and +y.",
    ),
    word(
        "polygon",
        Meaning::Figure(FigureWord::Polygon),
        &[
            placed("points", Takes::FlatPoints, "–", "the corners"),
            placed(
                "paths",
                Takes::Paths,
                "–",
                "outlines, as indices of points from 0; all points in their order where it is not given",
            ),
            CONVEXITY,
        ],
        "What is inside of one or more outlines.",
    ),
    word(
        "text",
        Meaning::Figure(FigureWord::Text),
        &[
            placed("text", Takes::AnyText, "\"\"", "the letters, in one line"),
            placed("size", Takes::Number, "10", "about the height of a capital letter"),
            placed(
                "font",
                Takes::AnyText,
                "\"Liberation Sans\"",
                "family and style, as in \"DejaVu Sans:style=Bold\"",
            ),
            named(
                "direction",
                Takes::AnyText,
                "–",
                "\"ltr\", \"rtl\", \"ttb\" or \"btt\": the way they are written; by the letters where it is not given",
            ),
            named("language", Takes::AnyText, "\"en\"", "by which some fonts choose forms"),
            named("script", Takes::AnyText, "–", "such as \"Latn\"; by the letters where it is not given"),
            named("halign", Takes::AnyText, "\"left\"", "\"left\", \"center\" or \"right\""),
            named(
                "valign",
                Takes::AnyText,
                "\"baseline\"",
                "\"baseline\", \"bottom\", \"center\" or \"top\"",
            ),
            named("spacing", Takes::Number, "1", "by what the way from letter to letter is multiplied"),
        ],
        "Letters, in a font of the machine.",
    ),
    word(
        "linear_extrude",
        Meaning::Form(FormWord::LinearExtrude),
        &[
            placed("height", Takes::Positive, "100", "the way along z"),
            named("center", Takes::Flag, "false", "whether the middle is at z = 0"),
            named("twist", Takes::Number, "0", "degrees of turn on the way, clockwise seen from above"),
            named("slices", Takes::Positive, "–", "in how many steps it is turned and scaled"),
            named("scale", Takes::FlatFactor, "1", "by what it is scaled on the way"),
            named("v", Takes::Point, "[0, 0, 1]", "the direction of the way; its length is that of `height`"),
            named(
                "segments",
                Takes::NotNegative,
                "–",
                "how many sides an outline has at least, where it is turned or scaled",
            ),
            named("convexity", Takes::Ignored, "–", "without effect"),
        ],
        "The solid that a figure sweeps on its way up.",
    ),
    word(
        "rotate_extrude",
        Meaning::Form(FormWord::RotateExtrude),
        &[
            placed("angle", Takes::Number, "360", "degrees of turn, counter-clockwise seen from above"),
            named("start", Takes::Number, "–", "degrees from the x axis at which it begins"),
            named("convexity", Takes::Ignored, "–", "without effect"),
        ],
        "The solid that a figure sweeps about the z axis: its y becomes z.",
    ),
    word(
        "hull",
        Meaning::Form(FormWord::Hull),
        &[],
        "The smallest convex solid, or figure, around its children.",
    ),
    word(
        "minkowski",
        Meaning::Form(FormWord::Minkowski),
        &[CONVEXITY],
        "Each point of the first child added to each of the others.",
    ),
    word(
        "offset",
        Meaning::Form(FormWord::Offset),
        &[
            placed("r", Takes::Number, "1", "how far the outline moves outwards, with round corners"),
            named("delta", Takes::Number, "–", "the same with sharp corners, in place of `r`"),
            named("chamfer", Takes::Flag, "false", "whether the corners of `delta` are cut off"),
        ],
        "A figure made larger; smaller where the number is below 0.",
    ),
    word("fill", Meaning::Form(FormWord::Fill), &[], "A figure without its holes."),
    word(
        "projection",
        Meaning::Form(FormWord::Projection),
        &[
            placed("cut", Takes::Flag, "false", "whether it is what the plane z = 0 cuts, not the shadow"),
            named("convexity", Takes::Ignored, "–", "without effect"),
        ],
        "The figure that solids cast on the plane z = 0.",
    ),
    word(
        "resize",
        Meaning::Form(FormWord::Resize),
        &[
            placed("newsize", Takes::NewSize, "[0, 0, 0]", "sizes along the axes; 0 leaves one as it is"),
            placed("auto", Takes::Flags, "false", "whether a size of 0 goes along with the largest"),
            CONVEXITY,
        ],
        "Scales its children to a size.",
    ),
    word("union", Meaning::Operator(OperatorWord::Union), &[], "What is in any child."),
    word(
        "difference",
        Meaning::Operator(OperatorWord::Difference),
        &[],
        "What is in the first child and in no other.",
    ),
    word("intersection", Meaning::Operator(OperatorWord::Intersection), &[], "What is in every child."),
    word("group", Meaning::Operator(OperatorWord::Union), &[], "The same as `union`."),
    word("render", Meaning::Operator(OperatorWord::Union), &[CONVEXITY], "The same as `union`."),
    word(
        "translate",
        Meaning::Map(MapWord::Translate),
        &[placed("v", Takes::Offset, "–", "the way")],
        "Moves its children.",
    ),
    word(
        "rotate",
        Meaning::Map(MapWord::Rotate),
        &[
            placed("a", Takes::Angles, "–", "degrees about z, or about x, then y, then z"),
            placed("v", Takes::Offset, "[0, 0, 1]", "the axis, where `a` is a number"),
        ],
        "Turns its children about the origin, counter-clockwise seen from the axis' tip.",
    ),
    word(
        "scale",
        Meaning::Map(MapWord::Scale),
        &[placed("v", Takes::Factor, "–", "factors along x, y and z")],
        "Makes its children larger or smaller, from the origin.",
    ),
    word(
        "mirror",
        Meaning::Map(MapWord::Mirror),
        &[placed("v", Takes::Offset, "–", "normal of the mirror plane through the origin")],
        "Mirrors its children.",
    ),
    word(
        "multmatrix",
        Meaning::Map(MapWord::Multmatrix),
        &[placed("m", Takes::Matrix, "–", "rows [xx, xy, xz, x]; a fourth row must be [0, 0, 0, 1]")],
        "Maps its children by an affine matrix.",
    ),
    word(
        "color",
        Meaning::Color,
        &[
            placed("c", Takes::Color, "–", "the colour; a fourth number is `alpha`"),
            placed("alpha", Takes::Share, "1", "below 1 the solid is seen through"),
        ],
        "Gives its children a colour.",
    ),
    word(
        "material",
        Meaning::Material,
        &[
            placed("name", Takes::Text, "–", "the name that is given, or the material that is meant"),
            named("color", Takes::Color, "[0.9, 0.9, 0.9]", "C, the colour of diffuse and ambient light"),
            named("kd", Takes::Share, "0.8", "diffuse share"),
            named("ks", Takes::Share, "0.2", "highlight share"),
            named("n", Takes::Positive, "24", "highlight exponent: higher is a smaller, harder highlight"),
            named("kr", Takes::Share, "0", "mirror share"),
            named("kt", Takes::Share, "0", "share of light let through"),
            named("index", Takes::Positive, "1", "index of refraction: water 1.33, glass 1.5"),
        ],
        "Ended by `;` it defines a material; before a child it applies one.",
    ),
    word(
        "object",
        Meaning::Object,
        &[placed("name", Takes::Text, "–", "its name")],
        "Makes its children one object of the lattice, with a name.",
    ),
    word(
        "camera",
        Meaning::Camera,
        &[
            placed("name", Takes::Text, "–", "the name of the view"),
            named("eye", Takes::Point, "–", "the viewpoint; must be given"),
            named("target", Takes::Point, "[0, 0, 0]", "a point in the middle of the picture"),
            named(
                "up",
                Takes::Point,
                "[0, 0, 1]",
                "upwards in the picture; [0, 1, 0] where the sight line is along z",
            ),
            named("field", Takes::Field, "[40, 25]", "full angles of view, degrees"),
            named("zoom", Takes::Positive, "1", "divides the tangents of both half angles"),
        ],
        "A view of the scene. The first is shown first.",
    ),
    word(
        "light",
        Meaning::Light,
        &[
            placed("at", Takes::Point, "–", "where it stands; must be given"),
            placed("intensity", Takes::NotNegative, "1", "Ip"),
            placed("color", Takes::Color, "[1, 1, 1]", "its colour"),
        ],
        "A point of light.",
    ),
    word(
        "world",
        Meaning::World,
        &[
            named("ambient", Takes::Glow, "0.1", "Ia, light from everywhere"),
            named("background", Takes::Glow, "0", "what is seen where nothing is"),
            named(
                "k",
                Takes::Positive,
                "–",
                "depth constant, a length: where given, light is divided by R + k",
            ),
        ],
        "What belongs to no object. At most one.",
    ),
];

/// Words of OpenSCAD that ray13 knows and can not show, and why.
pub static UNSUPPORTED: &[(&str, &str)] = &[("roof", "only OpenSCAD can work its shape out")];
