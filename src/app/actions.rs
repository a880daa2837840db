//! Every action of the viewer, in one table: the key bar, the menus, the help, the manual page and the
//! README's list are made from it.

use ratatui::crossterm::event::KeyCode;

use super::chord::{Chord, char, control, key};

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// The eye goes left around the target.
    OrbitLeft,
    /// The eye goes right around the target.
    OrbitRight,
    /// The eye goes up around the target.
    OrbitUp,
    /// The eye goes down around the target.
    OrbitDown,
    /// Eye and target go along the line of sight.
    FlyForward,
    /// Eye and target go back along the line of sight.
    FlyBack,
    /// Eye and target go left.
    FlyLeft,
    /// Eye and target go right.
    FlyRight,
    /// Eye and target go up.
    Rise,
    /// Eye and target go down.
    Sink,
    /// The field gets narrower.
    ZoomIn,
    /// The field gets wider.
    ZoomOut,
    /// Shows the dialog that opens a scene.
    Open,
    /// Shows the dialog of eye, target and field.
    View,
    /// The next view of the scene.
    NextView,
    /// The view before.
    PreviousView,
    /// From one of the sides that draughtsmen know.
    Standard(StandardView),
    /// The view as it was before any move.
    Home,
    /// All of the scene, from the same side.
    FitAll,
    /// From where the scene was seen before the last jump.
    LastView,
    /// Follows one ray, or leaves it.
    Follow,
    /// Shows the lattice around the ray that is followed, or its story.
    Lattice,
    /// Measures the trade of time for accuracy, or leaves it.
    Trade,
    /// The step before, of the ray that is followed.
    StepBack,
    /// The next step of the ray that is followed.
    StepOn,
    /// Shows the dialog of the sets of characters.
    Glyphs,
    /// The next set of characters.
    NextGlyphs,
    /// The shading model with one term less.
    ShadingDown,
    /// The shading model with one term more.
    ShadingUp,
    /// Draws as fast as it goes, or as the PC/AT drew.
    Turbo,
    /// With Turbo off, a slower processor.
    Slower,
    /// With Turbo off, a faster processor.
    Faster,
    /// Hides the panels, or shows them.
    Panels,
    /// Shows the dialog that saves the picture.
    Save,
    /// Shows the menus.
    Menu,
    /// Shows or hides the keys.
    Help,
    /// Closes what is open over the picture.
    Close,
    /// Sends the whole screen once more.
    Redraw,
    /// Gives the terminal back to the shell for a while.
    Suspend,
    /// The end.
    Quit,
}

/// A side from which draughtsmen draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandardView {
    /// From −y, with z upwards.
    Front,
    /// From +x, with z upwards.
    Right,
    /// From +z, with y upwards.
    Top,
    /// From a corner, so that all three axes are as long.
    Isometric,
}

impl StandardView {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Front, Self::Right, Self::Top, Self::Isometric];
}

/// A pull-down menu.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Menu {
    /// Scenes and pictures as files, and the end.
    File,
    /// From where the scene is seen.
    View,
    /// Moves of the eye.
    Move,
    /// How the picture is drawn.
    Picture,
    /// One ray.
    Ray,
    /// The keys.
    Help,
}

/// An action, and all that is said of it.
#[derive(Debug)]
pub struct Entry {
    /// What is done.
    pub action: Action,
    /// Its name in the menu. Its hot letter is the one behind `&`, which is not shown.
    pub name: &'static str,
    /// What it does, in a sentence without a full stop.
    pub sentence: &'static str,
    /// Its keys, at least one; the first is shown in the menu.
    pub keys: &'static [Chord],
}

/// Actions that belong together: a line of the help, and neighbours in a menu.
#[derive(Debug)]
pub struct Group {
    /// Where they stand.
    pub menu: Menu,
    /// What they do, as the help says it.
    pub does: &'static str,
    /// The actions, in the order of the help.
    pub entries: &'static [Entry],
}

impl Menu {
    /// All menus, from the left.
    pub const ALL: [Self; 6] = [Self::File, Self::View, Self::Move, Self::Picture, Self::Ray, Self::Help];

    /// Its name; the hot letter is the first.
    pub const fn name(self) -> &'static str {
        match self {
            Self::File => "&File",
            Self::View => "&View",
            Self::Move => "&Move",
            Self::Picture => "&Picture",
            Self::Ray => "&Ray",
            Self::Help => "&Help",
        }
    }

    /// Its actions, from the top.
    pub fn entries(self) -> impl Iterator<Item = &'static Entry> {
        ACTIONS.iter().filter(move |group| group.menu == self).flat_map(|group| group.entries)
    }
}

