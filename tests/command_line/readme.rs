//! What the README says is so: its picture, its commands, its keys, its code and its links.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const README: &str = include_str!("../../README.md");

/// A mesh of one triangle.
const TRIANGLE: &str = "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\nendsolid a\n";

/// The contents of the fenced blocks of one language.
fn blocks(language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    let after = README.split(fence.as_str()).skip(1);
    after.map(|rest| rest.split("```").next().unwrap_or_default().to_owned()).collect()
}

/// Commands `ray13 …`: in code between backticks, and in blocks of shell, without their comments.
fn commands() -> Vec<String> {
    let prose: String = README.split("```").step_by(2).collect();
    let spans = prose.split('`').skip(1).step_by(2).map(str::to_owned);
    let shell =
        blocks("sh").into_iter().flat_map(|block| block.lines().map(str::to_owned).collect::<Vec<_>>());
    let lines = spans.chain(shell).map(|line| line.split('#').next().unwrap_or_default().trim().to_owned());
    lines.filter(|line| line.starts_with("ray13 ")).collect()
}

/// A folder of a test's own that holds what the commands name.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("readme").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("fitting.scene"), &blocks("openscad")[0]).unwrap();
    fs::write(folder.join("part.csg"), "cube(1);\n").unwrap();
    fs::write(folder.join("part.stl"), TRIANGLE).unwrap();
    folder
}

/// Runs a command as a shell would whose output is no terminal; it has no word in quotes.
fn run(command: &str, folder: &Path) -> Output {
    let arguments = command.split_whitespace().skip(1);
    Command::new(env!("CARGO_BIN_EXE_ray13"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .env_remove("NO_COLOR")
        .output()
        .unwrap()
}

#[test]
fn the_picture_is_what_its_command_prints() {
    let command = commands().into_iter().find(|command| command.contains("fitting.scene")).unwrap();
    let output = run(&command, &folder("picture"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    // Blanks at the ends of lines are left out of the README.
    let printed: String = String::from_utf8(output.stdout)
        .unwrap()
        .lines()
        .map(|line| format!("{}\n", line.trim_end()))
        .collect();
    assert_eq!(printed, blocks("text")[0], "{command} prints another picture:\n{printed}");
}

#[test]
fn every_command_runs() {
    let folder = folder("commands");
    let commands = commands();
    assert!(commands.len() >= 10, "{commands:?}");
    for command in commands {
        let output = run(&command, &folder);
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

/// The list itself is held to the table of actions beside that; here, that the manual page has it, too.
#[test]
fn the_manual_page_has_the_keys() {
    let output = run("ray13 man", &folder("man"));
    let page = String::from_utf8(output.stdout).unwrap();
    let section = page.split(".SH KEYS").nth(1).unwrap().replace('\\', "");
    let table = README.split("## Keys").nth(1).unwrap().split("\n\n").nth(1).unwrap();
    let keys: Vec<&str> = table.lines().skip(2).flat_map(|row| row.split('`').skip(1).step_by(2)).collect();
    assert!(keys.len() > 30, "{keys:?}");
    for key in keys {
        assert!(section.contains(key), "{key} is not in\n{section}");
    }
}

#[test]
fn the_code_is_that_of_the_example() {
    let example = include_str!("../../examples/embed.rs");
    let unindented: String = example.lines().map(|line| format!("{}\n", line.trim_start())).collect();
    let blocks = blocks("rust");
    assert!(!blocks.is_empty());
    for block in blocks {
        let block: String = block.lines().map(|line| format!("{}\n", line.trim_start())).collect();
        assert!(unindented.contains(&block), "not in examples/embed.rs:\n{block}");
    }
}

#[test]
fn every_link_leads_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let links: Vec<&str> = README.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(links.len() >= 8, "{links:?}");
    for link in links {
        assert!(root.join(link).exists(), "{link} is not there");
    }
}
