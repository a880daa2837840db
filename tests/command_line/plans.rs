//! Plans as text: what is needed and why, and how much of it is expected. Times depend on the processor, and
//! are left out.

use std::process::Command;

/// So few cells that the whole picture is sampled, however long that takes: six tiles. Of a larger one so
/// much is sampled as a tenth of a second allows, which is less on a busy machine.
const FEW: &str = "--cells=40x12";

/// The plan of a picture by the command line, a line for each stage and term.
fn plan(arguments: &[&str]) -> String {
    let program = env!("CARGO_BIN_EXE_ray13");
    let output = Command::new(program)
        .args(["plan", "--json", FEW])
        .args(arguments)
        .env_remove("NO_COLOR")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let plan: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let mut lines = String::new();
    let verdict = |row: &serde_json::Value| if row["needed"] == true { "needed  " } else { "left out" };
    for stage in plan["stages"].as_array().unwrap() {
        let expected = match (stage["expected_count"].as_f64(), stage["expected_of"].as_str()) {
            (Some(count), Some(of)) => format!("; {count} × {of}"),
            _ => String::new(),
        };
        let [name, why] = ["stage", "why"].map(|key| stage[key].as_str().unwrap());
        lines += &format!("{} {name:<18} {why}{expected}\n", verdict(stage));
        for term in stage["terms"].as_array().unwrap() {
            let [name, why] = ["name", "why"].map(|key| term[key].as_str().unwrap());
            lines += &format!("{}  - {name:<15} {why}\n", verdict(term));
        }
    }
    lines
}

#[test]
fn plans_as_text() {
    for (name, arguments) in [
        ("hanyang", &["hanyang"][..]),
        ("hanyang exact", &["hanyang", "--engine", "exact"]),
        ("hanyang pcat", &["hanyang", "--preset", "pcat"]),
        ("glass", &["glass"]),
        ("die plain", &["die", "--engine", "exact", "--shading", "1", "--no-shadows"]),
    ] {
        insta::assert_snapshot!(name, plan(arguments));
    }
}
