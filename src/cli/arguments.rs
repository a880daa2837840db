//! The arguments, as clap reads them.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::math::{DVec3, Size};
use crate::scene::{Digits, FacetMode, UpAxis};
use crate::view::TileShare;

use super::formats::{RawChannel, StatsFormat, StillFormat};
use super::names::{
    AntiAliasing, EngineName, Glyphs, PaletteName, PrecisionName, Preset, StructureName, ToneName,
};
use super::up::Up;
use super::values;

/// Shows solid models in a terminal: ray traced, in 13 gray levels of block characters.
///
/// Without a command it opens the viewer, where F1 shows the keys; where output is no terminal it prints a
/// still.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub viewer: ViewerArguments,
}

#[derive(Clone, Debug, Args)]
pub struct ViewerArguments {
    /// The scene: a file of the scene language, OpenSCAD's .csg or NFF, a .scad where OpenSCAD is installed,
    /// a mesh in STL, OFF, PLY or OBJ, - for standard input, or the name of an embedded scene
    pub file: Option<String>,
    /// Print a still in place of the viewer, and again as the scene's files change (the viewer always follows
    /// them)
    #[arg(long)]
    pub watch: bool,
    #[command(flatten)]
    pub reading: ReadingArguments,
    #[command(flatten)]
    pub picture: PictureArguments,
    /// Pictures a second while the eye moves: where one ray a dot takes longer, dots are larger until nothing
    /// moves; 0 for no limit [default: 20]
    #[arg(long, value_name = "N", value_parser = values::not_negative, allow_hyphen_values = true)]
    pub fps: Option<f64>,
    /// Bytes a second that are sent to the terminal at most, on average: pictures come less often for it
    /// [default: as many as the terminal takes]
    #[arg(long, value_name = "N", value_parser = values::positive, allow_hyphen_values = true)]
    pub bytes_per_second: Option<f64>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a still
    Render(RenderArguments),
    /// Measure how long pictures take
    Bench(BenchArguments),
    /// Measure how time trades against accuracy: which options are worth their time on this scene and machine
    Trade(TradeArguments),
    /// Say what a picture requires, stage by stage, what that is expected to cost, and why the rest is left
    /// out
    Plan(PlanArguments),
    /// Follow the ray through one dot, stage by stage, with the numbers that make its light
    Follow(FollowArguments),
    /// Say in words what a view shows: each object with its place in the picture, its size, its distance, and
    /// what it stands before
    Describe(DescribeArguments),
    /// Compare two pictures: exit code 0 where they are the same, 1 where they differ
    Diff(DiffArguments),
    /// Keep the picture of each view of a scene beside it, or compare it with what was kept
    Snapshot(SnapshotArguments),
    /// Join the parts of a still that several machines drew with render --part
    Join(JoinArguments),
    /// Read and validate a scene only
    Check(CheckArguments),
    /// List the embedded scenes, or print one
    Scenes {
        /// The scene to print
        name: Option<String>,
    },
    /// Print the script that makes a shell complete ray13's arguments
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the manual page, for man
    Man {
        /// The command whose page it is [default: the program's]
        command: Option<String>,
    },
}

/// How a scene is read.
#[derive(Clone, Debug, Args)]
pub struct ReadingArguments {
    /// Leave out what OpenSCAD can show and ray13 can not (the viewer always does)
    #[arg(long)]
    pub skip_unsupported: bool,
    /// Memory that a scene may take, as in 500MiB or 2GiB [default: half of the machine's]
    #[arg(long, value_name = "BYTES", value_parser = values::bytes)]
    pub memory: Option<u64>,
    /// A folder of which a scene may import files, besides its own
    #[arg(long, value_name = "DIR", value_parser = values::folder)]
    pub root: Option<PathBuf>,
    /// Curved things of OpenSCAD: smooth, or openscad for the very facets that it exports
    #[arg(long, value_name = "HOW", value_parser = values::facets, default_value = "smooth", hide_default_value = true)]
    pub facets: FacetMode,
    /// Numbers: exact, or six, to half a unit of the sixth digit [default: six in .csg and .scad]
    #[arg(long, value_name = "WHICH", value_parser = values::digits)]
    pub digits: Option<Digits>,
    /// The axis of a mesh file that is up: it is given as `--up`, which commands with a camera have for that
    /// too.
    #[arg(skip)]
    pub up: Option<UpAxis>,
    #[command(flatten)]
    pub openscad: OpenScadArguments,
}

