//! A view as a line of the scene language, and the file that it is added to.

use std::path::PathBuf;

use super::camera_line;
use super::form::{DialogForm, FieldInput, FormEvent, FormField};
use super::order::{DeskCommand, DeskEvent};
use crate::scene::Camera;

const NAME: usize = 0;
const LINE: usize = 1;
const FILE: usize = 2;

/// Where a view is to be written to.
#[derive(Clone, Debug, PartialEq)]
pub struct LineDialog {
    /// What is asked for.
    pub form: DialogForm,
    camera: Camera,
}

impl LineDialog {
    /// Shows the line of a camera.
    pub fn new(camera: Camera) -> Self {
        // The scene has a view of its own name.
        let name = camera.name.as_ref().map_or_else(|| "view".to_owned(), |name| format!("{name} 2"));
        let fields = vec![
            FormField::line("&Name", "What the view is called", &name),
            FormField::told("Line", String::new()),
            FormField::line(
                "&File",
                "The line is added at the file's end: a scene's own, or one for views",
                "views.scene",
            ),
        ];
        let form = DialogForm::new("WRITE VIEW", fields, vec!["&OK", "Cancel"]);
        let mut dialog = Self { form: DialogForm { width: 78, ..form }, camera };
        dialog.write_line();
        dialog
    }

    /// What comes of what a key did to the form.
    pub fn answer(&mut self, event: FormEvent) -> DeskEvent {
        match event {
            FormEvent::Changed(_) => {
                self.form.message = None;
                self.write_line();
            }
            FormEvent::Entered(_) | FormEvent::Pressed(0) => {
                let path = PathBuf::from(self.form.text(FILE).trim());
                if path.as_os_str().is_empty() {
                    self.form.message = Some("a file has a name".to_owned());
                } else {
                    return DeskEvent::Does(DeskCommand::Append { path, line: self.line() });
                }
            }
            FormEvent::Cancelled | FormEvent::Pressed(_) => return DeskEvent::Closes(None),
            FormEvent::Nothing => {}
        }
        DeskEvent::Stays
    }

    fn line(&self) -> String {
        camera_line::line(&self.form.text(NAME), &self.camera)
    }

    fn write_line(&mut self) {
        self.form.set(LINE, FieldInput::Told(self.line()));
    }
}
