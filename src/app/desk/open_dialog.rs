//! F2: which scene is to be opened: a file of a folder, or one that is inside the program.

use std::fs;
use std::path::{Path, PathBuf};

use super::form::{ChoiceList, DialogForm, FieldInput, FormEvent, FormField};
use super::order::{DeskCommand, DeskEvent};
use crate::scene::embedded;

const PATH: usize = 0;
const FOLDER: usize = 1;
const LIST: usize = 2;

/// The endings of files that the readers know by their content; any other can be typed.
const ENDINGS: [&str; 10] = ["scene", "csg", "scad", "nff", "stl", "obj", "off", "ply", "3mf", "amf"];

/// So many names of a folder are looked at: nobody scrolls through more, and a folder may have millions.
const MOST_NAMES: usize = 20_000;

/// Which scene is to be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OpenDialog {
    /// What is asked for.
    pub form: DialogForm,
    /// What stands for each row when it is chosen.
    names: Vec<String>,
}

impl OpenDialog {
    /// Lists a folder, and the scenes inside the program.
    pub fn new(folder: &Path) -> Self {
        let hint = "A path, or the name of a scene inside the program; Enter opens it";
        let fields = vec![
            FormField::line("&Path", hint, ""),
            FormField::told("In", String::new()),
            FormField::list(
                "&Scenes",
                "Enter opens the scene, or goes into the folder; letters begin a path",
                Vec::new(),
                0,
            ),
        ];
        let form = DialogForm::new("OPEN", fields, vec!["&OK", "Cancel"]);
        let mut dialog = Self { form, names: Vec::new() };
        (dialog.form.focus, dialog.form.typed_into) = (LIST, Some(PATH));
        dialog.go_into(folder);
        dialog
    }

    /// What comes of what a key did to the form.
    pub fn answer(&mut self, event: FormEvent) -> DeskEvent {
        match event {
            FormEvent::Changed(LIST) => {
                self.form.message = None;
                self.write_chosen();
            }
            FormEvent::Changed(_) => self.form.message = None,
            FormEvent::Entered(_) | FormEvent::Pressed(0) => return self.open(),
            FormEvent::Cancelled | FormEvent::Pressed(_) => return DeskEvent::Closes(None),
            FormEvent::Nothing => {}
        }
        DeskEvent::Stays
    }

    fn open(&mut self) -> DeskEvent {
        let name = self.form.text(PATH);
        let path = PathBuf::from(name.trim());
        if name.trim().is_empty() {
            self.form.message = Some("no scene is chosen".to_owned());
        } else if path.is_dir() {
            self.go_into(&path);
        } else {
            self.form.message = Some("reading".to_owned());
            return DeskEvent::Does(DeskCommand::Open(name.trim().to_owned()));
        }
        DeskEvent::Stays
    }

    /// Lists another folder; where it can not be read, says why.
    fn go_into(&mut self, folder: &Path) {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        let mut rows: Vec<(String, String)> = Vec::new();
        if let Some(parent) = folder.parent() {
            rows.push(("../".to_owned(), parent.to_string_lossy().into_owned()));
        }
        self.form.message = None;
        match listed(&folder) {
            Ok(found) => rows.extend(found),
            Err(error) => self.form.message = Some(format!("{}: {error}", folder.display())),
        }
        let inside = embedded()
            .iter()
            .map(|scene| (format!("{:<12} {}", scene.name, scene.title), scene.name.to_owned()));
        rows.extend(inside);
        let (rows, names) = rows.into_iter().unzip();
        self.names = names;
        self.form.set(FOLDER, FieldInput::Told(folder.to_string_lossy().into_owned()));
        self.form.set(LIST, FieldInput::List(ChoiceList { rows, chosen: 0 }));
        self.write_chosen();
    }

    fn write_chosen(&mut self) {
        let name = self.names.get(self.form.chosen(LIST)).cloned().unwrap_or_default();
        self.form.set_line(PATH, &name);
    }
}

/// The folders of a folder, then its files that may hold a scene, each by name: what is shown, and its path.
fn listed(folder: &Path) -> std::io::Result<Vec<(String, String)>> {
    let mut folders = Vec::new();
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)?.take(MOST_NAMES) {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = entry.path();
        let whole = path.to_string_lossy().into_owned();
        // What begins with a dot is hidden by custom. A link is what it leads to.
        if name.starts_with('.') {
            continue;
        }
        if path.is_dir() {
            folders.push((name + "/", whole));
        } else if is_scene(&path) {
            files.push((name, whole));
        }
    }
    folders.sort();
    files.sort();
    folders.extend(files);
    Ok(folders)
}

fn is_scene(path: &Path) -> bool {
    let ending = |path: &Path| path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let last = ending(path);
    let packed = last.as_deref() == Some("gz");
    let last = if packed { ending(&path.with_extension("")) } else { last };
    last.is_some_and(|last| ENDINGS.contains(&last.as_str()))
}

#[cfg(test)]
mod tests {
    use ratatui::crossterm::event::KeyCode;

    use super::*;

    fn press(dialog: &mut OpenDialog, codes: &[KeyCode]) -> DeskEvent {
        let mut last = DeskEvent::Stays;
        for &code in codes {
            let event = dialog.form.take(code.into());
            last = dialog.answer(event);
        }
        last
    }

    #[test]
    fn folders_are_gone_into_and_scenes_are_opened() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("parts")).unwrap();
        for name in ["b.scene", "a.STL", "c.nff.gz", "notes.md", ".hidden.scene", "parts/gear.csg"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        let mut dialog = OpenDialog::new(folder.path());
        let FieldInput::List(list) = &dialog.form.fields[LIST].input else { panic!("a list") };
        assert_eq!(list.rows[..5], ["../", "parts/", "a.STL", "b.scene", "c.nff.gz"]);
        assert_eq!(list.rows.len(), 5 + embedded().len());
        let keys = [KeyCode::Down, KeyCode::Enter, KeyCode::Down, KeyCode::Enter];
        let gear = fs::canonicalize(folder.path()).unwrap().join("parts").join("gear.csg");
        let opens = DeskEvent::Does(DeskCommand::Open(gear.to_string_lossy().into_owned()));
        assert_eq!(press(&mut dialog, &keys), opens);
        let opens = DeskEvent::Does(DeskCommand::Open("die".to_owned()));
        let keys = [KeyCode::BackTab, KeyCode::BackTab].map(|_| KeyCode::Tab);
        press(&mut dialog, &[KeyCode::BackTab]);
        let typed: Vec<KeyCode> = "die".chars().map(KeyCode::Char).chain([KeyCode::Enter]).collect();
        assert_eq!(press(&mut dialog, &typed), opens);
        press(&mut dialog, &keys);
        assert_eq!(press(&mut dialog, &[KeyCode::Esc]), DeskEvent::Closes(None));
    }

    #[test]
    fn a_folder_that_can_not_be_read_says_why() {
        let mut dialog = OpenDialog::new(Path::new("no such folder"));
        assert!(dialog.form.message.as_ref().unwrap().contains("no such folder"));
        press(&mut dialog, &[KeyCode::End]);
        assert_eq!(dialog.form.message, None);
        assert_eq!(dialog.form.text(PATH), embedded().last().unwrap().name);
    }
}
