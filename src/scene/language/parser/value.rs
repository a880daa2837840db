//! Literals: numbers, texts, words such as `true`, and lists of them.

use super::escapes::unescaped;
use super::{EXPORT, Parser, Reading};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::language::lexer::{Token, TokenKind};
use crate::scene::language::nearest::{nearest, quoted};
use crate::scene::language::syntax::{Spanned, TextSpan, Value};

/// Lists inside so many lists are not kept: the deepest that a word takes are the rows of a list.
const KEPT_LISTS: usize = 4;

impl<'a> Parser<'a> {
    pub(super) fn value(&mut self, reading: &mut Reading<'_>) -> Result<Spanned<'a>, Reported> {
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
    fn between(&mut self, opener: TextSpan, reading: &mut Reading<'_>) -> Result<(), Reported> {
        self.keep(size_of::<Spanned<'_>>(), reading)?;
        if self.takes(',') || self.is(']') {
            return Ok(());
        }
        Err(self.expected_in("`,` or `]`", opener, '[', reading.sink))
    }

    /// A value that is no list.
    fn single(&mut self, start: TextSpan, reading: &mut Reading<'_>) -> Result<Spanned<'a>, Reported> {
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
    fn ended(&self, value: Value<'a>, span: TextSpan, sink: &mut Sink) -> Result<Spanned<'a>, Reported> {
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
}

/// A number too large is an error of its own, after which the parse goes on; or what the word that takes it
/// leaves out.
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
