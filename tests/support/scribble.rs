//! Texts of scenes as nobody writes them: pieces in any order, programs of any numbers, right texts gone
//! wrong.

use proptest::prelude::*;
use proptest::sample::{Index, select};

/// Pieces of all formats, right and wrong, of which texts are put together and which right ones are disturbed
/// by.
const PIECES: [&str; 78] = [
    "cube(1);",
    "cube(",
    "sphere(2);",
    "sphere",
    "cylinder(",
    "cone(",
    "polyhedron(",
    "union()",
    "difference()",
    "intersection()",
    "group()",
    "render()",
    "translate([1,2,3])",
    "rotate(",
    "scale(",
    "mirror(",
    "multmatrix(",
    "color(\"red\")",
    "material(\"a\", kr = 0.5);",
    "material(\"a\")",
    "object(\"b\")",
    "camera(eye = [9, 9, 9]);",
    "light([1, 2, 3]);",
    "world(k = 1);",
    "hull()",
    "for",
    "module",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    "=",
    "*",
    "!",
    "#",
    "%",
    "-",
    "<",
    "1",
    "0",
    "-0",
    "1e400",
    "1e-400",
    "1e308",
    "2mm",
    "nan",
    "inf",
    "true",
    "undef",
    "\"",
    "\\",
    "//",
    "/*",
    "*/",
    "\n",
    "\r",
    "\t",
    " ",
    "é",
    "“",
    "\u{feff}",
    "\0",
    "$fn=5;",
    "v",
    "from",
    "at 0 0 0",
    "up",
    "angle 45",
    "l 1 2 3",
    "f 1 1 1 .5 .5 9 .5 1.5",
    "s 0 0 0 1",
    "c 0 0 0 1 0 0 1 1",
    "p 3",
    "pp 3",
];

/// Pieces in any order.
pub fn soup() -> impl Strategy<Value = String> {
    let blank = select(vec!["", " ", " ", "\n"]);
    let pieces = prop::collection::vec((select(&PIECES[..]), blank), 0..60);
    pieces.prop_map(|pieces| pieces.into_iter().map(|(piece, blank)| format!("{piece}{blank}")).collect())
}

/// A number as somebody may write it; mostly one that can be drawn.
fn number() -> BoxedStrategy<String> {
    let odd = select(vec![
        "1e400",
        "-0",
        "-0.0",
        "1e-400",
        "5e-324",
        "1.7976931348623157e308",
        "nan",
        "inf",
        "-inf",
        "0x10",
        "1e",
        "1e+",
        ".5",
        "5.",
        "--1",
        "+1",
        ".",
        "1_000",
        "1,5",
        "1e999999999999",
        "123456789012345678901234567890",
        "0.000000000000000000000000000001",
        "3.14159265358979323846264338327950288",
        "1e-300",
        "1e300",
        "1e305",
    ]);
    prop_oneof![
        40 => (-9..9_i32).prop_map(|n| n.to_string()),
        40 => (-9.0..9.0).prop_map(|x: f64| format!("{x:.3}")),
        20 => (0.01..1.0).prop_map(|x: f64| format!("{x}")),
        1 => any::<f64>().prop_map(|x| format!("{x:e}")),
        1 => odd.prop_map(str::to_owned),
    ]
    .boxed()
}

/// A size, seldom one that is none.
fn size() -> BoxedStrategy<String> {
    let ends = select(vec!["1e-300", "5e-324", "1e300", "1e-9", "1e9", "2.2250738585072014e-308"]);
    prop_oneof![
        40 => (1..9_i32).prop_map(|n| n.to_string()),
        40 => (0.01..9.0).prop_map(|x: f64| format!("{x}")),
        2 => ends.prop_map(str::to_owned),
        1 => number(),
    ]
    .boxed()
}

fn triple() -> BoxedStrategy<String> {
    prop::array::uniform3(number()).prop_map(|[x, y, z]| format!("[{x}, {y}, {z}]")).boxed()
}

