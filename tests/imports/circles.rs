//! Finds files that import each other.
//!
//! A name is traced to the file that it is defined in, through the `pub use` of the modules that pass it on,
//! so that to name a sibling by its room is the same as to name it by its file.

use std::collections::{BTreeMap, BTreeSet};

use super::tokens::{Token, items_of_tests, tokens, without_tests};

/// The files of a crate by their paths, and which of them each imports.
pub type Graph = BTreeMap<String, BTreeSet<String>>;

/// A file as its module sees it.
struct Module<'a> {
    file: &'a str,
    tokens: Vec<Token<'a>>,
    /// By name that is re-exported: the path that it is from, as written.
    passed_on: BTreeMap<&'a str, Vec<&'a str>>,
}

/// What each file imports, by the file's path below `src/`; `files` are paths and texts. Files of tests are
/// left out.
pub fn graph(files: &[(String, String)]) -> Graph {
    let modules = modules(files);
    let mut graph = Graph::new();
    for (path, module) in &modules {
        let imports = graph.entry(module.file.to_owned()).or_default();
        for import in module.imports(path) {
            let found = file_of(&modules, path, &import, 0);
            imports.extend(found.filter(|&file| file != module.file).map(str::to_owned));
        }
    }
    graph
}

/// Every circle of two files, and of three no two of which are one already, each in the order of its paths.
pub fn circles(graph: &Graph) -> BTreeSet<Vec<String>> {
    let imports = |from: &str, to: &str| graph.get(from).is_some_and(|found| found.contains(to));
    let mut found = BTreeSet::new();
    for (a, of_a) in graph {
        for b in of_a {
            if imports(b, a) {
                found.insert(BTreeSet::from([a, b]).into_iter().cloned().collect());
                continue;
            }
            for c in graph.get(b).into_iter().flatten() {
                if imports(c, a) && !imports(a, c) && !imports(c, b) {
                    found.insert(BTreeSet::from([a, b, c]).into_iter().cloned().collect());
                }
            }
        }
    }
    found
}

/// By path of the module (`["solid", "span"]`): its file.
fn modules(files: &[(String, String)]) -> BTreeMap<Vec<&str>, Module<'_>> {
    let all = files.iter().map(|(path, text)| {
        let stem = path.trim_end_matches(".rs").trim_end_matches("/mod");
        let name: Vec<&str> = stem.split('/').filter(|part| *part != "lib").collect();
        (name, path.as_str(), tokens(text))
    });
    let all: Vec<_> = all.collect();
    let of_tests: BTreeSet<Vec<&str>> =
        all.iter().flat_map(|(name, _, tokens)| tests_of(name, tokens)).collect();
    let is_test = |name: &[&str]| (1..=name.len()).any(|n| of_tests.contains(&name[..n]));
    let kept = all.into_iter().filter(|(name, ..)| !is_test(name));
    kept.map(|(name, file, tokens)| {
        let tokens = without_tests(&tokens);
        let passed_on = passed_on(&tokens);
        (name, Module { file, tokens, passed_on })
    })
    .collect()
}

/// The modules that a file declares for tests only, by `mod name;` or by the path given for it.
fn tests_of<'a>(parent: &[&'a str], tokens: &[Token<'a>]) -> Vec<Vec<&'a str>> {
    let items = items_of_tests(tokens);
    let named = items.iter().filter_map(|range| {
        let item = &tokens[range.clone()];
        let at = item.iter().position(|token| token.text == "mod")?;
        (item.get(at + 2)?.text == ";").then(|| [parent, &[item[at + 1].text]].concat())
    });
    named.collect()
}

/// The paths of a `use` tree, or of any path, that begins at a token.
fn paths<'a>(tokens: &[Token<'a>], at: &mut usize, before: &[&'a str], found: &mut Vec<Vec<&'a str>>) {
    let mut path = before.to_vec();
    loop {
        let Some(token) = tokens.get(*at) else { return };
        match token.text {
            "{" => {
                *at += 1;
                while tokens.get(*at).is_some_and(|token| token.text != "}") {
                    paths(tokens, at, &path, found);
                    if tokens.get(*at).is_some_and(|token| token.text == ",") {
                        *at += 1;
                    }
                }
                *at += 1;
                return;
            }
            word => path.push(word.trim_start_matches("r#")),
        }
        *at += 1;
        if tokens.get(*at).is_none_or(|token| token.text != "::") {
            break;
        }
        *at += 1;
    }
    if tokens.get(*at).is_some_and(|token| token.text == "as") {
        *at += 2;
    }
    found.push(path);
}

