//! ray13 shows solid models in a text terminal.
//!
//! It ray traces CSG solids exactly, without meshing them, through a lattice of cells, into 13 gray levels of
//! block characters. The modules are the stages of its flow chart, in order; each imports only those above it:
//! see `docs/flow-chart.md` and `docs/architecture.md`.

pub mod math;

pub mod stage;

pub mod scene;

pub mod solid;

pub mod view;

pub mod plan;

pub mod lattice;

pub mod trace;

pub mod shade;

pub mod tone;

pub mod glyph;

pub mod output;

pub mod frame;

#[cfg(feature = "widget")]
pub mod widget;

#[cfg(feature = "app")]
pub mod app;

#[cfg(feature = "app")]
pub mod cli;
