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

impl Story {
    /// All lines in rows of up to so many columns, of which there are twice as many as a stage's name takes
    /// at least; what is too long for one goes on in the next, a little deeper. No line stands deeper than
    /// half of the room.
    pub fn rows(&self, columns: usize) -> Vec<StoryRow> {
        let mut rows: Vec<StoryRow> = Vec::new();
        let mut last = None;
        for (number, StoryLine { stage, depth, text, .. }) in self.lines.iter().enumerate() {
            // A stage is named where it begins.
            let named = (last != Some((*stage, *depth))).then_some(*stage);
            last = Some((*stage, *depth));
            let room = columns.max(2 * STAGE_COLUMNS) - STAGE_COLUMNS;
            let indent = (DEEPER * depth).min(room / 2);
            let room = room - indent;
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

/// The words in lines of up to so many columns, those behind the first by [`DEEPER`] fewer; a word that is
/// longer is cut.
fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        let mut rest = word.to_owned();
        while !rest.is_empty() {
            let room = if lines.len() > 1 { columns - DEEPER } else { columns };
            let length = rest.chars().count();
            match lines.last_mut() {
                Some(line) if line.chars().count() + 1 + length <= room => {
                    line.push(' ');
                    line.push_str(&rest);
                    rest.clear();
                }
                _ => {
                    let room = if lines.is_empty() { columns } else { columns - DEEPER };
                    let end = rest.char_indices().nth(room).map_or(rest.len(), |(end, _)| end);
                    let behind = rest.split_off(end);
                    lines.push(std::mem::replace(&mut rest, behind));
                }
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_row_is_wider_than_it_may_be_and_no_letter_is_lost() {
        let lines =
            [(0, "it enters \"floor\" through cube 1 at t = 0.123456789012345678901234567890"), (9, "a b")]
                .map(|(depth, text)| StoryLine { stage: Stage::Csg, depth, text: text.to_owned() });
        let story = Story { lines: lines.to_vec() };
        let letters = |text: &str| text.chars().filter(|c| *c != ' ').collect::<String>();
        for columns in [22, 30, 40, 78, usize::MAX] {
            let rows = story.rows(columns);
            assert!(rows.iter().all(|row| row.to_string().chars().count() <= columns), "{columns}: {rows:?}");
            let told: String = rows.iter().map(|row| letters(&row.text)).collect();
            assert_eq!(told, story.lines.iter().map(|line| letters(&line.text)).collect::<String>());
        }
    }
}
