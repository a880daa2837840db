//! What is wrong with an input, drawn with the line it stands in.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use crate::scene::{Diagnostic, Diagnostics, Severity};

use super::error::visible;

/// So many bytes of a line are shown before and after the start of a place: files without line ends exist.
const REACH: usize = 60;

/// The diagnostics as text of several lines, in colour where that is wanted; ends without a line end.
pub fn render(diagnostics: &Diagnostics, colour: bool) -> String {
    let name = &visible(&diagnostics.source_name);
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let groups: Vec<_> =
        diagnostics.list.iter().map(|diagnostic| group(diagnostics, name, diagnostic)).collect();
    // Each is a report of its own: a report with several groups would call the later ones its continuation.
    let mut reports: Vec<String> =
        groups.into_iter().map(|group| renderer.render(std::slice::from_ref(&group))).collect();
    if diagnostics.stopped {
        reports.push(format!("reading stopped after {} errors", diagnostics.list.len()));
    }
    reports.join("\n\n")
}

fn group<'a>(diagnostics: &'a Diagnostics, name: &'a str, diagnostic: &'a Diagnostic) -> Group<'a> {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Note => Level::NOTE,
    };
    let mut group = Group::with_title(level.primary_title(diagnostic.message.as_str()));
    if diagnostic.span.is_empty() {
        group = group.element(Origin::path(name));
    } else {
        let (line, column) = diagnostics.place(diagnostic.span.start);
        let (shown, span) = window(&diagnostics.source, &diagnostic.span);
        let is_cut = shown[..span.start].chars().count() + 1 != column;
        let label = Some(diagnostic.label.as_str()).filter(|label| !label.is_empty());
        let snippet = Snippet::source(shown)
            .line_start(line)
            .annotation(AnnotationKind::Primary.span(span).label(label));
        group = if is_cut {
            // Of a cut line the snippet can not know the column.
            group.element(Origin::path(name).line(line).char_column(column)).element(snippet)
        } else {
            group.element(snippet.path(name))
        };
    }
    match &diagnostic.help {
        Some(help) => group.element(Level::HELP.message(help.as_str())),
        None => group,
    }
}

/// The part of the source to show, within one line, and the place in it.
fn window<'a>(source: &'a str, span: &Range<usize>) -> (&'a str, Range<usize>) {
    let line_start = source[..span.start].rfind('\n').map_or(0, |at| at + 1);
    let line_end = source[span.start..].find('\n').map_or(source.len(), |at| span.start + at);
    let line_end = span.start + source[span.start..line_end].trim_end_matches('\r').len();
    let start = char_boundary(source, line_start.max(span.start.saturating_sub(REACH)));
    let end = char_boundary(source, line_end.min(span.start + REACH));
    (&source[start..end], span.start - start..span.end.min(end) - start)
}

/// The last start of a character at or before a byte.
fn char_boundary(source: &str, at: usize) -> usize {
    (0..=at).rev().find(|&at| source.is_char_boundary(at)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use proptest::prelude::*;
    use proptest::sample::Index;

    use super::*;
    use crate::scene::{ReadOptions, read};

    fn rendered(text: &str) -> String {
        let errors = read("test.scene", text.as_bytes(), &ReadOptions::default()).expect_err("a bad scene");
        render(&errors, false)
    }

    #[test]
    fn points_at_the_place() {
        insta::assert_snapshot!(rendered("union() {\r\n    shpere(r = 1);\r\n}\r\n"), @r"
        error: there is no word `shpere`
         --> test.scene:2:5
          |
        2 |     shpere(r = 1);
          |     ^^^^^^
          |
          = help: did you mean `sphere`?
        ");
    }

    #[test]
    fn cuts_long_lines_around_the_place() {
        let text = format!("{}cube(é);{}", "cube(1); ".repeat(100_000), "sphere(1); ".repeat(10));
        let rendered = rendered(&text);
        assert!(rendered.contains("test.scene:1:900006"), "{rendered}");
        assert!(rendered.contains("cube(é);sphere(1);"), "{rendered}");
        assert!(rendered.len() < 600, "{rendered}");
    }

    #[test]
    fn whole_files_have_no_line() {
        insta::assert_snapshot!(rendered(""), @r"
        error: the scene is empty: there is nothing to see in it
        --> test.scene
         = help: add a solid, such as `sphere(1);`
        ");
    }

    #[test]
    fn places_of_several_lines_end_with_the_first() {
        insta::assert_snapshot!(rendered("camera(\n  name = \"front\"\n);\ncube(1);"), @r"
        error: `camera` needs `eye`
         --> test.scene:1:1
          |
        1 | camera(
          | ^^^^^^^
          |
          = help: give it: eye = [x, y, z]
        ");
    }

    proptest! {
        #[test]
        fn any_place_of_any_text_can_be_shown(
            pieces in prop::collection::vec(prop_oneof![
                6 => "\\PC{0,80}",
                2 => prop::sample::select(&["\n", "\r\n", "\r", "\t", "\u{feff}", "\0", "\u{1b}[31m", "e\u{301}", "汉字", "\u{202e}"][..])
                    .prop_map(str::to_owned),
            ], 0..12),
            (from, to) in any::<(Index, Index)>(),
            words in "\\PC{0,40}",
        ) {
            let source = pieces.concat();
            let place = |index: Index| char_boundary(&source, index.index(source.len() + 1));
            let (from, to) = (place(from).min(place(to)), place(from).max(place(to)));
            let error = Diagnostic::error(from..to, words.clone()).label(words.clone()).help(words);
            let list = vec![error.clone(), Diagnostic::note(from..to, "a note"), error];
            let diagnostics = Diagnostics { source_name: "test".to_owned(), source: Arc::from(source), list, stopped: true };
            for colour in [false, true] {
                prop_assert!(render(&diagnostics, colour).contains("reading stopped"));
            }
        }
    }
}