/// All entries of the table.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    ACTIONS.iter().flat_map(|group| group.entries)
}

/// The labels of the ten function keys, from F1.
pub const KEY_BAR: [&str; 10] =
    ["Help", "Open", "View", "Follow", "Turbo", "Trade", "Glyphs", "Save", "Menu", "Quit"];

const fn entry(action: Action, name: &'static str, sentence: &'static str, keys: &'static [Chord]) -> Entry {
    Entry { action, name, sentence, keys }
}

/// Every action of the viewer. Letters stand for both cases.
pub const ACTIONS: &[Group] = &[
    Group {
        menu: Menu::Move,
        does: "orbit about the target",
        entries: &[
            entry(
                Action::OrbitLeft,
                "Orbit &left",
                "The eye goes left around the target",
                &[key(KeyCode::Left), char('h')],
            ),
            entry(
                Action::OrbitDown,
                "Orbit &down",
                "The eye goes down around the target",
                &[key(KeyCode::Down), char('j')],
            ),
            entry(
                Action::OrbitUp,
                "Orbit &up",
                "The eye goes up around the target",
                &[key(KeyCode::Up), char('k')],
            ),
            entry(
                Action::OrbitRight,
                "Orbit &right",
                "The eye goes right around the target",
                &[key(KeyCode::Right), char('l')],
            ),
        ],
    },
    Group {
        menu: Menu::Move,
        does: "fly forward, left, back, right",
        entries: &[
            entry(
                Action::FlyForward,
                "&Fly forward",
                "Eye and target go along the line of sight",
                &[char('w')],
            ),
            entry(Action::FlyLeft, "Fly lef&t", "Eye and target go to the left", &[char('a')]),
            entry(
                Action::FlyBack,
                "Fly &back",
                "Eye and target go back along the line of sight",
                &[char('s')],
            ),
            entry(Action::FlyRight, "Fly ri&ght", "Eye and target go to the right", &[char('d')]),
        ],
    },
    Group {
        menu: Menu::Move,
        does: "rise, sink",
        entries: &[
            entry(Action::Rise, "Ri&se", "Eye and target go up", &[char('r')]),
            entry(Action::Sink, "Sin&k", "Eye and target go down", &[char('f')]),
        ],
    },
    Group {
        menu: Menu::Move,
        does: "zoom in, out",
        entries: &[
            entry(Action::ZoomIn, "Zoom &in", "The field gets narrower", &[char('+'), char('=')]),
            entry(Action::ZoomOut, "Zoom &out", "The field gets wider", &[char('-')]),
        ],
    },
    Group {
        menu: Menu::File,
        does: "open another scene",
        entries: &[entry(
            Action::Open,
            "&Open...",
            "Opens a file, or a scene that is inside the program",
            &[key(KeyCode::F(2))],
        )],
    },
    Group {
        menu: Menu::View,
        does: "eye, target, field; all views",
        entries: &[entry(
            Action::View,
            "&View...",
            "Asks for eye, target and field, and lists all views",
            &[key(KeyCode::F(3))],
        )],
    },
    Group {
        menu: Menu::View,
        does: "next view, the one before",
        entries: &[
            entry(Action::NextView, "&Next view", "Goes to the next view of the scene", &[key(KeyCode::Tab)]),
            entry(
                Action::PreviousView,
                "&Previous view",
                "Goes to the view of the scene before this one",
                &[key(KeyCode::BackTab)],
            ),
        ],
    },
    Group {
        menu: Menu::View,
        does: "front, right, top, isometric",
        entries: &[
            entry(
                Action::Standard(StandardView::Front),
                "&Front",
                "Shows all of the scene from the front: along y, with z upwards",
                &[char('1')],
            ),
            entry(
                Action::Standard(StandardView::Right),
                "&Right",
                "Shows all of the scene from the right: against x, with z upwards",
                &[char('3')],
            ),
            entry(
                Action::Standard(StandardView::Top),
                "&Top",
                "Shows all of the scene from above: against z, with y upwards",
                &[char('7')],
            ),
            entry(
                Action::Standard(StandardView::Isometric),
                "&Isometric",
                "Shows all of the scene from a corner, along all three axes alike",
                &[char('9')],
            ),
        ],
    },
    Group {
        menu: Menu::View,
        does: "back to the view, fit all, last view",
        entries: &[
            entry(
                Action::Home,
                "&Home",
                "Goes back to the view as it was before any move",
                &[key(KeyCode::Home)],
            ),
            entry(Action::FitAll, "Fit &all", "Shows all of the scene from the same side", &[char('0')]),
            entry(
                Action::LastView,
                "&Last view",
                "Goes back to where the eye was before it jumped; again, to the one before that",
                &[key(KeyCode::Backspace)],
            ),
        ],
    },
    Group {
        menu: Menu::Ray,
        does: "follow one ray; arrows take another",
        entries: &[entry(
            Action::Follow,
            "&Follow",
            "Follows one ray through the stages; arrows take another",
            &[key(KeyCode::F(4))],
        )],
    },
    Group {
        menu: Menu::Ray,
        does: "the lattice that it goes through",
        entries: &[entry(
            Action::Lattice,
            "&Lattice",
            "Shows the lattice from top, front and side, with the cells that the ray enters",
            &[char('v')],
        )],
    },
    Group {
        menu: Menu::Ray,
        does: "its steps: the one before, the next",
        entries: &[
            entry(
                Action::StepBack,
                "Step &back",
                "Goes back to the step before of the ray that is followed",
                &[key(KeyCode::PageUp)],
            ),
            entry(
                Action::StepOn,
                "Step &on",
                "Goes on to the next step of the ray that is followed",
                &[key(KeyCode::PageDown)],
            ),
        ],
    },
    Group {
        menu: Menu::Picture,
        does: "time against accuracy; arrows choose",
        entries: &[entry(
            Action::Trade,
            "T&rade",
            "Measures what each option costs and is worth; arrows go along what no other beats",
            &[key(KeyCode::F(6))],
        )],
    },
    Group {
        menu: Menu::Picture,
        does: "characters; the next set of them",
        entries: &[
            entry(
                Action::Glyphs,
                "&Glyphs...",
                "Chooses the characters of the picture, and shows it in them at once",
                &[key(KeyCode::F(7))],
            ),
            entry(Action::NextGlyphs, "&Next glyphs", "Takes the next set of characters", &[char('g')]),
        ],
    },
    Group {
        menu: Menu::Picture,
        does: "shading model: a term less, more",
        entries: &[
            entry(
                Action::ShadingDown,
                "Shading &less",
                "Takes the shading model with one term less",
                &[char('[')],
            ),
            entry(
                Action::ShadingUp,
                "Shading &more",
                "Takes the shading model with one term more",
                &[char(']')],
            ),
        ],
    },
    Group {
        menu: Menu::File,
        does: "save the picture",
        entries: &[entry(
            Action::Save,
            "&Save...",
            "Saves the picture as text, levels or pixels",
            &[key(KeyCode::F(8))],
        )],
    },
    Group {
        menu: Menu::Picture,
        does: "turbo; without it: slower, faster",
        entries: &[
            entry(
                Action::Turbo,
                "&Turbo",
                "Off, the picture is drawn dot by dot, as the PC/AT drew it",
                &[key(KeyCode::F(5))],
            ),
            entry(Action::Slower, "&Slower", "With Turbo off, takes a slower processor", &[char(',')]),
            entry(Action::Faster, "&Faster", "With Turbo off, takes a faster processor", &[char('.')]),
        ],
    },
    Group {
        menu: Menu::Picture,
        does: "hide the panels, show them",
        entries: &[entry(
            Action::Panels,
            "&Panels",
            "Gives the whole screen to the picture, or brings the panels back",
            &[char('z')],
        )],
    },
    Group {
        menu: Menu::Help,
        does: "menus; close what is open",
        entries: &[
            entry(Action::Menu, "&Menu", "Shows the menus", &[key(KeyCode::F(9))]),
            entry(Action::Close, "&Close", "Closes what is open over the picture", &[key(KeyCode::Esc)]),
        ],
    },
    Group {
        menu: Menu::Help,
        does: "these keys",
        entries: &[entry(Action::Help, "&Keys", "Lists the keys", &[key(KeyCode::F(1)), char('?')])],
    },
    Group {
        menu: Menu::File,
        does: "draw the screen anew, suspend",
        entries: &[
            entry(Action::Redraw, "Draw &anew", "Sends the whole screen once more", &[control('l')]),
            entry(
                Action::Suspend,
                "S&uspend",
                "Gives the terminal back to the shell until it continues the program",
                &[control('z')],
            ),
        ],
    },
    Group {
        menu: Menu::File,
        does: "quit",
        entries: &[entry(
            Action::Quit,
            "&Quit",
            "Ends the program",
            &[key(KeyCode::F(10)), char('q'), control('c')],
        )],
    },
];
