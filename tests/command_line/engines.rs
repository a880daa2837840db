//! Engines and presets.

mod an_engine {
    use crate::{done, fails, run, text};

    fn used(options: &[&str]) -> (String, String) {
        let render = ["render", "hanyang", "--dots", "40x30", "--format", "levels", "--stats", "json"];
        let output = run(&[&render, options].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        let stats: serde_json::Value = serde_json::from_slice(&output.stderr).expect("JSON");
        let word = |key: &str| stats[key].as_str().unwrap().to_owned();
        (word("engine"), word("structure"))
    }

    #[test]
    fn is_the_fast_one_unless_another_structure_is_asked_for() {
        for (options, engine, structure) in [
            (&[][..], "fast", "boxes"),
            (&["--engine", "auto"], "fast", "boxes"),
            (&["--structure", "boxes"], "fast", "boxes"),
            (&["--structure", "none"], "exact", "none"),
            (&["--structure", "lattice"], "exact", "lattice"),
            (&["--structure", "tree"], "exact", "tree"),
            (&["--preset", "pcat"], "exact", "lattice"),
            (&["--preset", "pcat", "--structure", "auto"], "fast", "boxes"),
            (&["--preset", "pcat", "--engine", "fast"], "fast", "boxes"),
            (&["--engine", "exact"], "exact", "boxes"),
            (&["--engine", "exact", "--structure", "boxes"], "exact", "boxes"),
        ] {
            assert_eq!(used(options), (engine.to_owned(), structure.to_owned()), "{options:?}");
        }
    }

    #[test]
    fn shows_the_same_picture() {
        let picture = |engine: &str| {
            done(&run(&["render", "glass", "--format", "pfm", "--dots", "160x100", "--engine", engine]))
        };
        assert!(picture("fast") == picture("exact"));
    }

    #[test]
    fn that_can_not_be_had_says_what_to_do() {
        let message = fails(&run(&["render", "die", "--engine", "fast", "--structure", "lattice"]), 2);
        assert!(message.contains("lattice") && message.contains("leave out --engine"), "{message}");
    }
}

mod the_preset {
    use crate::{done, run, text};

    fn levels(options: &[&str]) -> Vec<u8> {
        done(&run(&[&["render", "hanyang", "--format", "levels", "--preset", "pcat"], options].concat()))
    }

    #[test]
    fn is_the_picture_of_the_paper() {
        let picture = text(&levels(&[]));
        let snapshot = include_str!("../pictures/snapshots/pictures__pictures__pcat__front.snap");
        assert!(snapshot.contains(picture.trim_end()), "not figure 8");
        assert_eq!(picture.lines().map(str::len).collect::<Vec<_>>(), [164; 188]);
    }

    #[test]
    fn gives_way_to_what_is_said_besides() {
        let all = levels(&[]);
        for option in [
            &["--shading", "1"][..],
            &["--shadows"],
            &["--tone", "lightness"],
            &["--field", "60x40"],
            &["--zoom", "2"],
        ] {
            let picture = levels(option);
            assert!(picture != all && picture.len() == all.len(), "{option:?}");
        }
        assert_eq!(text(&levels(&["--dots", "30x20"])).lines().count(), 20);
        assert_eq!(text(&levels(&["--cells", "30x20"])).lines().count(), 80);
        assert_eq!(levels(&["--structure", "none"]), all);
        assert_eq!(levels(&["--no-shadows"]), all);
    }
}
