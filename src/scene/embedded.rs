//! The scenes that come with the program.

/// A scene inside the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EmbeddedScene {
    /// Its name, without `.scene`.
    pub name: &'static str,
    /// What is in it, in a few words.
    pub title: &'static str,
    /// Its text in the scene language.
    pub text: &'static str,
}

/// All embedded scenes; the first is the one shown where none is asked for.
pub const fn embedded() -> &'static [EmbeddedScene] {
    &[
        EmbeddedScene {
            name: "hanyang",
            title: "the paper's four primitives, alone and composed, on a floor",
            text: include_str!("../../scenes/hanyang.scene"),
        },
        EmbeddedScene {
            name: "die",
            title: "an ivory die with all its pips",
            text: include_str!("../../scenes/die.scene"),
        },
        EmbeddedScene {
            name: "bolt",
            title: "a hexagonal bolt and its nut",
            text: include_str!("../../scenes/bolt.scene"),
        },
        EmbeddedScene {
            name: "temple",
            title: "a colonnade to walk through",
            text: include_str!("../../scenes/temple.scene"),
        },
        EmbeddedScene {
            name: "glass",
            title: "a lens, a ball, a drilled block and a straw in water, before a chequered wall",
            text: include_str!("../../scenes/glass.scene"),
        },
        EmbeddedScene {
            name: "mirrors",
            title: "polished balls and a pawn between two looking-glasses",
            text: include_str!("../../scenes/mirrors.scene"),
        },
        EmbeddedScene {
            name: "teapot",
            title: "the teapot of 1975, of Bézier patches",
            text: include_str!("../../scenes/teapot.scene"),
        },
    ]
}
