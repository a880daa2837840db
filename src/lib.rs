//! ray13 shows solid models in a text terminal.
//!
//! It ray traces CSG solids exactly, without meshing them, through a lattice of cells, into 13 gray levels of
//! block characters. The modules are the stages of its flow chart, in order; each imports only those above
//! it: see `docs/flow-chart.md` and `docs/architecture.md`.
//!
//! A program reads a scene, makes it ready once ([`frame::Studio`]) and asks for pictures
//! ([`frame::Request`]); a finished [`frame::Frame`] holds the light of every dot and, where they are wanted
//! ([`frame::Wants`]), depth, normal, object and the character cells. As levels a picture is text that a test
//! can hold:
//!
//! ```
//! use ray13::frame::{Request, Studio, Wants};
//! use ray13::glyph::{GlyphMode, Palette};
//! use ray13::math::Size;
//! use ray13::plan::Options;
//! use ray13::scene::{self, ReadOptions};
//! use ray13::tone::Tone;
//!
//! let scene = scene::read("ball.csg", b"sphere(1);", &ReadOptions::default())?;
//! let studio = Studio::new(scene)?;
//! let frame = studio.draw(&Request {
//!     // No view in the scene: all of it, in a picture 1.5 times as wide as high.
//!     camera: studio.camera(0, 1.5),
//!     dots: Size::new(12, 8),
//!     dot_aspect: 1.0, // square dots
//!     options: Options::default(),
//!     wants: Wants::LIGHT,
//!     glyphs: GlyphMode::Shade,
//!     palette: Palette::MONO,
//!     tone: Tone::Lightness,
//! });
//! let mut levels = Vec::new();
//! ray13::output::levels(&frame.levels(Tone::Lightness), &mut levels)?;
//! assert_eq!(
//!     String::from_utf8(levels)?,
//!     "\
//! 00000A900000
//! 000AAAA98000
//! 000ABBA99000
//! 009AAAA98600
//! 008999998600
//! 000899886000
//! 000677655000
//! 000004500000
//! "
//! );
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod math;

pub mod stage;

pub mod scene;

pub mod bvh;

pub mod solid;

pub mod view;

pub mod plan;

pub mod lattice;

pub mod trace;

pub mod shade;

pub mod integrate;

pub mod tone;

pub mod glyph;

pub mod output;

pub mod frame;

pub mod cluster;

pub mod trade;

pub mod tell;

#[cfg(feature = "widget")]
pub mod widget;

#[cfg(feature = "app")]
pub mod app;

#[cfg(feature = "app")]
pub mod cli;
