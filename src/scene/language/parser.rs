//! Tokens to the syntax tree.
//!
//! The first error of the grammar ends the parse, because what follows would mostly be echoes of it.
//! Recursion is counted, so that no input overflows the stack.

use std::borrow::Cow;

use super::lexer::{Lexer, Token, TokenKind};
use super::nearest::{nearest, quoted};
use super::syntax::{Argument, Call, File, Modifiers, Name, Span, Spanned, Value};
use super::vocabulary::{FRAGMENT_SETTINGS, PROGRAM_WORDS};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};

/// Braces, chained calls and brackets may be nested so deep.
pub const MAX_DEPTH: usize = 512;

const EXPORT: &str = "arithmetic, variables and modules are OpenSCAD's work: \
     export the file as .csg (openscad -o part.csg part.scad)";

/// Parses a file. Errors go to `sink`; the tree is whole where there is none.
pub fn parse<'a>(source: &'a str, sink: &mut Sink) -> Result<File<'a>, Reported> {
    let mut lexer = Lexer::new(source);
    let token = lexer.next();
    let mut parser = Parser { lexer, token, previous: token.span, depth: 0, sink };
    let mut file = File::default();
    while parser.token.kind != TokenKind::End {
        if parser.token.kind == TokenKind::Sign('}') {
            let error = Diagnostic::error(parser.token.span, "this `}` closes nothing");
            return Err(parser.sink.report(error.help("remove it, or look for a `{` that is missing above")));
        }
        parser.statement(&mut file.calls, Some(&mut file.assignments))?;
    }
    Ok(file)
}

struct Parser<'a, 's> {
    lexer: Lexer<'a>,
    /// The token that comes next.
    token: Token<'a>,
    /// The place of the token taken last.
    previous: Span,
    depth: usize,
    sink: &'s mut Sink,
}

type Assignments<'a> = Vec<(Name<'a>, Spanned<'a>)>;