/// The names that a file passes on by `pub use`, with the paths that they are from.
fn passed_on<'a>(tokens: &[Token<'a>]) -> BTreeMap<&'a str, Vec<&'a str>> {
    let mut found = Vec::new();
    for i in uses(tokens).into_iter().filter(|&i| is_public(tokens, i)) {
        paths(tokens, &mut (i + 1), &[], &mut found);
    }
    found.into_iter().filter_map(|path| Some((*path.last()?, path))).collect()
}

/// Where each `use` stands.
fn uses(tokens: &[Token<'_>]) -> Vec<usize> {
    let begins = |i: usize| i == 0 || matches!(tokens[i - 1].text, ";" | "}" | "{" | "]" | "pub" | ")");
    (0..tokens.len()).filter(|&i| tokens[i].text == "use" && begins(i)).collect()
}

/// Whether the `use` at a token is `pub use`, or `pub(crate) use` and the like.
fn is_public(tokens: &[Token<'_>], at: usize) -> bool {
    at > 0 && matches!(tokens[at - 1].text, "pub" | ")")
}

impl<'a> Module<'a> {
    /// Every path that the file names: what it uses, and paths in its code from `crate`, `self` or `super`
    /// on. What it only passes on is none of its imports.
    fn imports(&self, own: &[&'a str]) -> Vec<Vec<&'a str>> {
        let tokens = &self.tokens;
        let (mut found, mut passed) = (Vec::new(), Vec::new());
        let mut outside = BTreeSet::new();
        let uses: BTreeSet<usize> = uses(tokens).into_iter().collect();
        let mut supers = InlineModules::default();
        let mut i = 0;
        while i < tokens.len() {
            supers.pass(tokens, i);
            let text = tokens[i].text;
            let starts = matches!(text, "crate" | "super" | "self") && next_is(tokens, i, "::");
            if uses.contains(&i) {
                let mut end = i + 1;
                let list = if is_public(tokens, i) { &mut passed } else { &mut found };
                let from = list.len();
                paths(tokens, &mut end, &[], list);
                supers.leave(&mut list[from..]);
                i = end;
            } else if starts {
                let from = found.len();
                let mut end = i;
                paths(tokens, &mut end, &[], &mut found);
                supers.leave(&mut found[from..]);
                i = end;
            } else {
                outside.insert(text);
                i += 1;
            }
        }
        passed.retain(|path: &Vec<&str>| path.last().is_some_and(|name| outside.contains(name)));
        found.extend(passed);
        found.retain(|path| !path.is_empty() && path.as_slice() != own);
        found
    }
}

fn next_is(tokens: &[Token<'_>], i: usize, text: &str) -> bool {
    tokens.get(i + 1).is_some_and(|token| token.text == text)
}

/// The modules in braces that a token stands in: a `super` from there leads into the file itself.
#[derive(Default)]
struct InlineModules {
    braces: usize,
    open: Vec<usize>,
}

impl InlineModules {
    fn pass(&mut self, tokens: &[Token<'_>], i: usize) {
        match tokens[i].text {
            "{" => {
                if i >= 2 && tokens[i - 2].text == "mod" {
                    self.open.push(self.braces);
                }
                self.braces += 1;
            }
            "}" => {
                self.braces = self.braces.saturating_sub(1);
                if self.open.last() == Some(&self.braces) {
                    self.open.pop();
                }
            }
            _ => {}
        }
    }

    /// Takes off each path the `super` that only leave a module in braces.
    fn leave(&self, paths: &mut [Vec<&str>]) {
        for path in paths {
            for _ in &self.open {
                if path.first() == Some(&"super") {
                    path[0] = "self";
                }
                if path.get(1) == Some(&"super") {
                    path.remove(0);
                }
            }
        }
    }
}

/// The file in which what a path names, seen from the module `from`, is defined; none for what another crate
/// has.
fn file_of<'a>(
    modules: &BTreeMap<Vec<&'a str>, Module<'a>>,
    from: &[&'a str],
    path: &[&'a str],
    passes: usize,
) -> Option<&'a str> {
    let mut at = from.to_vec();
    let mut rest = path;
    match path.first()? {
        &"crate" => {
            at.clear();
            rest = &path[1..];
        }
        &"self" => rest = &path[1..],
        &"super" => {}
        first => {
            // A child of the module, or another crate.
            let child = [from, &[*first]].concat();
            if !modules.contains_key(&child) {
                return None;
            }
        }
    }
    while let Some((first, others)) = rest.split_first() {
        if *first == "super" {
            at.pop();
        } else {
            let child = [at.as_slice(), &[*first]].concat();
            if !modules.contains_key(&child) {
                break;
            }
            at = child;
        }
        rest = others;
    }
    let module = modules.get(&at)?;
    let Some(source) = rest.first().and_then(|name| module.passed_on.get(name)) else {
        return Some(module.file);
    };
    // A name may be passed on by one module after the other, but not for ever.
    if passes > 8 { None } else { file_of(modules, &at, source, passes + 1).or(Some(module.file)) }
}

mod the_finder_itself {
    use super::*;

    fn graph_of(files: &[(&str, &str)]) -> Graph {
        let files: Vec<_> = files.iter().map(|&(path, text)| (path.to_owned(), text.to_owned())).collect();
        graph(&files)
    }

    fn imports(graph: &Graph, file: &str) -> Vec<String> {
        graph[file].iter().cloned().collect()
    }

    #[test]
    fn names_are_traced_to_the_file_that_defines_them() {
        let graph = graph_of(&[
            ("lib.rs", "pub mod a; pub mod b;"),
            ("a/mod.rs", "mod x; mod y; pub use x::{X, More as Most}; pub use self::y::Y; pub struct Own;"),
            ("a/x.rs", "use super::Y; use super::{Own, y::{self, Z}};"),
            ("a/y.rs", "/* use super::x::X; */ #[cfg(test)] mod tests { use super::super::X; }"),
            ("b.rs", "use std::fmt; use crate::{a::{X, Own}, b}; fn f() -> crate::a::Y {}"),
        ]);
        assert_eq!(imports(&graph, "a/x.rs"), ["a/mod.rs", "a/y.rs"]);
        assert_eq!(imports(&graph, "a/y.rs"), [""; 0]);
        assert_eq!(imports(&graph, "a/mod.rs"), [""; 0], "passing on is no import");
        assert_eq!(imports(&graph, "b.rs"), ["a/mod.rs", "a/x.rs", "a/y.rs"]);
    }

    #[test]
    fn what_is_passed_on_and_used_is_an_import() {
        let graph =
            graph_of(&[("a/mod.rs", "mod x; pub use x::X; fn f(_: X) {}"), ("a/x.rs", "use super::f;")]);
        assert_eq!(imports(&graph, "a/mod.rs"), ["a/x.rs"]);
        assert_eq!(circles(&graph), BTreeSet::from([vec!["a/mod.rs".to_owned(), "a/x.rs".to_owned()]]));
    }

    #[test]
    fn files_of_tests_are_left_out() {
        let graph =
            graph_of(&[("a.rs", "#[cfg(test)] mod tests; use crate::b;"), ("a/tests.rs", ""), ("b.rs", "")]);
        assert_eq!(graph.keys().collect::<Vec<_>>(), ["a.rs", "b.rs"]);
        assert_eq!(imports(&graph, "a.rs"), ["b.rs"]);
    }

    #[test]
    fn circles_of_three_are_found_and_of_two_only_once() {
        let texts =
            [("a.rs", "use crate::b::B;"), ("b.rs", "use crate::c::C;"), ("c.rs", "use crate::a::A;")];
        assert_eq!(
            circles(&graph_of(&texts)),
            BTreeSet::from([["a.rs", "b.rs", "c.rs"].map(str::to_owned).to_vec()])
        );
        let texts = [texts[0], texts[1], ("c.rs", "use crate::a::A; use crate::b::B;")];
        assert_eq!(
            circles(&graph_of(&texts)),
            BTreeSet::from([["b.rs", "c.rs"].map(str::to_owned).to_vec()])
        );
    }

    #[test]
    fn a_super_from_a_module_in_braces_leads_into_the_file() {
        let graph =
            graph_of(&[("a/mod.rs", ""), ("a/x.rs", "mod inner { use super::X; use super::super::Own; }")]);
        assert_eq!(imports(&graph, "a/x.rs"), ["a/mod.rs"]);
    }
}
