//! Tokens to events: calls that begin and end, one after the other.
//!
//! The first error of the grammar ends the parse, because what follows would mostly be echoes of it.
//! Nothing here recurses: what is open stands in a list, so that no input overflows the stack.

use std::borrow::Cow;

use super::lexer::{Lexer, Token, TokenKind};
use super::nearest::{nearest, quoted};
use super::syntax::{Argument, Call, Event, Modifiers, Name, Span, Spanned, Value};
use super::vocabulary::{FRAGMENT_SETTINGS, PROGRAM_WORDS};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::memory::Memory;

/// Braces, chained calls and brackets may be nested so deep: programs write 267 levels, OpenSCAD reads some 600.
pub const MAX_DEPTH: usize = 2000;

/// Lists inside so many lists are not kept: the deepest that a word takes are the rows of a list.
const KEPT_LISTS: usize = 4;

const EXPORT: &str = "arithmetic, variables and modules are OpenSCAD's work: \
     export the file as .csg (openscad -o part.csg part.scad)";

/// Reads a text event by event.
pub struct Parser<'a> {
    lexer: Lexer<'a>,
    /// The token that comes next.
    token: Token<'a>,
    /// The place of the token taken last.
    previous: Span,
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
    Block(Span),
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
    pub fn next(&mut self, reading: &mut Reading<'_>) -> Result<Option<Event<'a>>, Reported> {
        loop {
            match self.open.last() {
                Some(Level::Chain) if self.is_ending => {
                    self.open.pop();
                    return Ok(Some(Event::Close));
                }
                Some(Level::Chain) => return self.call(reading).map(Some),
                Some(&Level::Block(opener)) => {
                    self.is_ending = false;
                    if self.takes('}') {
                        self.open.pop();
                        self.is_ending = true;
                        return Ok(Some(Event::Close));
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
    fn descend(&self, lists: usize, place: Span, sink: &mut Sink) -> Result<(), Reported> {
        if self.open.len() + lists < MAX_DEPTH {
            return Ok(());
        }
        let error = Diagnostic::error(place, format!("nested deeper than {MAX_DEPTH} levels"));
        Err(sink
            .report(error.label("one level too many").help("put parts side by side, not inside each other")))
    }

    /// An assignment, which is an event where it has a meaning.
    fn assignment(&mut self, reading: &mut Reading<'_>) -> Result<Option<Event<'a>>, Reported> {
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
        Ok(Some(Event::Assignment(name, value)))
    }

    fn call(&mut self, reading: &mut Reading<'_>) -> Result<Event<'a>, Reported> {
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
            return Ok(Event::Open(Call { modifiers, name, parentheses: span, arguments, is_ended }));
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
        Ok(Event::Open(Call { modifiers, name, parentheses, arguments, is_ended }))
    }

    fn arguments(
        &mut self,
        name: Name<'a>,
        arguments: &mut Vec<Argument<'a>>,
        reading: &mut Reading<'_>,
    ) -> Result<Span, Reported> {
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
        // A list grows by doubling, and is copied for that: thrice its own at the worst.
        if reading.memory.has_room_for(3 * self.value_bytes) {
            return Ok(());
        }
        Err(reading.memory.refuse(3 * self.value_bytes, self.previous.end, reading.sink))
    }

    fn value(&mut self, reading: &mut Reading<'_>) -> Result<Spanned<'a>, Reported> {
        let start = self.token.span;
        if !self.is('[') {
            return self.single(start, reading);
        }
        // The lists that are open, the outermost first, each with the place of its bracket.
        let mut lists = vec![(self.take().span, Vec::new())];
        loop {
            let depth = lists.len();
            let Some((opener, items)) = lists.last_mut() else { return Err(Reported) };
            if self.takes(']') {
                let span = opener.to(self.previous);
                let value =
                    if depth > KEPT_LISTS { Value::DeepList } else { Value::List(std::mem::take(items)) };
                let item = self.ended(value, span, reading.sink)?;
                lists.pop();
                let Some((opener, items)) = lists.last_mut() else { return Ok(item) };
                if lists_are_kept(depth - 1) {
                    items.push(item);
                }
                let opener = *opener;
                self.between(opener, reading)?;
                continue;
            }
            if self.is('[') {
                let opener = self.token.span;
                self.descend(depth, opener, reading.sink)?;
                lists.push((self.take().span, Vec::new()));
                continue;
            }
            let opener = *opener;
            let item = self.single(self.token.span, reading)?;
            if lists_are_kept(depth) {
                items.push(item);
            }
            self.between(opener, reading)?;
        }
    }

    /// What stands between two items of a list.
    fn between(&mut self, opener: Span, reading: &mut Reading<'_>) -> Result<(), Reported> {
        self.keep(size_of::<Spanned<'_>>(), reading)?;
        if self.takes(',') || self.is(']') {
            return Ok(());
        }
        Err(self.expected_in("`,` or `]`", opener, '[', reading.sink))
    }

    /// A value that is no list.
    fn single(&mut self, start: Span, reading: &mut Reading<'_>) -> Result<Spanned<'a>, Reported> {
        let sink = &mut *reading.sink;
        let mut negative = None;
        while let TokenKind::Sign(sign @ ('-' | '+')) = self.token.kind {
            negative = Some(negative.unwrap_or(false) != (sign == '-'));
            self.take();
        }
        let value = match self.token.kind {
            TokenKind::Number(number) => {
                let token = self.take();
                Value::Number(finite(number, token, sink)?)
            }
            _ if negative.is_some() && !matches!(self.token.text, "inf" | "nan") => {
                return Err(self.expected("a number after the sign", sink));
            }
            TokenKind::NumberWithUnit => return Err(self.unit(sink)),
            TokenKind::Text => Value::Text(unescaped(self.take().text)),
            TokenKind::Word => self.word_value(sink)?,
            TokenKind::Sign('(' | '!') => return Err(self.arithmetic("a value was expected here", sink)),
            _ => return Err(self.expected("a value", sink)),
        };
        let value = match value {
            Value::Number(number) if negative == Some(true) => Value::Number(-number),
            other => other,
        };
        self.ended(value, start.to(self.previous), sink)
    }

    /// A value with its place, where no arithmetic follows it.
    fn ended(&self, value: Value<'a>, span: Span, sink: &mut Sink) -> Result<Spanned<'a>, Reported> {
        if let TokenKind::Sign(
            '+' | '-' | '*' | '/' | '%' | '^' | '<' | '>' | '?' | ':' | '.' | '[' | '&' | '|' | '!',
        ) = self.token.kind
        {
            return Err(self.arithmetic("a value ends before this", sink));
        }
        Ok(Spanned { value, span })
    }

    fn word_value(&mut self, sink: &mut Sink) -> Result<Value<'a>, Reported> {
        let value = match self.token.text {
            "true" => Value::Flag(true),
            "false" => Value::Flag(false),
            "undef" => Value::Undef,
            "inf" if sink.leaves_out() => Value::Number(f64::INFINITY),
            "nan" if sink.leaves_out() => Value::Number(f64::NAN),
            "inf" | "nan" => {
                let message = format!("the number `{}` is not finite", self.token.text);
                return Err(sink.report(Diagnostic::error(self.token.span, message)));
            }
            word => {
                let message = format!("`{}` is not a value", quoted(word));
                let help = match nearest(word, ["true", "false", "undef"]) {
                    Some(right) => format!("did you mean `{right}`? ({EXPORT})"),
                    None => format!("write a number, or a text in quotes; {EXPORT}"),
                };
                return Err(sink.report(Diagnostic::error(self.token.span, message).help(help)));
            }
        };
        self.take();
        Ok(value)
    }

    fn unit(&self, sink: &mut Sink) -> Reported {
        let message = format!("`{}` is not a number", quoted(self.token.text));
        let error = Diagnostic::error(self.token.span, message).label("numbers carry no unit");
        sink.report(
            error.help("lengths are in the scene's own unit, angles in degrees: write the number alone"),
        )
    }

    fn arithmetic(&self, label: &str, sink: &mut Sink) -> Reported {
        let message = format!("`{}` is arithmetic", self.token.text);
        sink.report(Diagnostic::error(self.token.span, message).label(label).help(EXPORT))
    }

    /// As [`Parser::expected`], but at the end of the text the opener is what needs a look.
    fn expected_in(&self, what: &str, opener: Span, sign: char, sink: &mut Sink) -> Reported {
        if self.token.kind != TokenKind::End {
            return self.expected(what, sink);
        }
        let error = Diagnostic::error(opener, format!("this `{sign}` is never closed")).label("opened here");
        sink.report(error)
    }

    fn expected(&self, what: &str, sink: &mut Sink) -> Reported {
        let span = self.token.span;
        let error = match self.token.kind {
            TokenKind::OpenText => Diagnostic::error(span, "this text is never closed")
                .label("opened here")
                .help("add a `\"` where the text ends"),
            TokenKind::OpenComment => Diagnostic::error(span, "this comment is never closed")
                .label("opened here")
                .help("add a `*/` where the comment ends"),
            TokenKind::Stray(stray) => {
                let message = format!("the character `{}` has no meaning here", stray.escape_debug());
                let error = Diagnostic::error(span, message).label(format!("expected {what}"));
                match stray {
                    '“' | '”' | '‘' | '’' | '\'' => {
                        error.help("texts stand in straight double quotes: \"name\"")
                    }
                    '−' | '–' => error.help("a minus is the plain `-`"),
                    _ => error,
                }
            }
            TokenKind::End => Diagnostic::error(self.previous, format!("expected {what}, but the file ends"))
                .label("the last thing in the file"),
            _ => Diagnostic::error(span, format!("expected {what}, found `{}`", quoted(self.token.text))),
        };
        sink.report(error)
    }
}

/// A number too large is an error of its own, after which the parse goes on; or what the word that takes it leaves out.
fn finite(number: f64, token: Token<'_>, sink: &mut Sink) -> Result<f64, Reported> {
    if number.is_finite() || sink.leaves_out() {
        return Ok(number);
    }
    let message = format!("the number `{}` is not finite", quoted(token.text));
    let error = Diagnostic::error(token.span, message).label("too large for a 64-bit float");
    let reported = sink.report(error.help("the largest number is about 1.8e308"));
    if sink.is_full() { Err(reported) } else { Ok(0.0) }
}

/// Whether what is in a list at this depth is kept.
fn lists_are_kept(depth: usize) -> bool {
    depth <= KEPT_LISTS
}

/// A text token without its quotes and with its escapes resolved, as OpenSCAD resolves them; an escape
/// that it does not know stays as it is written.
fn unescaped(token: &str) -> Cow<'_, str> {
    let inner = token.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(token);
    if !inner.contains('\\') {
        return Cow::Borrowed(inner);
    }
    let mut text = String::with_capacity(inner.len());
    let mut rest = inner;
    while let Some(at) = rest.find('\\') {
        text.push_str(&rest[..at]);
        let after = &rest[at + 1..];
        let (replacement, length) = escape(after);
        match replacement {
            Some(c) => text.push(c),
            None => text.push_str(&rest[at..=at + length]),
        }
        rest = &after[length..];
    }
    text.push_str(rest);
    Cow::Owned(text)
}

/// The character meant by what follows a backslash, and how many bytes of it that takes.
fn escape(after: &str) -> (Option<char>, usize) {
    let hexadecimal = |digits: usize| {
        let code = after.get(1..=digits).filter(|code| code.bytes().all(|byte| byte.is_ascii_hexdigit()));
        (code.and_then(|code| u32::from_str_radix(code, 16).ok()).and_then(char::from_u32), 1 + digits)
    };
    let (c, length) = match after.chars().next() {
        Some('n') => (Some('\n'), 1),
        Some('t') => (Some('\t'), 1),
        Some('r') => (Some('\r'), 1),
        Some(c @ ('"' | '\\')) => (Some(c), 1),
        Some('x') => hexadecimal(2),
        Some('u') => hexadecimal(4),
        Some('U') => hexadecimal(6),
        _ => (None, 0),
    };
    if c.is_some() { (c, length) } else { (None, 0) }
}
