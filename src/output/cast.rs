//! Screens as a recording that asciinema plays: asciicast v2, a line of JSON for the terminal and one for
//! each time that it is sent something (<https://docs.asciinema.org/manual/asciicast/v2/>).

use serde_json::json;

use super::encoder::Encoder;
use crate::glyph::Cell;
use crate::math::{Grid, Size};

/// A recording. Of each screen it holds only what a terminal is sent to turn the one before into it. It has
/// no time of its making, so that the same screens are the same bytes.
#[derive(Debug)]
pub struct Cast {
    encoder: Encoder,
    size: Size,
    /// The screen that it begins with and the last one; none before the first.
    ends: Option<[Grid<Cell>; 2]>,
    lines: String,
}

impl Cast {
    /// One without screens, for a terminal of this size.
    pub fn new(size: Size) -> Self {
        let head = json!({
            "version": 2, "width": size.width, "height": size.height, "env": { "TERM": "xterm-256color" },
        });
        Self { encoder: Encoder::default(), size, ends: None, lines: format!("{head}\n") }
    }

    /// Shows a screen so many seconds after the beginning.
    ///
    /// # Panics
    /// Where it has another size than the terminal: an error of the caller.
    pub fn show(&mut self, screen: &Grid<Cell>, seconds: f64) {
        assert_eq!(screen.size(), self.size, "a recording has screens of one size");
        let mut bytes = String::new();
        match &mut self.ends {
            None => {
                // The cursor would be seen at the end of each frame.
                bytes += "\x1b[?25l";
                self.encoder.clear();
                self.encoder.draw(screen);
                self.ends = Some([screen.clone(), screen.clone()]);
            }
            Some([_, last]) => {
                self.encoder.turn(last, screen);
                last.clone_from(screen);
            }
        }
        bytes += &self.encoder.take();
        self.put(seconds, &bytes);
    }

    /// The recording, which comes back to its first screen at the end, with the cursor below it.
    pub fn finish(mut self, seconds: f64) -> String {
        if let Some([first, last]) = &self.ends {
            self.encoder.turn(last, first);
        }
        let end =
            format!("{}\x1b[m\x1b[{};1H\x1b[?25h", self.encoder.take(), u64::from(self.size.height) + 1);
        self.put(seconds, &end);
        self.lines
    }

    fn put(&mut self, seconds: f64, bytes: &str) {
        // Microseconds, as asciinema itself records.
        self.lines += &format!("[{seconds:.6}, \"o\", {}]\n", json!(bytes));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::Paint;
    use serde_json::Value;

    fn screen(text: &str) -> Grid<Cell> {
        let cell = |glyph| Cell { glyph, ink: Paint::Terminal, paper: Paint::Terminal };
        let cells: Vec<Cell> = text.chars().map(cell).collect();
        Grid::from_values(Size::new(cells.len() as u32, 1), cells)
    }

    #[test]
    fn a_recording_sends_what_has_changed() {
        let mut cast = Cast::new(Size::new(6, 1));
        for (screen, seconds) in [(screen("abcdef"), 0.0), (screen("abXdef"), 0.25), (screen("abXdef"), 0.5)]
        {
            cast.show(&screen, seconds);
        }
        let text = cast.finish(0.75);
        let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        assert_eq!(
            (&lines[0]["version"], &lines[0]["width"], &lines[0]["height"]),
            (&json!(2), &json!(6), &json!(1))
        );
        assert_eq!(lines[1], json!([0.0, "o", "\x1b[?25l\x1b[m\x1b[2J\x1b[Habcdef"]));
        assert_eq!(lines[2], json!([0.25, "o", "\x1b[1;3HX"]));
        assert_eq!(lines[3], json!([0.5, "o", ""]));
        assert_eq!(lines[4], json!([0.75, "o", "\x1b[1;3Hc\x1b[m\x1b[2;1H\x1b[?25h"]));
        assert_eq!(lines.len(), 5);
    }
}