/// What OpenSCAD is told of a program of its own, a `.scad` file.
#[derive(Clone, Debug, Default, Args)]
pub struct OpenScadArguments {
    /// Give a variable of a .scad file this value, as in -D 'size=[1,2,3]'; any number of times
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::definition, allow_hyphen_values = true)]
    pub define: Vec<String>,
    /// A file of parameter sets for a .scad file, as OpenSCAD's customizer writes it
    #[arg(short = 'p', value_name = "FILE", requires = "set")]
    pub parameters: Option<PathBuf>,
    /// The parameter set of that file
    #[arg(short = 'P', value_name = "SET", requires = "parameters")]
    pub set: Option<String>,
    /// Time that OpenSCAD may take for a .scad file, as in 30s [default: 60s]
    #[arg(long, value_name = "TIME", value_parser = values::duration)]
    pub openscad_time: Option<Duration>,
}

#[derive(Clone, Debug, Args)]
pub struct SceneArguments {
    /// The scene: a file, - for standard input, or the name of an embedded scene
    pub file: String,
    #[command(flatten)]
    pub reading: ReadingArguments,
}

#[derive(Clone, Debug, Args)]
pub struct CheckArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// The axis of a mesh file that is up [default: y of OBJ, else z]
    #[arg(long, value_name = "y|z", value_parser = values::up_axis)]
    pub up: Option<UpAxis>,
}

#[derive(Clone, Debug, Args)]
pub struct RenderArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    #[command(flatten)]
    pub picture: PictureArguments,
    /// How the picture is written [default: by the ending of -o; else ans on a terminal, txt elsewhere]
    #[arg(long, value_enum)]
    pub format: Option<StillFormat>,
    /// Raw values: light in png, pgm, ppm and pfm, all others in pfm only [default: light in these]
    #[arg(long, value_enum)]
    pub channel: Option<RawChannel>,
    /// The grays of the 13 levels in png, pgm and ppm, in place of the light's own (as in --preset pcat)
    #[arg(long)]
    pub levels: bool,
    /// Write to this file, never one that the scene is read from; - is standard output, as is nothing
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Draw the still again whenever a file of the scene changes, in its place on a terminal
    #[arg(long)]
    pub watch: bool,
    /// Draw one of N parts of the still, from 1/N, for join: on as many machines as there are parts. --format
    /// says what it is to become [default: png]
    #[arg(long, value_name = "K/N", value_parser = values::share, requires = "output", conflicts_with = "watch")]
    pub part: Option<TileShare>,
    #[command(flatten)]
    pub turn: TurntableArguments,
    /// Say on standard error what was counted and how long it took
    #[arg(long, value_enum)]
    pub stats: Option<StatsFormat>,
}

/// The scene on a turntable.
#[derive(Clone, Debug, Default, Args)]
pub struct TurntableArguments {
    /// Draw N views round the scene, a full turn: as one cast or svg that moves, or as files that a number in
    /// -o tells apart, as in turn-%03d.png. With --part K/N every Nth of these files, from the Kth
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=3600), conflicts_with_all = ["watch", "stats"])]
    pub turntable: Option<u32>,
    /// Views a second of a turntable in cast and svg [default: 12]
    #[arg(long, value_name = "N", value_parser = values::positive, requires = "turntable")]
    pub fps: Option<f64>,
}

