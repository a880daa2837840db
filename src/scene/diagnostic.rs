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
    /// The first note of each kind, and how many there are of it.
    notes: Vec<(Diagnostic, usize)>,
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

    /// Takes a note. Notes with the same message are one, at the place of the first: what a program wrote wrong it wrote
    /// thousands of times.
    pub fn note(&mut self, note: Diagnostic) {
        if let Some(&kind) = self.kinds.get(&note.message) {
            self.notes[kind].1 += 1;
        } else if self.notes.len() < MAX_NOTES {
            self.kinds.insert(note.message.clone(), self.notes.len());
            self.notes.push((note, 1));
        } else {
            self.uncounted_notes += 1;
        }
    }

    /// The note taken first, and how many there are in all.
    pub fn first_note(&self) -> Option<(&Diagnostic, usize)> {
        let (first, _) = self.notes.first()?;
        Some((first, self.notes.iter().map(|(_, count)| count).sum::<usize>() + self.uncounted_notes))
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
        let counted = self.notes.into_iter().map(|(note, count)| match count {
            1 => note,
            _ => Diagnostic { message: format!("{} ({count} times)", note.message), ..note },
        });
        if !self.errors.is_empty() {
            let source_name = source_name.to_owned();
            let mut list: Vec<_> = self.errors.into_iter().chain(counted).collect();
            list.sort_by_key(|diagnostic| diagnostic.span.start);
            return Err(Diagnostics { source_name, source: Arc::from(source), list, stopped });
        }
        let mut notes: Vec<String> = counted
            .map(|note| {
                let detail = if note.label.is_empty() { String::new() } else { format!(": {}", note.label) };
                format!("line {}: {}{detail}", place(source, note.span.start).0, note.message)
            })
            .collect();
        if self.uncounted_notes > 0 {
            notes.push(format!("and {} more notes of other kinds", self.uncounted_notes));
        }
        Ok(notes)
    }
}
