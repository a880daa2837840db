//! Mistakes of the grammar, each with its message.

use super::{EXPORT, Parser};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::language::lexer::TokenKind;
use crate::scene::language::nearest::quoted;
use crate::scene::language::syntax::TextSpan;

impl Parser<'_> {
    pub(super) fn unit(&self, sink: &mut Sink) -> Reported {
        let message = format!("`{}` is not a number", quoted(self.token.text));
        let error = Diagnostic::error(self.token.span, message).label("numbers carry no unit");
        sink.report(
            error.help("lengths are in the scene's own unit, angles in degrees: write the number alone"),
        )
    }

    pub(super) fn arithmetic(&self, label: &str, sink: &mut Sink) -> Reported {
        let message = format!("`{}` is arithmetic", self.token.text);
        sink.report(Diagnostic::error(self.token.span, message).label(label).help(EXPORT))
    }

    /// As [`Parser::expected`], but at the end of the text the opener is what needs a look.
    pub(super) fn expected_in(&self, what: &str, opener: TextSpan, sign: char, sink: &mut Sink) -> Reported {
        if self.token.kind != TokenKind::End {
            return self.expected(what, sink);
        }
        let error = Diagnostic::error(opener, format!("this `{sign}` is never closed")).label("opened here");
        sink.report(error)
    }

    pub(super) fn expected(&self, what: &str, sink: &mut Sink) -> Reported {
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