#[derive(Clone, Debug, Args)]
pub struct JoinArguments {
    /// The parts, in any order: all of one picture, by one version
    #[arg(required = true, value_name = "PART")]
    pub parts: Vec<PathBuf>,
    /// Write the still to this file; - is standard output, as is nothing. It has the format that the parts
    /// were drawn for
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

#[derive(Clone, Debug, Args)]
pub struct DiffArguments {
    /// The picture before: a .levels file as render --format levels writes it, or a scene
    pub before: String,
    /// The picture after. A scene has the dots of the .levels file that it is compared with, in characters'
    /// cells where they fit
    pub after: String,
    #[command(flatten)]
    pub comparison: ComparisonArguments,
}

#[derive(Clone, Debug, Args)]
pub struct SnapshotArguments {
    /// Scenes; the picture of each of their views is kept beside them, as part.levels or part.VIEW.levels
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<String>,
    /// Keep what has changed and what is new
    #[arg(long)]
    pub update: bool,
    #[command(flatten)]
    pub comparison: ComparisonArguments,
}

/// How scenes are read and drawn for a comparison, and what it forgives.
#[derive(Clone, Debug, Args)]
pub struct ComparisonArguments {
    /// Dots may differ by so many of the 13 levels
    #[arg(long, value_name = "LEVELS", value_parser = clap::value_parser!(u8).range(0..=12), default_value = "0")]
    pub tolerance: u8,
    #[command(flatten)]
    pub reading: ReadingArguments,
    #[command(flatten)]
    pub picture: PictureArguments,
}

#[derive(Clone, Debug, Args)]
pub struct BenchArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    #[command(flatten)]
    pub picture: PictureArguments,
    /// One line of JSON in place of the table
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Debug, Args)]
pub struct TradeArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    #[command(flatten)]
    pub picture: PictureArguments,
    /// Time for all of it; 0 measures the given options alone, however long that takes
    #[arg(long, value_name = "SECONDS", value_parser = values::seconds, default_value = "20", allow_hyphen_values = true)]
    pub seconds: Duration,
    /// Print the command line of the most accurate picture that takes no longer, as in 16ms
    #[arg(long, value_name = "TIME", value_parser = values::duration, allow_hyphen_values = true)]
    pub within: Option<Duration>,
    /// Print the command line of the fastest picture of which no more dots have a wrong level, as in 0.5%
    #[arg(long, value_name = "SHARE", value_parser = values::percent, allow_hyphen_values = true)]
    pub wrong: Option<f64>,
    /// Rays a dot of the reference, a power of two: the same accuracy again, whatever the time [default: as
    /// many as it takes, and the time allows, to tell one percent of wrong levels apart, or --wrong]
    #[arg(long, value_name = "N", value_parser = values::rays, allow_hyphen_values = true)]
    pub rays: Option<u32>,
    /// Measure these options too, against the picture of the others: "--samples 3 --depth 2"; may be given
    /// several times
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    pub with: Vec<String>,
    /// One line of JSON in place of the table
    #[arg(long, conflicts_with_all = ["format", "output", "within", "wrong"])]
    pub json: bool,
    /// The plot as a picture in place of the table [default: by the ending of -o]
    #[arg(long, value_enum, conflicts_with_all = ["within", "wrong"])]
    pub format: Option<PlotFormat>,
    /// Write the plot to this file; - is standard output
    #[arg(short, long, value_name = "FILE", conflicts_with_all = ["within", "wrong"])]
    pub output: Option<PathBuf>,
}

/// Forms of a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PlotFormat {
    /// Lines and marks at any size
    Svg,
    /// The plot of the terminal, in pixels
    Png,
}

#[derive(Clone, Debug, Args)]
pub struct DescribeArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    #[command(flatten)]
    pub picture: PictureArguments,
    /// One line of JSON in place of the text
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Debug, Args)]
pub struct FollowArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// The dot's column, from 0 at the left
    #[arg(allow_negative_numbers = true)]
    pub column: u32,
    /// The dot's row, from 0 at the top
    #[arg(allow_negative_numbers = true)]
    pub row: u32,
    #[command(flatten)]
    pub picture: PictureArguments,
    /// One line of JSON in place of the text
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Debug, Args)]
pub struct PlanArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    #[command(flatten)]
    pub picture: PictureArguments,
    /// Draw the picture once, and say what each stage did cost and count
    #[arg(long)]
    pub run: bool,
    /// One line of JSON in place of the table
    #[arg(long)]
    pub json: bool,
}

