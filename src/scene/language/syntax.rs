//! What stands where in the text, before any word has a meaning.

use std::borrow::Cow;
use std::ops::Range;

/// Bytes of the source, `start..end`. 32 bits hold every place, because files are limited to 256 MiB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextSpan {
    pub start: u32,
    pub end: u32,
}

impl TextSpan {
    /// From the start of this to the end of `last`.
    pub fn to(self, last: Self) -> Self {
        Self { start: self.start, end: last.end }
    }
}

impl From<TextSpan> for Range<usize> {
    fn from(span: TextSpan) -> Self {
        span.start as usize..span.end as usize
    }
}

/// A name as it is written.
#[derive(Clone, Copy, Debug)]
pub struct Name<'a> {
    pub text: &'a str,
    pub span: TextSpan,
}

/// What the parser comes upon, in file order. Nothing holds a whole file: what is read is used and forgotten.
#[derive(Debug)]
pub enum SyntaxEvent<'a> {
    /// A call begins; its children, if any, come before its [`SyntaxEvent::Close`].
    Open(Call<'a>),
    /// The call that was opened last, and not yet closed, ends.
    Close,
    /// `name = value;` at the top level.
    Assignment(Name<'a>, Spanned<'a>),
}

/// `* name(arguments)` and what follows it.
#[derive(Debug)]
pub struct Call<'a> {
    pub modifiers: Modifiers,
    pub name: Name<'a>,
    /// From the opening to the closing parenthesis.
    pub parentheses: TextSpan,
    pub arguments: Vec<Argument<'a>>,
    /// Whether a `;` ends it, so that it has no children.
    pub is_ended: bool,
}

/// The characters `* ! # %` before a call.
#[derive(Clone, Copy, Debug, Default)]
pub struct Modifiers {
    /// `*`: as if it were not there.
    pub disable: bool,
    /// `!`: as if nothing else were there.
    pub root: bool,
    /// `%`: left out, and said so.
    pub background: bool,
}

/// `value` or `name = value`
#[derive(Debug)]
pub struct Argument<'a> {
    pub name: Option<Name<'a>>,
    pub value: Spanned<'a>,
}

/// A value and its place.
#[derive(Debug)]
pub struct Spanned<'a> {
    pub value: Value<'a>,
    pub span: TextSpan,
}

/// A literal.
#[derive(Debug)]
pub enum Value<'a> {
    Undef,
    Flag(bool),
    /// Not finite only where the reader leaves out what is wrong.
    Number(f64),
    Text(Cow<'a, str>),
    List(Vec<Spanned<'a>>),
    /// A list inside more lists than any word takes; what is in it is not kept.
    DeepList,
}

impl Value<'_> {
    /// What it is, for a message.
    pub fn describe(&self) -> String {
        match self {
            Value::Undef => "undef".into(),
            Value::Flag(flag) => flag.to_string(),
            Value::Number(number) => format!("the number {}", short(*number)),
            Value::Text(text) if text.is_empty() => "an empty text".into(),
            Value::Text(_) => "a text".into(),
            Value::List(items) if items.is_empty() => "an empty list".into(),
            Value::List(items) if items.iter().all(|item| matches!(item.value, Value::Number(_))) => {
                format!("a list of {} number{}", items.len(), if items.len() == 1 { "" } else { "s" })
            }
            Value::List(_) | Value::DeepList => "a list".into(),
        }
    }
}

/// A number as a person would write it: with an exponent where it has very many digits.
pub fn short(number: f64) -> String {
    // An f64 has up to 17 significant digits; a sign, a point and some zeros may come with them.
    const LONGEST: usize = 21;
    let plain = number.to_string();
    if plain.len() <= LONGEST { plain } else { format!("{number:e}") }
}
