//! F3: eye, target and field, typed or taken from a view.

use super::camera_line::{listed, number, parsed, rounded};
use super::form::{DialogForm, FormEvent, FormField};
use super::order::{DeskCommand, DeskEvent};
use crate::math::DVec3;
use crate::scene::{Camera, FieldSpan};

const LIST: usize = 0;
const EYE: usize = 1;
const TARGET: usize = 2;
const UP: usize = 3;
const FIELD: usize = 4;
const ZOOM: usize = 5;

/// A place to see the scene from.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewPlace {
    /// What it is called.
    pub name: String,
    /// The place.
    pub camera: Camera,
}

/// From where the scene is seen.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewDialog {
    /// What is asked for.
    pub form: DialogForm,
    places: Vec<ViewPlace>,
}

/// What comes of a key.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewEvent {
    /// What any dialog may ask for.
    Desk(DeskEvent),
    /// This camera is to be written down.
    Writes(Box<Camera>),
}

impl ViewDialog {
    /// Offers some places, of which the first is where the eye is now.
    pub fn new(places: Vec<ViewPlace>) -> Self {
        let rows = places.iter().map(|place| place.name.clone()).collect();
        let fields = vec![
            FormField::list("&Views", "Arrows take the numbers of a view; Enter goes there", rows, 0),
            FormField::line("&Eye", "Where the eye is: x, y, z", ""),
            FormField::line("&Target", "A point that it looks at: x, y, z", ""),
            FormField::line("&Up", "A direction that is upwards in the picture: x, y, z", ""),
            FormField::line("&Field", "Full angles across and down, in degrees", ""),
            FormField::line("&Zoom", "2 shows everything twice as large", ""),
        ];
        let form = DialogForm::new("VIEW", fields, vec!["&OK", "&Write...", "Cancel"]);
        let mut dialog = Self { form: DialogForm { width: 60, ..form }, places };
        dialog.take_numbers();
        dialog
    }

    /// What comes of what a key did to the form.
    pub fn answer(&mut self, event: FormEvent) -> ViewEvent {
        let desk = match event {
            FormEvent::Changed(LIST) => {
                self.form.message = None;
                self.take_numbers();
                DeskEvent::Stays
            }
            FormEvent::Changed(_) => {
                self.form.message = None;
                DeskEvent::Stays
            }
            FormEvent::Entered(_) | FormEvent::Pressed(0 | 1) => match self.camera() {
                Ok(camera) if event == FormEvent::Pressed(1) => return ViewEvent::Writes(Box::new(camera)),
                Ok(camera) => DeskEvent::Closes(Some(DeskCommand::Look(Box::new(camera)))),
                Err(message) => {
                    self.form.message = Some(message);
                    DeskEvent::Stays
                }
            },
            FormEvent::Cancelled | FormEvent::Pressed(_) => DeskEvent::Closes(None),
            FormEvent::Nothing => DeskEvent::Stays,
        };
        ViewEvent::Desk(desk)
    }

    fn take_numbers(&mut self) {
        let Some(ViewPlace { camera, .. }) = self.places.get(self.form.chosen(LIST)) else { return };
        let Camera { eye, target, up, field, zoom, .. } = camera.clone();
        let distance = (target - eye).length();
        let [eye, target] =
            [eye, target].map(|point| DVec3::from(point.to_array().map(|x| rounded(x, distance))));
        self.form.set_line(EYE, &listed(&eye.to_array()));
        self.form.set_line(TARGET, &listed(&target.to_array()));
        self.form.set_line(UP, &listed(&up.to_array()));
        self.form.set_line(FIELD, &listed(&field));
        self.form.set_line(ZOOM, &number(zoom));
    }

    /// The camera that the numbers mean, or what is wrong with them.
    fn camera(&self) -> Result<Camera, String> {
        let text = |field| self.form.text(field);
        let eye = DVec3::from(parsed(&text(EYE), "eye", "0, -9, 3")?);
        let target = DVec3::from(parsed(&text(TARGET), "target", "0, 0, 0.5")?);
        let up = DVec3::from(parsed(&text(UP), "up", "0, 0, 1")?);
        let field = parsed(&text(FIELD), "field", "40 x 25")?;
        let [zoom] = parsed(&text(ZOOM), "zoom", "1.5")?;
        let name = self.places.get(self.form.chosen(LIST)).and_then(|place| place.camera.name.clone());
        let camera = Camera { name, eye, target, up, field, span: FieldSpan::Edges, zoom };
        camera.check().map_err(|error| error.to_string())?;
        Ok(camera)
    }
}