/// What decides the picture.
#[derive(Clone, Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "one for each switch")]
pub struct PictureArguments {
    /// Options that belong together; any that is given besides has the last word
    #[arg(long, value_enum)]
    pub preset: Option<Preset>,
    /// Size of a still in character cells; the viewer fills its terminal [default: the terminal's, else
    /// 80x25; of png, pgm, ppm and pfm --dots 640x400]
    #[arg(long, value_name = "WxH", value_parser = values::size, allow_hyphen_values = true)]
    pub cells: Option<Size>,
    /// Size of a still in traced dots, which are then square
    #[arg(long, value_name = "WxH", value_parser = values::size, allow_hyphen_values = true, conflicts_with = "cells")]
    pub dots: Option<Size>,
    #[command(flatten)]
    pub camera: CameraArguments,
    /// The paper's illumination model: 1 diffuse, 2 with depth (in a scene with `world(k = …)`), 3 with
    /// highlights, 4 with mirrors and glass [default: 4]
    #[arg(long, value_name = "1..4", value_parser = clap::value_parser!(u8).range(1..=4), allow_hyphen_values = true)]
    pub shading: Option<u8>,
    /// Follow mirror and Snell rays for so many generations [default: 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=64), allow_hyphen_values = true)]
    pub depth: Option<u32>,
    /// Follow a mirror or Snell ray only while it can still change the light of its dot by so much; 0 follows
    /// all [default: 0.011]
    #[arg(long, value_name = "F", value_parser = values::not_negative, allow_hyphen_values = true)]
    pub cutoff: Option<f64>,
    /// Lights shine through everything
    #[arg(long)]
    pub no_shadows: bool,
    /// Lights are hidden by what stands before them, as they are unless a preset says otherwise
    #[arg(long, overrides_with = "no_shadows")]
    pub shadows: bool,
    /// Rays per dot along each axis [default: 1; 4 with --aa fixed]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64), allow_hyphen_values = true)]
    pub samples: Option<u32>,
    /// Which dots get more than one ray: none; each as many; those whose gray level one does not decide
    /// [default: off, fixed with --samples, adaptive with --error]
    #[arg(long, value_enum, value_name = "WHICH")]
    pub aa: Option<AntiAliasing>,
    /// Error of a dot that is small enough, as a share of a gray level [default: 0.0625]
    #[arg(long, value_name = "F", value_parser = values::above_zero, allow_hyphen_values = true)]
    pub error: Option<f64>,
    /// How space is cut into cells [default: auto]
    #[arg(long, value_enum)]
    pub structure: Option<StructureName>,
    /// What traces; with --precision double the picture is the same
    #[arg(long, value_enum, default_value = "auto")]
    pub engine: EngineName,
    /// Precision of what rays from the eye meet; the exact engine always has double
    #[arg(long, value_enum, default_value = "auto")]
    pub precision: PrecisionName,
    /// Characters of the picture [default: auto]
    #[arg(long, value_enum)]
    pub glyphs: Option<Glyphs>,
    /// Colours of the picture [default: dos; mono in txt, where `NO_COLOR` is set, and where the terminal has
    /// no grays]
    #[arg(long, value_enum)]
    pub palette: Option<PaletteName>,
    /// For light backgrounds: puts the terminal's own ink where the picture is dark, in mono, ascii and
    /// braille. The viewer asks the terminal, and needs this only where it does not answer
    #[arg(long)]
    pub invert: bool,
    /// Puts ink where the picture is light, whatever the terminal answers
    #[arg(long, conflicts_with = "invert")]
    pub no_invert: bool,
    /// How light becomes a level [default: lightness]
    #[arg(long, value_enum)]
    pub tone: Option<ToneName>,
    /// Worker threads [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_hyphen_values = true)]
    pub threads: Option<u16>,
}

impl Arguments {
    /// Moves what `--up` says of mesh files from the camera to how scenes are read.
    pub fn settle_up(&mut self) {
        let (reading, camera) = match &mut self.command {
            None => (&mut self.viewer.reading, &mut self.viewer.picture.camera),
            Some(Command::Render(a)) => (&mut a.scene.reading, &mut a.picture.camera),
            Some(Command::Bench(a)) => (&mut a.scene.reading, &mut a.picture.camera),
            Some(Command::Plan(a)) => (&mut a.scene.reading, &mut a.picture.camera),
            Some(Command::Describe(a)) => (&mut a.scene.reading, &mut a.picture.camera),
            Some(Command::Follow(a)) => (&mut a.scene.reading, &mut a.picture.camera),
            Some(Command::Trade(a)) => (&mut a.scene.reading, &mut a.picture.camera),
            Some(Command::Diff(a)) => (&mut a.comparison.reading, &mut a.comparison.picture.camera),
            Some(Command::Snapshot(a)) => (&mut a.comparison.reading, &mut a.comparison.picture.camera),
            Some(Command::Check(a)) => {
                a.scene.reading.up = a.up;
                return;
            }
            Some(
                Command::Join(_) | Command::Scenes { .. } | Command::Completions { .. } | Command::Man { .. },
            ) => return,
        };
        if let Some(axis) = camera.up.and_then(Up::axis) {
            reading.up = Some(axis);
            camera.up = None;
        }
    }
}

/// Where the picture is seen from. What is not given is the view's.
#[derive(Clone, Debug, Args)]
pub struct CameraArguments {
    /// A view of the scene, by its name [default: the first; the whole scene where it has none]
    #[arg(long, value_name = "NAME")]
    pub view: Option<String>,
    /// The viewpoint
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, allow_hyphen_values = true)]
    pub eye: Option<DVec3>,
    /// The point looked at
    #[arg(long, value_name = "X,Y,Z", value_parser = values::point, allow_hyphen_values = true)]
    pub target: Option<DVec3>,
    /// Upwards in the picture; or the axis of a mesh file that is up [default: y of OBJ, else z]
    #[arg(long, value_name = "X,Y,Z|y|z", value_parser = values::up, allow_hyphen_values = true)]
    pub up: Option<Up>,
    /// Full angles across and down, in degrees; the picture contains them
    #[arg(long, value_name = "AxB", value_parser = values::field, allow_hyphen_values = true)]
    pub field: Option<[f64; 2]>,
    /// Divides the tangents of both angles
    #[arg(long, value_name = "F", value_parser = values::positive, allow_hyphen_values = true)]
    pub zoom: Option<f64>,
}
