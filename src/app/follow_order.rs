//! A dot whose ray is to be followed, and what came of it.

use std::sync::Arc;

use super::Painter;
use crate::frame::{FollowedRay, Request};
use crate::tell::Story;

/// A dot of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowOrder {
    /// The picture.
    pub request: Request,
    /// The dot: column and row.
    pub dot: [u32; 2],
}

/// The ray of a dot, and its story.
#[derive(Clone, Debug)]
pub struct FollowedDot {
    /// Whose ray it is.
    pub order: FollowOrder,
    /// Absent where there is nothing to follow.
    pub ray: Option<Arc<(FollowedRay, Story)>>,
}

impl FollowOrder {
    /// Follows it.
    pub fn follow(self, painter: &dyn Painter) -> FollowedDot {
        let followed = painter.follow(&self.request, self.dot);
        let told = followed.map(|followed| {
            let story = Story::new(&followed, &self.request, painter.scene(), None);
            Arc::new((followed, story))
        });
        FollowedDot { order: self, ray: told }
    }
}