/// Arguments of a primitive, a map, a surface or a view.
fn arguments() -> BoxedStrategy<String> {
    let name = select(vec![
        "",
        "",
        "r = ",
        "h = ",
        "r1 = ",
        "r2 = ",
        "d = ",
        "at = ",
        "semi = ",
        "size = ",
        "center = ",
        "$fn = ",
        "v = ",
        "a = ",
        "kd = ",
        "kr = ",
        "kt = ",
        "index = ",
        "n = ",
        "eye = ",
        "target = ",
        "up = ",
        "field = ",
        "zoom = ",
        "intensity = ",
        "k = ",
        "ambient = ",
        "nonsense = ",
    ]);
    let value = prop_oneof![
        4 => number(),
        4 => triple(),
        1 => select(vec!["true", "undef", "\"a\"", "\"red\"", "\"#12345678\"", "[40, 25]", "[[0, 1], [2]]", "[]"])
            .prop_map(str::to_owned),
    ];
    let argument = (name, value).prop_map(|(name, value)| format!("{name}{value}"));
    prop::collection::vec(argument, 0..4).prop_map(|all| all.join(", ")).boxed()
}

fn primitive() -> BoxedStrategy<String> {
    let word = select(vec![
        "cube",
        "sphere",
        "cylinder",
        "cone",
        "polyhedron",
        "camera",
        "light",
        "world",
        "material",
    ]);
    prop_oneof![
        8 => size().prop_map(|r| format!("sphere({r});")),
        8 => (size(), size(), size()).prop_map(|(a, b, c)| format!("cube([{a}, {b}, {c}], center = true);")),
        8 => (size(), size(), size(), 0..8_u32)
            .prop_map(|(h, r1, r2, sides)| format!("cylinder(h = {h}, r1 = {r1}, r2 = {r2}, $fn = {sides});")),
        2 => (triple(), triple(), triple(), triple()).prop_map(|(a, b, c, d)| {
            format!("polyhedron([{a}, {b}, {c}, {d}], [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]);")
        }),
        1 => (word, arguments()).prop_map(|(word, arguments)| format!("{word}({arguments});")),
    ]
    .boxed()
}

/// Programs of the scene language and of OpenSCAD's part of it.
pub fn language() -> BoxedStrategy<String> {
    let map = prop_oneof![
        3 => triple().prop_map(|v| format!("translate({v})")),
        2 => triple().prop_map(|v| format!("rotate({v})")),
        1 => (number(), triple()).prop_map(|(a, v)| format!("rotate({a}, {v})")),
        1 => triple().prop_map(|v| format!("scale({v})")),
        1 => triple().prop_map(|v| format!("mirror({v})")),
        1 => prop::array::uniform12(number()).prop_map(|m| {
            let rows: Vec<_> = m.chunks(4).map(|row| format!("[{}]", row.join(", "))).collect();
            format!("multmatrix([{}])", rows.join(", "))
        }),
        1 => arguments().prop_map(|arguments| format!("material({arguments})")),
        1 => select(vec!["color(\"red\", 0.5)", "color(\"gray\")", "object(\"b\")", "*", "!", "#", "%"])
            .prop_map(str::to_owned),
    ]
    .boxed();
    let operator = select(vec!["union()", "difference()", "intersection()", "group()", "render()", "hull()"]);
    let solid = primitive().boxed().prop_recursive(5, 24, 4, move |part| {
        prop_oneof![
            (map.clone(), part.clone()).prop_map(|(map, part)| format!("{map} {part}")),
            (operator.clone(), prop::collection::vec(part, 0..5))
                .prop_map(|(operator, parts)| format!("{operator} {{ {} }}", parts.join("\n"))),
        ]
    });
    // Chains and braces about as deep as the grammar allows, and deeper.
    let deep = (
        select(vec![
            "union() {",
            "difference() { cube(1);",
            "translate([1, 0, 0]) ",
            "intersection() {",
            "(",
        ]),
        select(vec![3_usize, 100, 400, 600, 5000]),
    )
        .prop_map(|(word, times)| {
            let close = if word.contains('{') { "}" } else { "" };
            format!("{} sphere(1); {}", word.repeat(times), close.repeat(times))
        });
    let statement = prop_oneof![40 => solid, 1 => deep];
    prop::collection::vec(statement, 1..6).prop_map(|all| all.join("\n")).boxed()
}

