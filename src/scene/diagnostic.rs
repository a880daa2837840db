//! What is wrong with an input, where, and what to do about it.

use std::collections::HashMap;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// How much a [`Diagnostic`] matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The input can not be used.
    Error,
    /// The input is used, but not all of it as it is written.
    Note,
}

/// One remark on a place in the source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether the input can still be used.
    pub severity: Severity,
    /// The cause, as one sentence without a full stop.
    pub message: String,
    /// Bytes of the source, on character boundaries; empty where the whole input is meant.
    pub span: Range<usize>,
    /// What stands at the place; may be empty.
    pub label: String,
    /// What to do, where that is known.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error at a place.
    pub fn error(span: impl Into<Range<usize>>, message: impl Into<String>) -> Self {
        let (severity, label, help) = (Severity::Error, String::new(), None);
        Self { severity, message: message.into(), span: span.into(), label, help }
    }

    /// A note at a place.
    pub fn note(span: impl Into<Range<usize>>, message: impl Into<String>) -> Self {
        Self { severity: Severity::Note, ..Self::error(span, message) }
    }

    /// The same with words for the place itself.
    #[must_use]
    pub fn label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    /// The same with advice.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// Why an input could not be read: at least one error, in the order of their places.
///
/// Its [`Display`](fmt::Display) is plain text, `file:line:column: error: …` and the advice, a line each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics {
    /// The file's name, or another name for the source.
    pub source_name: String,
    /// The text that the spans are of; empty where the input is no text.
    pub source: Arc<str>,
    /// What was found: at most 20 errors, and as many notes.
    pub list: Vec<Diagnostic>,
    /// Whether reading stopped early because there were too many errors.
    pub stopped: bool,
}

/// After so many errors a reader stops: nobody reads on, and a hostile file must not cost more.
pub const MAX_ERRORS: usize = 20;

/// After so many notes the others are only counted.
const MAX_NOTES: usize = 20;

impl Diagnostics {
    /// A single error about an input as a whole, or one that is no text.
    pub fn whole(source_name: &str, diagnostic: Diagnostic) -> Self {
        let source_name = source_name.to_owned();
        Self { source_name, source: Arc::from(""), list: vec![diagnostic], stopped: false }
    }

    /// Line and column of a byte of the source, both from 1; columns count characters.
    pub fn place(&self, offset: usize) -> (usize, usize) {
        place(&self.source, offset)
    }
}

