//! Tokens to events: calls that begin and end, one after the other.
//!
//! The first error of the grammar ends the parse, because what follows would mostly be echoes of it.
//! Nothing here recurses: what is open stands in a list, so that no input overflows the stack.

mod escapes;
mod mistakes;
mod value;

use super::lexer::{Lexer, Token, TokenKind};
use super::nearest::{nearest, quoted};
use super::syntax::{Argument, Call, Modifiers, Name, SyntaxEvent, TextSpan};
use super::vocabulary::{FRAGMENT_SETTINGS, PROGRAM_WORDS};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::memory::Memory;

/// Braces, chained calls and brackets may be nested so deep: programs write 267 levels, OpenSCAD reads some
/// 600.
pub const MAX_DEPTH: usize = 2000;

const EXPORT: &str = "arithmetic, variables and modules are OpenSCAD's work: \
     name the file part.scad, or export it as .csg (openscad -o part.csg part.scad)";

/// Reads a text event by event.
pub struct Parser<'a> {
    lexer: Lexer<'a>,
    /// The token that comes next.
    token: Token<'a>,
    /// The place of the token taken last.
    previous: TextSpan,
    /// The calls that are open, the outermost first.
    open: Vec<Level>,
    /// Whether the call that ended last ends those in whose chain it stands, too.
    is_ending: bool,
    /// The memory of arguments that nobody needs any more.
    spare: Vec<Argument<'a>>,
    /// Bytes of the values of the call that is read.
    value_bytes: u64,
}

/// How the children of an open call are written.
#[derive(Clone, Copy, Debug)]
enum Level {
    /// In braces, of which this is the first.
    Block(TextSpan),
    /// As one call.
    Chain,
}

/// What the parser works for: where its errors go, and how much memory it may take.
pub struct Reading<'s> {
    pub sink: &'s mut Sink,
    pub memory: &'s mut Memory,
}

impl<'a> Parser<'a> {
    pub fn new(source: &'a str) -> Self {
        let mut lexer = Lexer::new(source);
        let token = lexer.next();
        let (open, spare) = (Vec::new(), Vec::new());
        Self { lexer, token, previous: token.span, open, is_ending: false, spare, value_bytes: 0 }
    }

    /// The next event; none after the last.
    pub fn next(&mut self, reading: &mut Reading<'_>) -> Result<Option<SyntaxEvent<'a>>, Reported> {
        loop {
            match self.open.last() {
                Some(Level::Chain) if self.is_ending => {
                    self.open.pop();
                    return Ok(Some(SyntaxEvent::Close));
                }
                Some(Level::Chain) => return self.call(reading).map(Some),
                Some(&Level::Block(opener)) => {
                    self.is_ending = false;
                    if self.takes('}') {
                        self.open.pop();
                        self.is_ending = true;
                        return Ok(Some(SyntaxEvent::Close));
                    }
                    if self.token.kind == TokenKind::End {
                        let error =
                            Diagnostic::error(opener, "this `{` is never closed").label("opened here");
                        return Err(reading.sink.report(error.help("add a `}` where the block ends")));
                    }
                }
                None if self.token.kind == TokenKind::End => return Ok(None),
                None if self.is('}') => {
                    let error = Diagnostic::error(self.token.span, "this `}` closes nothing");
                    let help = "remove it, or look for a `{` that is missing above";
                    return Err(reading.sink.report(error.help(help)));
                }
                None => self.is_ending = false,
            }
            if self.takes(';') {
                continue;
            }
            if let TokenKind::Word = self.token.kind
                && self.lexer.clone().next().kind == TokenKind::Sign('=')
            {
                match self.assignment(reading)? {
                    Some(event) => return Ok(Some(event)),
                    None => continue,
                }
            }
            return self.call(reading).map(Some);
        }
    }

    /// Takes the memory of a call that has been used.
    pub fn recycle(&mut self, call: Call<'a>) {
        // Of a long list it is given back: the next calls are short.
        const KEPT: usize = 64;
        let mut arguments = call.arguments;
        if arguments.capacity() <= KEPT {
            arguments.clear();
            self.spare = arguments;
        }
    }

    fn take(&mut self) -> Token<'a> {
        let token = self.token;
        self.previous = token.span;
        self.token = self.lexer.next();
        token
    }

    fn is(&self, sign: char) -> bool {
        self.token.kind == TokenKind::Sign(sign)
    }

    fn takes(&mut self, sign: char) -> bool {
        let found = self.is(sign);
        if found {
            self.take();
        }
        found
    }

    /// Whether one more level may be opened, with the place that a message about too many levels points at.
    fn descend(&self, lists: usize, place: TextSpan, sink: &mut Sink) -> Result<(), Reported> {
        if self.open.len() + lists < MAX_DEPTH {
            return Ok(());
        }
        let error = Diagnostic::error(place, format!("nested deeper than {MAX_DEPTH} levels"));
        Err(sink
            .report(error.label("one level too many").help("put parts side by side, not inside each other")))
    }