/// Files of NFF.
pub fn nff() -> impl Strategy<Value = String> {
    let numbers = |n: usize| prop::collection::vec(number(), n).prop_map(|all| all.join(" "));
    let share = || {
        prop::collection::vec(0.0..1.0, 7)
            .prop_map(|all: Vec<f64>| all.iter().map(|x| format!("{x:.2}")).collect::<Vec<_>>().join(" "))
    };
    let corners = |word: &'static str, each: usize| {
        (3..7_usize).prop_flat_map(move |n| {
            // Sometimes the number is not that of the corners.
            (prop_oneof![9 => Just(n.to_string()), 1 => number()], numbers(each * n))
                .prop_map(move |(n, corners)| format!("{word} {n}\n{corners}"))
        })
    };
    let entity = prop_oneof![
        3 => (numbers(3), size()).prop_map(|(at, r)| format!("s {at} {r}")),
        3 => (numbers(3), size(), numbers(3), size()).prop_map(|(a, r, b, s)| format!("c {a} {r} {b} {s}")),
        3 => corners("p", 3),
        3 => corners("pp", 6),
        2 => (share(), size()).prop_map(|(shares, index)| format!("f {shares} {index}")),
        1 => numbers(3).prop_map(|n| format!("l {n}")),
        1 => (numbers(3), size()).prop_map(|(at, i)| format!("l {at} {i} {i} {i}")),
        1 => size().prop_map(|n| format!("b {n} {n} {n}")),
        1 => (numbers(3), numbers(3), numbers(3), size()).prop_map(|(from, at, up, angle)| {
            format!("v\nfrom {from}\nat {at}\nup {up}\nangle {angle}\nhither 1\nresolution 4 4")
        }),
    ];
    prop::collection::vec(entity, 1..12).prop_map(|all| all.join("\n"))
}

/// Something that happens to a text. Places are shares of its length.
#[derive(Clone, Debug)]
pub enum Mutation {
    /// A stretch is gone.
    Cut(Index, usize),
    /// A stretch stands twice.
    Double(Index, usize),
    /// A piece comes in.
    Insert(Index, &'static str),
    /// A byte is another.
    Byte(Index, u8),
    /// The next number is another.
    Number(Index, String),
    /// The rest is gone.
    End(Index),
}

impl Arbitrary for Mutation {
    type Parameters = ();
    type Strategy = BoxedStrategy<Self>;

    fn arbitrary_with((): ()) -> Self::Strategy {
        let place = any::<Index>;
        prop_oneof![
            2 => (place(), 1..40_usize).prop_map(|(at, length)| Self::Cut(at, length)),
            2 => (place(), 1..200_usize).prop_map(|(at, length)| Self::Double(at, length)),
            2 => (place(), select(&PIECES[..])).prop_map(|(at, piece)| Self::Insert(at, piece)),
            2 => (place(), any::<u8>()).prop_map(|(at, byte)| Self::Byte(at, byte)),
            24 => (place(), prop_oneof![number(), size()]).prop_map(|(at, number)| Self::Number(at, number)),
            1 => place().prop_map(Self::End),
        ]
        .boxed()
    }
}

impl Mutation {
    /// Lets it happen.
    pub fn apply(&self, text: &mut Vec<u8>) {
        let length = text.len();
        let at = |index: &Index| index.index(length + 1);
        match self {
            Self::Cut(place, n) => {
                let start = at(place);
                text.drain(start..length.min(start + n));
            }
            Self::Double(place, n) => {
                let start = at(place);
                let stretch = text[start..length.min(start + n)].to_vec();
                text.splice(start..start, stretch);
            }
            Self::Insert(place, piece) => {
                let start = at(place);
                text.splice(start..start, piece.bytes());
            }
            Self::Byte(place, byte) => {
                let start = at(place);
                if let Some(old) = text.get_mut(start) {
                    *old = *byte;
                }
            }
            Self::Number(place, number) => {
                let from = at(place);
                let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
                let Some(start) = text[from..].iter().position(u8::is_ascii_digit).map(|n| from + n) else {
                    return;
                };
                let end = text[start..].iter().position(|byte| !is_part(byte)).map_or(length, |n| start + n);
                text.splice(start..end, number.bytes());
            }
            Self::End(place) => text.truncate(at(place)),
        }
    }
}