fn place(source: &str, offset: usize) -> (usize, usize) {
    // A place that is none is taken as the end.
    let before = source.get(..offset).unwrap_or(source);
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    let line = before.split('\n').count();
    (line, 1 + before[line_start..].chars().count())
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.list.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{}:", self.source_name)?;
            if !diagnostic.span.is_empty() {
                let (line, column) = self.place(diagnostic.span.start);
                write!(f, "{line}:{column}:")?;
            }
            let severity = match diagnostic.severity {
                Severity::Error => "error",
                Severity::Note => "note",
            };
            write!(f, " {severity}: {}", diagnostic.message)?;
            if !diagnostic.label.is_empty() {
                write!(f, ": {}", diagnostic.label)?;
            }
            if let Some(help) = &diagnostic.help {
                write!(f, "\n  help: {help}")?;
            }
        }
        if self.stopped {
            write!(f, "\nreading stopped after {MAX_ERRORS} errors")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

/// Proof that an error went to the [`Sink`]: who gets it has nothing more to report.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reported;

/// Where a reader's remarks go while it reads.
#[derive(Debug, Default)]
pub(crate) struct Sink {
    errors: Vec<Diagnostic>,
    /// The notes, one of each kind.
    notes: Vec<Kind>,
    /// By message: the kind's place in `notes`.
    kinds: HashMap<String, usize>,
    /// Notes of kinds for which there was no place.
    uncounted_notes: usize,
    /// Whether what is wrong with a part of the input leaves that part out, in place of an error.
    leaves_out: bool,
}

impl Sink {
    /// A sink for an input whose wrong parts are left out, where that is wanted.
    pub fn new(leaves_out: bool) -> Self {
        Self { leaves_out, ..Self::default() }
    }

    /// Whether what is wrong with a part of the input leaves that part out, with a note.
    pub fn leaves_out(&self) -> bool {
        self.leaves_out
    }

    /// Takes an error.
    pub fn report(&mut self, diagnostic: Diagnostic) -> Reported {
        if !self.is_full() {
            self.errors.push(diagnostic);
        }
        Reported
    }

    /// Takes a note. Notes with the same message are one, at the place of the first: what a program wrote
    /// wrong it wrote thousands of times.
    pub fn note(&mut self, note: Diagnostic) {
        if let Some(&kind) = self.kinds.get(&note.message) {
            self.notes[kind].add(note.span.start);
        } else if self.notes.len() < MAX_NOTES {
            self.kinds.insert(note.message.clone(), self.notes.len());
            self.notes.push(Kind { starts: vec![note.span.start], count: 1, first: note });
        } else {
            self.uncounted_notes += 1;
        }
    }

    /// The note taken first, and how many there are in all.
    pub fn first_note(&self) -> Option<(&Diagnostic, usize)> {
        let first = &self.notes.first()?.first;
        Some((first, self.notes.iter().map(|kind| kind.count).sum::<usize>() + self.uncounted_notes))
    }

    /// Whether a reader should stop.
    pub fn is_full(&self) -> bool {
        self.errors.len() >= MAX_ERRORS
    }

    /// Whether nothing speaks against using the input so far.
    pub fn is_clean(&self) -> bool {
        self.errors.is_empty()
    }

    /// The notes as sentences, where there was no error; else all remarks.
    pub fn finish(self, source_name: &str, source: &str) -> Result<Vec<String>, Diagnostics> {
        let stopped = self.is_full();
        let lines = Lines::of(source, self.notes.iter().flat_map(|kind| kind.starts.iter().copied()));
        let counted: Vec<_> = self.notes.into_iter().map(|kind| kind.counted(&lines)).collect();
        if !self.errors.is_empty() {
            let source_name = source_name.to_owned();
            let mut list: Vec<_> = self.errors.into_iter().chain(counted).collect();
            list.sort_by_key(|diagnostic| diagnostic.span.start);
            return Err(Diagnostics { source_name, source: Arc::from(source), list, stopped });
        }
        let mut notes: Vec<String> = counted
            .into_iter()
            .map(|note| {
                let detail = if note.label.is_empty() { String::new() } else { format!(": {}", note.label) };
                format!("line {}: {}{detail}", lines.line(note.span.start), note.message)
            })
            .collect();
        if self.uncounted_notes > 0 {
            notes.push(format!("and {} more notes of other kinds", self.uncounted_notes));
        }
        Ok(notes)
    }
}

/// Notes that say the same of several places.
#[derive(Debug)]
struct Kind {
    first: Diagnostic,
    count: usize,
    /// Where the first few of them stand.
    starts: Vec<usize>,
}

impl Kind {
    /// How many places are kept.
    const SHOWN: usize = 5;

    fn add(&mut self, start: usize) {
        self.count += 1;
        if self.starts.len() < Self::SHOWN {
            self.starts.push(start);
        }
    }

    /// One note for all, which says how many there are, and in which lines the first of them.
    fn counted(self, lines: &Lines) -> Diagnostic {
        let mut numbers: Vec<usize> = self.starts.iter().map(|&start| lines.line(start)).collect();
        numbers.dedup();
        let place = match (self.count, numbers.as_slice()) {
            (1, _) => return self.first,
            (_, [_]) => String::new(),
            (count, [numbers @ .., last]) if count == self.starts.len() => {
                let numbers: Vec<_> = numbers.iter().map(usize::to_string).collect();
                format!(", in lines {} and {last}", numbers.join(", "))
            }
            (_, numbers) => {
                let numbers: Vec<_> = numbers.iter().take(4).map(usize::to_string).collect();
                format!(", in lines {} and on", numbers.join(", "))
            }
        };
        let message = format!("{} ({} times{place})", self.first.message, self.count);
        Diagnostic { message, ..self.first }
    }
}

/// The lines of a few places of a text, counted in one go through it: texts may be long.
#[derive(Debug)]
struct Lines(HashMap<usize, usize>);

impl Lines {
    fn of(source: &str, starts: impl Iterator<Item = usize>) -> Self {
        let mut starts: Vec<_> = starts.collect();
        starts.sort_unstable();
        let (mut line, mut from) = (1, 0);
        let counted = starts.into_iter().map(|start| {
            let between = source.get(from..start).unwrap_or_default();
            line += between.matches('\n').count();
            from = start;
            (start, line)
        });
        Self(counted.collect())
    }

    /// The line of a place, from 1.
    fn line(&self, start: usize) -> usize {
        self.0.get(&start).copied().unwrap_or(1)
    }
}
