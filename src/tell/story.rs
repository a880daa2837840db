//! The events of a ray, as lines and in rows.

use std::fmt;

use crate::frame::{FollowedRay, Frame, Request};
use crate::scene::Scene;
use crate::stage::Stage;

use super::line::StoryLine;
use super::teller::told;

/// What each stage makes of one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Story {
    /// In order.
    pub lines: Vec<StoryLine>,
}

impl Story {
    /// Tells what happened to a ray of a picture of `scene`; and what its dot became in that picture, where
    /// it is there.
    pub fn new(followed: &FollowedRay, request: &Request, scene: &Scene, frame: Option<&Frame>) -> Self {
        Self { lines: told(followed, request, scene, frame) }
    }
}

impl fmt::Display for Story {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.rows(usize::MAX).iter().try_for_each(|row| writeln!(f, "{row}"))
    }
}

/// A row of a story that is laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct StoryRow {
    /// The line that it belongs to, by its number.
    pub line: usize,
    /// The number and the name of the stage where that begins.
    pub stage: Option<Stage>,
    /// What is done, or more of it, behind blanks by its depth.
    pub text: String,
}

/// Columns of a stage's number and name, with a blank behind them.
const STAGE_COLUMNS: usize = 11;

/// Columns by which a ray that is sent on stands deeper.
const DEEPER: usize = 2;

/// The fewest columns in which words are put side by side.
const LEAST: usize = 24;

impl Story {
    /// All lines in rows of so many columns, but for words that are longer; what is too long for one goes on
    /// in the next, a little deeper.
    pub fn rows(&self, columns: usize) -> Vec<StoryRow> {
        let mut rows: Vec<StoryRow> = Vec::new();
        let mut last = None;
        for (number, StoryLine { stage, depth, text, .. }) in self.lines.iter().enumerate() {
            // A stage is named where it begins.
            let named = (last != Some((*stage, *depth))).then_some(*stage);
            last = Some((*stage, *depth));
            let indent = DEEPER * depth;
            let room = columns.saturating_sub(STAGE_COLUMNS + indent).max(LEAST);
            for (part, words) in wrapped(text, room).into_iter().enumerate() {
                let more = if part > 0 { DEEPER } else { 0 };
                let stage = named.filter(|_| part == 0);
                rows.push(StoryRow { line: number, stage, text: " ".repeat(indent + more) + &words });
            }
        }
        rows
    }
}

impl fmt::Display for StoryRow {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let name =
            self.stage.map_or_else(String::new, |stage| format!("{:>2} {}", stage.number(), stage.name()));
        write!(f, "{name:STAGE_COLUMNS$}{}", self.text)
    }
}

/// The words in lines of up to so many columns, those behind the first by [`DEEPER`] fewer.
fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        let room = if lines.len() > 1 { columns.saturating_sub(DEEPER) } else { columns };
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
