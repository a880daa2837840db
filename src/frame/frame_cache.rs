//! The last picture, as the studio keeps it.

use std::sync::OnceLock;

use crate::integrate::TileHits;
use crate::plan::Precision;

use super::{Frame, Request};

/// What the rays from the eye met, by the precision in which they were traced.
#[derive(Debug, Default)]
pub(super) struct Hits {
    single: OnceLock<Tiles>,
    double: OnceLock<Tiles>,
}

/// By tile; nothing yet of a tile that was not traced since it is kept.
type Tiles = Box<[OnceLock<TileHits>]>;

impl Hits {
    /// Those that were traced in this precision, or room for them in as many tiles.
    pub fn of(&self, precision: Precision, tiles: usize) -> &[OnceLock<TileHits>] {
        let kept = match precision {
            Precision::Single => &self.single,
            Precision::Double => &self.double,
        };
        kept.get_or_init(|| std::iter::repeat_with(OnceLock::new).take(tiles).collect())
    }
}

/// What is left of the last picture.
#[derive(Debug)]
pub(super) struct FrameCache {
    pub request: Request,
    /// All that was made of it; absent where the scene has another light since.
    pub frame: Option<Frame>,
    /// What its dots see, where another picture had the same view before.
    pub hits: Option<Hits>,
}

impl FrameCache {
    /// Forgets the picture's light, and not what its dots see.
    pub fn forget_light(&mut self) {
        self.frame = None;
    }
}
