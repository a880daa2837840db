//! F8: where the picture is saved, and as what. A file that is there is replaced only where that is said.

use std::path::{Path, PathBuf};

use super::form::{DialogForm, FormEvent, FormField};
use super::order::{DeskCommand, DeskEvent, SaveFailure, SaveFormat, SaveOrder};

const NAME: usize = 0;
const FORMAT: usize = 1;

/// Where the picture is saved, and as what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SaveDialog {
    /// What is asked for.
    pub form: DialogForm,
    formats: Vec<SaveFormat>,
    /// The file that is there and may be replaced when the button is pressed that says so.
    there: Option<PathBuf>,
}

impl SaveDialog {
    /// Offers a name in the folder where the program runs, made of that of the scene.
    pub fn new(title: &str, formats: Vec<SaveFormat>) -> Self {
        let stem = Path::new(title).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let stem = stem.filter(|stem| !stem.is_empty()).unwrap_or_else(|| "picture".to_owned());
        let first = formats.first().map_or("txt", |format| format.name.as_str());
        let rows = formats.iter().map(|format| format!("{:<7} {}", format.name, format.holds)).collect();
        let fields = vec![
            FormField::line("&File", "The file; its folder has to be there", &format!("{stem}.{first}")),
            FormField::list("For&mat", "What the file holds", rows, 0),
        ];
        let mut form = DialogForm::new("SAVE", fields, vec!["&OK", "Cancel"]);
        form.width = 76;
        if formats.is_empty() {
            form.message = Some("this program saves no pictures".to_owned());
        }
        Self { form, formats, there: None }
    }

    /// What comes of what a key did to the form.
    pub fn answer(&mut self, event: FormEvent) -> DeskEvent {
        match event {
            FormEvent::Changed(FORMAT) => {
                let path = PathBuf::from(self.form.text(NAME));
                if let Some(format) = self.formats.get(self.form.chosen(FORMAT)) {
                    self.form.set_line(NAME, &path.with_extension(&format.name).to_string_lossy());
                }
                self.ask_anew();
            }
            FormEvent::Changed(_) => {
                // What is typed says the format too, where its ending is that of one.
                let ending =
                    Path::new(&self.form.text(NAME)).extension().map(|e| e.to_string_lossy().into_owned());
                let format =
                    self.formats.iter().position(|format| Some(format.name.as_str()) == ending.as_deref());
                if let Some(format) = format {
                    self.form.choose(FORMAT, format);
                }
                self.ask_anew();
            }
            FormEvent::Entered(_) | FormEvent::Pressed(0) => return self.save(event),
            FormEvent::Cancelled | FormEvent::Pressed(_) => return DeskEvent::Closes(None),
            FormEvent::Nothing => {}
        }
        DeskEvent::Stays
    }

    fn save(&mut self, event: FormEvent) -> DeskEvent {
        let Some(format) = self.formats.get(self.form.chosen(FORMAT)) else { return DeskEvent::Stays };
        let name = self.form.text(NAME);
        if name.trim().is_empty() {
            self.form.message = Some("a file has a name".to_owned());
            return DeskEvent::Stays;
        }
        let path = PathBuf::from(name);
        // Enter in the line is no word on a file that would be lost; the button says what it does.
        let replaces = event == FormEvent::Pressed(0) && self.there.as_ref() == Some(&path);
        self.form.message = Some("saving".to_owned());
        DeskEvent::Does(DeskCommand::Save(SaveOrder { path, format: format.name.clone(), replaces }))
    }

    /// Says why it was not saved.
    pub fn failed(&mut self, failure: SaveFailure) {
        match failure {
            SaveFailure::Exists => {
                let name = self.form.text(NAME);
                self.form.message = Some(format!("{name} is there already: Replace overwrites it"));
                self.form.buttons[0] = "&Replace";
                self.there = Some(PathBuf::from(name));
            }
            SaveFailure::Because(message) => self.form.message = Some(message),
        }
    }

    fn ask_anew(&mut self) {
        self.there = None;
        self.form.message = None;
        self.form.buttons[0] = "&OK";
    }
}

#[cfg(test)]
mod tests {
    use ratatui::crossterm::event::KeyCode;

    use super::*;

    fn dialog() -> SaveDialog {
        let formats = [("txt", "text"), ("png", "pixels")]
            .map(|(name, holds)| SaveFormat { name: name.to_owned(), holds: holds.to_owned() });
        SaveDialog::new("a.scene", formats.to_vec())
    }

    fn press(dialog: &mut SaveDialog, codes: &[KeyCode]) -> DeskEvent {
        let mut last = DeskEvent::Stays;
        for &code in codes {
            let event = dialog.form.take(code.into());
            last = dialog.answer(event);
        }
        last
    }

    fn order(path: &str, format: &str, replaces: bool) -> DeskEvent {
        DeskEvent::Does(DeskCommand::Save(SaveOrder {
            path: path.into(),
            format: format.to_owned(),
            replaces,
        }))
    }

    #[test]
    fn the_ending_and_the_format_follow_each_other() {
        let mut dialog = dialog();
        assert_eq!(press(&mut dialog, &[KeyCode::Enter]), order("a.txt", "txt", false));
        let keys = [KeyCode::Tab, KeyCode::Down, KeyCode::Enter];
        assert_eq!(press(&mut dialog, &keys), order("a.png", "png", false));
        let typed = "b.txt".chars().map(KeyCode::Char);
        let keys: Vec<KeyCode> =
            [KeyCode::BackTab].into_iter().chain(typed).chain([KeyCode::Enter]).collect();
        assert_eq!(press(&mut dialog, &keys), order("b.txt", "txt", false));
    }

    #[test]
    fn what_is_there_is_replaced_only_by_the_button_that_says_so() {
        let mut dialog = dialog();
        press(&mut dialog, &[KeyCode::Enter]);
        dialog.failed(SaveFailure::Exists);
        assert_eq!(press(&mut dialog, &[KeyCode::Enter]), order("a.txt", "txt", false));
        dialog.failed(SaveFailure::Exists);
        let keys = [KeyCode::Tab, KeyCode::Tab, KeyCode::Enter];
        assert_eq!(press(&mut dialog, &keys), order("a.txt", "txt", true));
        // Another name is another file.
        dialog.failed(SaveFailure::Exists);
        let keys = [
            KeyCode::BackTab,
            KeyCode::BackTab,
            KeyCode::Char('c'),
            KeyCode::Tab,
            KeyCode::Tab,
            KeyCode::Enter,
        ];
        assert_eq!(press(&mut dialog, &keys), order("c", "txt", false));
    }
}