impl<'a> Parser<'a, '_> {
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

    /// Goes one level down, with the place that a message about too many levels points at.
    fn descend(&mut self, place: Span) -> Result<(), Reported> {
        self.depth += 1;
        if self.depth <= MAX_DEPTH {
            return Ok(());
        }
        let error = Diagnostic::error(place, format!("nested deeper than {MAX_DEPTH} levels"));
        Err(self
            .sink
            .report(error.label("one level too many").help("put parts side by side, not inside each other")))
    }

    /// One statement, put into `calls` or, at the top level only, into `assignments`.
    fn statement(
        &mut self,
        calls: &mut Vec<Call<'a>>,
        assignments: Option<&mut Assignments<'a>>,
    ) -> Result<(), Reported> {
        if self.takes(';') {
            return Ok(());
        }
        if let TokenKind::Word = self.token.kind
            && self.lexer.clone().next().kind == TokenKind::Sign('=')
        {
            return self.assignment(assignments);
        }
        calls.push(self.call()?);
        Ok(())
    }

    fn assignment(&mut self, assignments: Option<&mut Assignments<'a>>) -> Result<(), Reported> {
        let word = self.take();
        let name = Name { text: word.text, span: word.span };
        let quoted = quoted(name.text);
        if !FRAGMENT_SETTINGS.contains(&name.text) {
            let error = Diagnostic::error(name.span, format!("`{quoted}` can not be set here"));
            let help = match nearest(name.text, FRAGMENT_SETTINGS).filter(|_| name.text.starts_with('$')) {
                Some(right) => format!("did you mean `{right}`?"),
                None => EXPORT.into(),
            };
            return Err(self.sink.report(error.label("only $fn, $fa and $fs are").help(help)));
        }
        let Some(assignments) = assignments else {
            let error = Diagnostic::error(name.span, format!("`{quoted}` is set inside braces"));
            let help =
                format!("set it at the top level, or give it to one word: `cylinder(h = 1, {quoted} = 6);`");
            return Err(self.sink.report(error.help(help)));
        };
        self.take();
        let value = self.value()?;
        if !self.takes(';') {
            return Err(self.expected("`;` after the assignment"));
        }
        assignments.push((name, value));
        Ok(())
    }

    fn call(&mut self) -> Result<Call<'a>, Reported> {
        let mut modifiers = Modifiers::default();
        while let TokenKind::Sign(sign @ ('*' | '!' | '#' | '%')) = self.token.kind {
            modifiers.disable |= sign == '*';
            modifiers.root |= sign == '!';
            modifiers.background |= sign == '%';
            self.take();
        }
        if self.is('{') {
            // Braces alone are OpenSCAD's group without its name.
            let span = self.token.span;
            let children = self.block()?;
            let name = Name { text: "group", span };
            return Ok(Call { modifiers, name, parentheses: span, arguments: Vec::new(), children });
        }
        if self.token.kind != TokenKind::Word {
            return Err(self.expected("a word such as `sphere` or `union`"));
        }
        let word = self.take();
        let name = Name { text: word.text, span: word.span };
        if PROGRAM_WORDS.contains(&name.text) {
            let error =
                Diagnostic::error(name.span, format!("`{}` belongs to OpenSCAD's programs", name.text));
            return Err(self.sink.report(error.help(EXPORT)));
        }
        let (parentheses, arguments) = self.arguments(name)?;
        let children = self.children()?;
        Ok(Call { modifiers, name, parentheses, arguments, children })
    }

    fn arguments(&mut self, name: Name<'a>) -> Result<(Span, Vec<Argument<'a>>), Reported> {
        let opener = self.token.span;
        if !self.takes('(') {
            return Err(self.expected(&format!("`(` after `{}`", quoted(name.text))));
        }
        let mut arguments = Vec::new();
        while !self.takes(')') {
            arguments.push(self.argument()?);
            if !self.takes(',') && !self.is(')') {
                return Err(self.expected_in("`,` or `)`", opener, '('));
            }
        }
        Ok((opener.to(self.previous), arguments))
    }

    fn argument(&mut self) -> Result<Argument<'a>, Reported> {
        let named =
            self.token.kind == TokenKind::Word && self.lexer.clone().next().kind == TokenKind::Sign('=');
        let name = named.then(|| {
            let word = self.take();
            self.take();
            Name { text: word.text, span: word.span }
        });
        Ok(Argument { name, value: self.value()? })
    }

    /// What follows the arguments: `;`, a block, or one call.
    fn children(&mut self) -> Result<Vec<Call<'a>>, Reported> {
        if self.takes(';') {
            return Ok(Vec::new());
        }
        if self.is('{') {
            return self.block();
        }
        if !matches!(self.token.kind, TokenKind::Word | TokenKind::Sign('*' | '!' | '#' | '%')) {
            return Err(self.expected("`;`, `{` or another word"));
        }
        self.descend(self.token.span)?;
        let child = self.call()?;
        self.depth -= 1;
        Ok(vec![child])
    }

    fn block(&mut self) -> Result<Vec<Call<'a>>, Reported> {
        let opener = self.take().span;
        self.descend(opener)?;
        let mut calls = Vec::new();
        while !self.takes('}') {
            if self.token.kind == TokenKind::End {
                let error = Diagnostic::error(opener, "this `{` is never closed").label("opened here");
                return Err(self.sink.report(error.help("add a `}` where the block ends")));
            }
            self.statement(&mut calls, None)?;
        }
        self.depth -= 1;
        Ok(calls)
    }

    fn value(&mut self) -> Result<Spanned<'a>, Reported> {
        let start = self.token.span;
        let mut negative = None;
        while let TokenKind::Sign(sign @ ('-' | '+')) = self.token.kind {
            negative = Some(negative.unwrap_or(false) != (sign == '-'));
            self.take();
        }
        let value = match self.token.kind {
            TokenKind::Number(number) => {
                let token = self.take();
                Value::Number(self.finite(number, token)?)
            }
            _ if negative.is_some() && !matches!(self.token.text, "inf" | "nan") => {
                return Err(self.expected("a number after the sign"));
            }
            TokenKind::NumberWithUnit => return Err(self.unit()),
            TokenKind::Text => Value::Text(unescaped(self.take().text)),
            TokenKind::Word => self.word_value()?,
            TokenKind::Sign('[') => Value::List(self.list()?),
            TokenKind::Sign('(' | '!') => return Err(self.arithmetic("a value was expected here")),
            _ => return Err(self.expected("a value")),
        };
        if let TokenKind::Sign(
            '+' | '-' | '*' | '/' | '%' | '^' | '<' | '>' | '?' | ':' | '.' | '[' | '&' | '|' | '!',
        ) = self.token.kind
        {
            return Err(self.arithmetic("a value ends before this"));
        }
        let value = match value {
            Value::Number(number) if negative == Some(true) => Value::Number(-number),
            other => other,
        };
        Ok(Spanned { value, span: start.to(self.previous) })
    }

    fn list(&mut self) -> Result<Vec<Spanned<'a>>, Reported> {
        let opener = self.take().span;
        self.descend(opener)?;
        let mut items = Vec::new();
        while !self.takes(']') {
            items.push(self.value()?);
            if !self.takes(',') && !self.is(']') {
                return Err(self.expected_in("`,` or `]`", opener, '['));
            }
        }
        self.depth -= 1;
        Ok(items)
    }

    /// A number too large is an error of its own, after which the parse goes on.
    fn finite(&mut self, number: f64, token: Token<'a>) -> Result<f64, Reported> {
        if number.is_finite() {
            return Ok(number);
        }
        let message = format!("the number `{}` is not finite", quoted(token.text));
        let error = Diagnostic::error(token.span, message).label("too large for a 64-bit float");
        let reported = self.sink.report(error.help("the largest number is about 1.8e308"));
        if self.sink.is_full() { Err(reported) } else { Ok(0.0) }
    }

    fn word_value(&mut self) -> Result<Value<'a>, Reported> {
        let value = match self.token.text {
            "true" => Value::Flag(true),
            "false" => Value::Flag(false),
            "undef" => Value::Undef,
            "inf" | "nan" => {
                let message = format!("the number `{}` is not finite", self.token.text);
                return Err(self.sink.report(Diagnostic::error(self.token.span, message)));
            }
            word => {
                let message = format!("`{}` is not a value", quoted(word));
                let help = match nearest(word, ["true", "false", "undef"]) {
                    Some(right) => format!("did you mean `{right}`? ({EXPORT})"),
                    None => format!("write a number, or a text in quotes; {EXPORT}"),
                };
                return Err(self.sink.report(Diagnostic::error(self.token.span, message).help(help)));
            }
        };
        self.take();
        Ok(value)
    }

    fn unit(&mut self) -> Reported {
        let message = format!("`{}` is not a number", quoted(self.token.text));
        let error = Diagnostic::error(self.token.span, message).label("numbers carry no unit");
        self.sink.report(
            error.help("lengths are in the scene's own unit, angles in degrees: write the number alone"),
        )
    }

    fn arithmetic(&mut self, label: &str) -> Reported {
        let message = format!("`{}` is arithmetic", self.token.text);
        self.sink.report(Diagnostic::error(self.token.span, message).label(label).help(EXPORT))
    }

    /// As [`Parser::expected`], but at the end of the text the opener is what needs a look.
    fn expected_in(&mut self, what: &str, opener: Span, sign: char) -> Reported {
        if self.token.kind != TokenKind::End {
            return self.expected(what);
        }
        let error = Diagnostic::error(opener, format!("this `{sign}` is never closed")).label("opened here");
        self.sink.report(error)
    }

    fn expected(&mut self, what: &str) -> Reported {
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
        self.sink.report(error)
    }
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
