//! Cuts Rust code into words and signs.

use std::ops::Range;

/// A word or a sign, and the line that it stands in, counted from 1.
#[derive(Clone, Copy)]
pub struct Token<'a> {
    pub line: usize,
    pub text: &'a str,
}

/// Words, `::` and single signs. Comments, strings and character literals are left out.
pub fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let mut line = 1;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if let Some(length) = literal(rest) {
            length
        } else if rest.starts_with("::") {
            found.push(Token { line, text: "::" });
            2
        } else if first.is_alphanumeric() || first == '_' {
            let word = rest.strip_prefix("r#").unwrap_or(rest);
            let prefix = rest.len() - word.len();
            let end = word.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(word.len());
            found.push(Token { line, text: &rest[..prefix + end] });
            prefix + end
        } else {
            if !first.is_whitespace() {
                found.push(Token { line, text: &rest[..first.len_utf8()] });
            }
            first.len_utf8()
        };
        line += rest[..length].matches('\n').count();
        rest = &rest[length..];
    }
    found
}

/// The length of the block comment, with those nested in it, at the start of `text`.
fn block_comment(text: &str) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        if rest.starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest.starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

/// The length of the string or character literal at the start of `text`, if there is one.
fn literal(text: &str) -> Option<usize> {
    let body = text.trim_start_matches(['b', 'c']);
    let prefix = text.len() - body.len();
    if prefix > 1 {
        return None;
    }
    if let Some(raw) = body.strip_prefix('r') {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        if let Some(inside) = raw[hashes..].strip_prefix('"') {
            let close = format!("\"{}", "#".repeat(hashes));
            let end = inside.find(&close).map_or(inside.len(), |e| e + close.len());
            return Some(text.len() - inside.len() + end);
        }
        return None;
    }
    if body.starts_with('"') {
        return Some(prefix + quoted(body, '"')?);
    }
    let inside = body.strip_prefix('\'')?;
    // A lifetime has no closing quote after its first character.
    let first = inside.chars().next()?;
    (first == '\\' || inside[first.len_utf8()..].starts_with('\''))
        .then(|| quoted(body, '\'').map(|n| prefix + n))?
}

/// The length up to the closing quote, escapes skipped.
fn quoted(text: &str, quote: char) -> Option<usize> {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        if escaped {
            escaped = false;
        } else if c == '\\' {
            escaped = true;
        } else if c == quote {
            return Some(at + c.len_utf8());
        }
    }
    None
}

/// The stretches of items that only tests have: from `#[cfg(test)]` to the end of the item behind it.
pub fn items_of_tests(tokens: &[Token<'_>]) -> Vec<Range<usize>> {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let begins = tokens[at..].iter().map(|token| token.text).take(MARK.len()).eq(MARK);
        let end = if begins { end_of_item(tokens, at + MARK.len()) } else { at + 1 };
        if begins {
            found.push(at..end);
        }
        at = end;
    }
    found
}

/// Behind the `;` or the closing brace that ends the item that begins at a token.
fn end_of_item(tokens: &[Token<'_>], from: usize) -> usize {
    let mut depth = 0_usize;
    for (i, token) in tokens.iter().enumerate().skip(from) {
        match token.text {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => {
                depth = depth.saturating_sub(1);
                // `use a::{b};` goes on to its semicolon.
                if depth == 0 && token.text == "}" && tokens.get(i + 1).is_none_or(|next| next.text != ";") {
                    return i + 1;
                }
            }
            ";" if depth == 0 => return i + 1,
            _ => {}
        }
    }
    tokens.len()
}

/// The code without what only tests have.
pub fn without_tests<'a>(tokens: &[Token<'a>]) -> Vec<Token<'a>> {
    let tests = items_of_tests(tokens);
    let kept = tokens.iter().enumerate().filter(|(i, _)| !tests.iter().any(|range| range.contains(i)));
    kept.map(|(_, token)| *token).collect()
}

mod the_cutter_itself {
    use super::*;

    #[test]
    fn items_of_tests_are_left_out() {
        let text = "use a; #[cfg(test)] mod tests; #[cfg(test)] use b::{c}; #[cfg(test)] mod t { fn f() {} } fn g() {}";
        let tokens = tokens(text);
        let kept: Vec<_> = without_tests(&tokens).iter().map(|token| token.text).collect();
        assert_eq!(kept, ["use", "a", ";", "fn", "g", "(", ")", "{", "}"]);
    }
}