    /// An assignment, which is an event where it has a meaning.
    fn assignment(&mut self, reading: &mut Reading<'_>) -> Result<Option<SyntaxEvent<'a>>, Reported> {
        let word = self.take();
        let name = Name { text: word.text, span: word.span };
        let quoted = quoted(name.text);
        let is_passed_over = reading.sink.leaves_out() && name.text.starts_with('$');
        let is_known = FRAGMENT_SETTINGS.contains(&name.text);
        if !is_known && !is_passed_over {
            let error = Diagnostic::error(name.span, format!("`{quoted}` can not be set here"));
            let help = match nearest(name.text, FRAGMENT_SETTINGS).filter(|_| name.text.starts_with('$')) {
                Some(right) => format!("did you mean `{right}`?"),
                None => EXPORT.into(),
            };
            return Err(reading.sink.report(error.label("only $fn, $fa and $fs are").help(help)));
        }
        if !self.open.is_empty() {
            let error = Diagnostic::error(name.span, format!("`{quoted}` is set inside braces"));
            let help =
                format!("set it at the top level, or give it to one word: `cylinder(h = 1, {quoted} = 6);`");
            return Err(reading.sink.report(error.help(help)));
        }
        self.take();
        self.value_bytes = 0;
        let value = self.value(reading)?;
        if !self.takes(';') {
            return Err(self.expected("`;` after the assignment", reading.sink));
        }
        if !is_known {
            reading.sink.note(Diagnostic::note(name.span, format!("`{quoted}` has no effect")));
            return Ok(None);
        }
        Ok(Some(SyntaxEvent::Assignment(name, value)))
    }

    fn call(&mut self, reading: &mut Reading<'_>) -> Result<SyntaxEvent<'a>, Reported> {
        let mut modifiers = Modifiers::default();
        while let TokenKind::Sign(sign @ ('*' | '!' | '#' | '%')) = self.token.kind {
            modifiers.disable |= sign == '*';
            modifiers.root |= sign == '!';
            modifiers.background |= sign == '%';
            self.take();
        }
        let mut arguments = std::mem::take(&mut self.spare);
        if self.is('{') {
            // Braces alone are OpenSCAD's group without its name.
            let span = self.token.span;
            let is_ended = self.children(reading.sink)?;
            let name = Name { text: "group", span };
            return Ok(SyntaxEvent::Open(Call { modifiers, name, parentheses: span, arguments, is_ended }));
        }
        if self.token.kind != TokenKind::Word {
            return Err(self.expected("a word such as `sphere` or `union`", reading.sink));
        }
        let word = self.take();
        let name = Name { text: word.text, span: word.span };
        if PROGRAM_WORDS.contains(&name.text) {
            let error =
                Diagnostic::error(name.span, format!("`{}` belongs to OpenSCAD's programs", name.text));
            return Err(reading.sink.report(error.help(EXPORT)));
        }
        let parentheses = self.arguments(name, &mut arguments, reading)?;
        let is_ended = self.children(reading.sink)?;
        Ok(SyntaxEvent::Open(Call { modifiers, name, parentheses, arguments, is_ended }))
    }

    fn arguments(
        &mut self,
        name: Name<'a>,
        arguments: &mut Vec<Argument<'a>>,
        reading: &mut Reading<'_>,
    ) -> Result<TextSpan, Reported> {
        let opener = self.token.span;
        if !self.takes('(') {
            return Err(self.expected(&format!("`(` after `{}`", quoted(name.text)), reading.sink));
        }
        self.value_bytes = 0;
        while !self.takes(')') {
            arguments.push(self.argument(reading)?);
            if !self.takes(',') && !self.is(')') {
                return Err(self.expected_in("`,` or `)`", opener, '(', reading.sink));
            }
            self.keep(size_of::<Argument<'_>>(), reading)?;
        }
        Ok(opener.to(self.previous))
    }

    fn argument(&mut self, reading: &mut Reading<'_>) -> Result<Argument<'a>, Reported> {
        let named =
            self.token.kind == TokenKind::Word && self.lexer.clone().next().kind == TokenKind::Sign('=');
        let name = named.then(|| {
            let word = self.take();
            self.take();
            Name { text: word.text, span: word.span }
        });
        Ok(Argument { name, value: self.value(reading)? })
    }

    /// What follows the arguments: `;`, a block, or one call. Tells whether it is the `;`.
    fn children(&mut self, sink: &mut Sink) -> Result<bool, Reported> {
        if self.takes(';') {
            self.is_ending = true;
            return Ok(true);
        }
        let place = self.token.span;
        let level = match self.token.kind {
            TokenKind::Sign('{') => Level::Block(place),
            TokenKind::Word | TokenKind::Sign('*' | '!' | '#' | '%') => Level::Chain,
            _ => return Err(self.expected("`;`, `{` or another word", sink)),
        };
        self.descend(0, place, sink)?;
        if matches!(level, Level::Block(_)) {
            self.take();
        }
        self.open.push(level);
        self.is_ending = false;
        Ok(false)
    }

    /// Counts a part of a value that is kept; an error where that is more than there may be.
    fn keep(&mut self, bytes: usize, reading: &mut Reading<'_>) -> Result<(), Reported> {
        self.value_bytes += bytes as u64;
        // A list grows by doubling: up to twice its own.
        if reading.memory.has_room_for(2 * self.value_bytes) {
            return Ok(());
        }
        Err(reading.memory.refuse(2 * self.value_bytes, self.previous.end, reading.sink))
    }
}
