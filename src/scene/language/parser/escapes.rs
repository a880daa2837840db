//! Texts with escapes.

use std::borrow::Cow;

/// A text token without its quotes and with its escapes resolved, as OpenSCAD resolves them; an escape
/// that it does not know stays as it is written.
pub fn unescaped(token: &str) -> Cow<'_, str> {
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
