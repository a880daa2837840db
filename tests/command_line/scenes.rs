//! The scenes inside, and what the program prints of itself.

use std::fs;

use super::{done, fails, folder, run, text};

#[test]
fn lists_the_embedded_scenes() {
    let list = text(&done(&run(&["scenes"])));
    for name in ["hanyang", "die", "bolt", "temple"] {
        assert!(list.lines().any(|line| line.split_whitespace().next() == Some(name)), "{name} in {list}");
    }
}

#[test]
fn prints_each_as_a_file_that_can_be_read() {
    let folder = folder("prints_each");
    for name in ["hanyang", "die", "bolt", "temple", "teapot"] {
        let file = folder.join(format!("{name}.scene"));
        fs::write(&file, done(&run(&["scenes", name]))).unwrap();
        done(&run(&["check", file.to_str().unwrap()]));
    }
}

#[test]
fn knows_when_there_is_no_such_scene() {
    let message = fails(&run(&["scenes", "hanjang"]), 2);
    assert!(message.contains("hanyang"), "the nearest name is not offered: {message}");
}

#[test]
fn completions_come_for_every_shell() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = text(&done(&run(&["completions", shell])));
        assert!(script.contains("ray13") && script.contains("preset"), "{shell}");
    }
    fails(&run(&["completions", "tcsh"]), 2);
}

#[test]
fn the_manual_has_a_page_for_each_command() {
    let page = text(&done(&run(&["man"])));
    assert!(page.contains(".TH ray13 1") && page.contains("render"), "{page}");
    let page = text(&done(&run(&["man", "render"])));
    assert!(page.contains("ray13-render") && page.contains("preset"), "{page}");
    let message = fails(&run(&["man", "rendre"]), 2);
    assert!(message.contains("render"), "{message}");
}
