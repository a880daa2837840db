//! The house rules that the compiler does not check: which room may import which, that no files import each
//! other, that a name of a type is one type's, and that the code and the flow chart name the same eleven
//! stages.

mod imports;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use imports::circles::{circles, graph};
use imports::names::shared_names;
use imports::{Source, rooms_of, upward_imports};
use ray13::stage::Stage;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// All Rust files below a folder, in the order of their names.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

#[test]
fn no_room_imports_one_below_it() {
    let rooms = rooms_of(&read("src/lib.rs"));
    let src = root().join("src");
    let mut seen = 0;
    let mut faults = Vec::new();
    for path in rust_files(&src) {
        let name = path.strip_prefix(&src).unwrap().to_string_lossy().replace('\\', "/");
        if name == "lib.rs" || name == "main.rs" {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let source = Source::new(&name, &text);
        seen += source.imports().len();
        faults.extend(upward_imports(&source, &rooms));
    }
    // The rooms do use each other: a checker that finds no import at all is broken.
    assert!(seen > 0, "no import was found in src/");
    assert!(faults.is_empty(), "imports against the order of src/lib.rs:\n{}", faults.join("\n"));
}

/// The paths below `src/`, and the texts, of all files of the library.
fn sources() -> Vec<(String, String)> {
    let src = root().join("src");
    let files = rust_files(&src).into_iter().map(|path| {
        let name = path.strip_prefix(&src).unwrap().to_string_lossy().replace('\\', "/");
        (name, fs::read_to_string(&path).unwrap())
    });
    files.filter(|(name, _)| name != "main.rs").collect()
}

#[test]
fn no_files_import_each_other() {
    let graph = graph(&sources());
    // Files do use each other: a checker that finds no import at all is broken.
    assert!(graph.values().flatten().count() > 100, "hardly any import was found in src/");
    let found = circles(&graph);
    let circles: Vec<_> = found.iter().map(|files| files.join(" ↔ ")).collect();
    assert!(circles.is_empty(), "files that import each other:\n{}", circles.join("\n"));
}

#[test]
fn no_two_public_types_share_a_name() {
    let sources = sources();
    let found = shared_names(&sources);
    let shared: Vec<_> = found.iter().map(|(name, files)| format!("{name}: {}", files.join(", "))).collect();
    assert!(shared.is_empty(), "public types that share a name:\n{}", shared.join("\n"));
}

#[test]
fn comments_have_at_most_110_columns() {
    let folders = ["src", "tests", "benches", "examples"].map(|folder| root().join(folder));
    let mut long = Vec::new();
    for path in folders.iter().flat_map(|folder| rust_files(folder)) {
        for (number, line) in fs::read_to_string(&path).unwrap().lines().enumerate() {
            if line.trim_start().starts_with("//") && line.chars().count() > 110 {
                long.push(format!("{}:{}", path.display(), number + 1));
            }
        }
    }
    assert!(long.is_empty(), "comments wider than 110 columns:\n{}", long.join("\n"));
}

#[test]
fn lib_rs_lists_the_folders_of_src_and_nothing_else() {
    let rooms = rooms_of(&read("src/lib.rs"));
    let listed: BTreeSet<String> = rooms.iter().cloned().collect();
    assert_eq!(listed.len(), rooms.len(), "a room is listed twice");
    let found: BTreeSet<String> = fs::read_dir(root().join("src"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().trim_end_matches(".rs").to_owned())
        .filter(|name| name != "lib" && name != "main")
        .collect();
    assert_eq!(listed, found);
    assert_eq!(rooms[0], "math", "math depends on nothing");
}

/// The number, name and room of each stage that docs/flow-chart.md describes, in headings such as "7 SOLID:
/// solid".
fn stages_described(chart: &str) -> Vec<(usize, String, String)> {
    chart
        .lines()
        .filter_map(|line| {
            let (number, rest) = line.strip_prefix("## ")?.split_once(' ')?;
            let (name, room) = rest.split_once(": ")?;
            Some((number.parse().ok()?, name.to_owned(), room.trim_matches('`').to_owned()))
        })
        .collect()
}

/// The number and name of each stage in the drawing: ` 7 SOLID .......... text`.
fn stages_drawn(chart: &str) -> Vec<(usize, String)> {
    let drawing = chart.split("```").nth(1).expect("the chart is a code block");
    drawing
        .lines()
        .filter_map(|line| {
            let mut words = line.split_whitespace();
            Some((words.next()?.parse().ok()?, words.next()?.to_owned()))
        })
        .collect()
}

#[test]
fn the_stages_are_those_of_the_flow_chart() {
    let chart = read("docs/flow-chart.md");
    let program: Vec<(usize, String)> =
        Stage::ALL.iter().map(|s| (s.number(), s.name().to_owned())).collect();
    assert_eq!(program.len(), 11);
    assert_eq!(program, stages_drawn(&chart), "the drawing");
    let described: Vec<(usize, String)> =
        stages_described(&chart).into_iter().map(|(number, name, _)| (number, name)).collect();
    assert_eq!(program, described, "the headings");
}

/// The first sentence of a module's `//!` comment.
fn first_sentence(text: &str) -> String {
    let doc: Vec<&str> = text.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim).collect();
    let paragraph: Vec<&str> = doc.into_iter().take_while(|line| !line.is_empty()).collect();
    let paragraph = paragraph.join(" ");
    paragraph.split_once(". ").map_or(paragraph.clone(), |(first, _)| first.to_owned())
}

/// Whether a sentence such as "Stages 7 and 8, SOLID and CSG: …" says this stage.
fn says_stage(sentence: &str, number: usize, name: &str) -> bool {
    let head = sentence.split(':').next().unwrap_or_default();
    let number = number.to_string();
    let mut words = head.split(|c: char| !c.is_alphanumeric());
    head.starts_with("Stage") && words.clone().any(|w| w == number) && words.any(|w| w == name)
}

#[test]
fn each_room_says_which_stage_it_is() {
    let mut silent = Vec::new();
    for (number, name, room) in stages_described(&read("docs/flow-chart.md")) {
        let sentence = first_sentence(&read(format!("src/{room}/mod.rs")));
        if !says_stage(&sentence, number, &name) {
            silent.push(format!(
                "src/{room}/mod.rs should begin with \"Stage {number}, {name}: …\" (or \"Stages …\"), not: {sentence}"
            ));
        }
    }
    assert!(silent.is_empty(), "{}", silent.join("\n"));
}

#[test]
fn a_module_begins_with_its_sentence() {
    let src = root().join("src");
    let silent: Vec<String> = rust_files(&src)
        .into_iter()
        .filter(|path| {
            let sentence = first_sentence(&fs::read_to_string(path).unwrap());
            sentence.is_empty() || sentence.starts_with('(')
        })
        .map(|path| path.display().to_string())
        .collect();
    assert!(silent.is_empty(), "no `//!` sentence on the first line of:\n{}", silent.join("\n"));
}

/// The names in the third column of the errata of docs/paper.md.
fn tests_of_errata(paper: &str) -> Vec<&str> {
    let errata = paper.split("## Errata").nth(1).unwrap_or_default();
    let rows = errata.lines().filter_map(|line| line.strip_prefix('|')?.strip_suffix('|'));
    let tests = rows.filter_map(|row| row.rsplit('|').next()?.trim().strip_prefix('`')?.strip_suffix('`'));
    tests.collect()
}

#[test]
fn each_erratum_names_a_test_that_exists() {
    let (paper, code) = (read("docs/paper.md"), read("tests/light/errata.rs"));
    let named = tests_of_errata(&paper);
    assert!(named.len() >= 7, "{named:?}");
    for test in named {
        assert!(
            code.contains(&format!("#[test]\nfn {test}() {{")),
            "tests/light/errata.rs has no test `{test}`"
        );
    }
}

/// The checks above must be able to fail.
mod the_checks_themselves {
    use super::*;

    #[test]
    fn a_sentence_names_its_stages() {
        let both = "Stages 7 and 8, SOLID and CSG: rays in, hits out";
        assert!(says_stage(both, 7, "SOLID") && says_stage(both, 8, "CSG"));
        assert!(!says_stage(both, 9, "SHADE"));
        assert!(!says_stage("Stage 10, DITHER: levels", 1, "DITHER"));
        assert!(!says_stage("Rays in: Stage 7, SOLID", 7, "SOLID"));
        assert!(!says_stage("(to be written)", 7, "SOLID"));
    }

    #[test]
    fn the_first_sentence_ends_where_it_ends() {
        assert_eq!(
            first_sentence("//! One thing\n//! on two lines. More.\n\nuse x;"),
            "One thing on two lines"
        );
        assert_eq!(first_sentence("//! Alone.\n//!\n//! More."), "Alone.");
        assert_eq!(first_sentence("use x;"), "");
    }

    #[test]
    fn errata_are_read_by_their_last_column() {
        let paper = "| a | b | `before` |\n## Errata\n| `printed` | meant | test |\n|---|---|---|\n\
                     | `x` | y | `the_test` |\n| z | z | not yet |\n";
        assert_eq!(tests_of_errata(paper), ["the_test"]);
    }

    #[test]
    fn a_chart_is_read_in_its_own_order() {
        let chart = "```\n START\n 2 B ...... x\n   │\n 1 A ◄── y\n```\n## 2 B: `b`\n\ntext\n\n## 1 A: `a`\n";
        assert_eq!(stages_drawn(chart), [(2, "B".to_owned()), (1, "A".to_owned())]);
        assert_eq!(stages_described(chart)[1], (1, "A".to_owned(), "a".to_owned()));
    }
}
