//! ratatui widgets over a finished frame: the picture and the flow chart; and over what was measured, the
//! plot of time against accuracy. They need a buffer, not a terminal.
//!
//! ```
//! use ratatui_core::{buffer::Buffer, layout::Rect, widgets::Widget};
//! use ray13::frame::{Request, Studio, Wants};
//! use ray13::glyph::{GlyphMode, Palette};
//! use ray13::math::Size;
//! use ray13::plan::Options;
//! use ray13::scene::Scene;
//! use ray13::tone::Tone;
//! use ray13::widget::{FlowChart, PictureWidget};
//!
//! let studio = Studio::new(Scene::default())?;
//! let frame = studio.draw(&Request {
//!     camera: studio.camera(0, 1.0),
//!     dots: Size::new(20, 10),
//!     dot_aspect: 0.5, // one dot per cell, and a cell is half as wide as it is high
//!     options: Options::default(),
//!     wants: Wants::CELLS,
//!     glyphs: GlyphMode::Shade,
//!     palette: Palette::DOS,
//!     tone: Tone::Lightness,
//! });
//!
//! let mut buffer = Buffer::empty(Rect::new(0, 0, 46, 11));
//! FlowChart::new(&frame).render(Rect::new(0, 0, 25, 11), &mut buffer);
//! if let Some(cells) = &frame.cells {
//!     PictureWidget(cells).render(Rect::new(26, 0, 20, 10), &mut buffer);
//! }
//! assert_eq!(buffer[(3, 0)].symbol(), "O"); // of " 1 OBJECTS"
//! # Ok::<(), ray13::solid::AssemblyError>(())
//! ```

mod chart;
pub(crate) mod figures;
mod picture;
mod trade_plot;

pub use chart::FlowChart;
pub use picture::PictureWidget;
pub use trade_plot::TradePlotWidget;
