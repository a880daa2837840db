//! Keys and clicks where menus or dialogs are open, or open them.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Position;

use super::Painter;
use super::actions::{Action, StandardView};
use super::desk::{Desk, DeskCommand, DeskEvent, GlyphDialog, MenuBar, OpenDialog, SaveDialog};
use super::desk::{ViewDialog, ViewPlace};
use super::keys;
use super::model::{Effect, Model};
use crate::scene::{Camera, FieldSpan};
use crate::view::{Picture, PinholeCamera};

impl Model {
    /// Does what a key asks for: first in what is open, then in the picture.
    pub fn key(&mut self, painter: &dyn Painter, key: KeyEvent) -> Effect {
        self.told = None;
        let action = keys::action(key);
        if key.modifiers.contains(KeyModifiers::CONTROL)
            && let Some(action @ (Action::Quit | Action::Suspend | Action::Redraw)) = action
        {
            // Whatever is open.
            return self.update(painter, Some(action));
        }
        if let Some(mut desk) = self.desk.take() {
            let event = desk.take(key);
            return self.after(painter, desk, event);
        }
        if self.help {
            return self.update(painter, action);
        }
        let has_alt = key.modifiers.contains(KeyModifiers::ALT);
        let escaped = std::mem::take(&mut self.escaped);
        if let Some(key) = keys::function_key(key).filter(|_| has_alt || escaped) {
            return self.update(painter, keys::action(key));
        }
        if let (KeyCode::Char(letter), true) = (key.code, has_alt)
            && let Some(menus) = MenuBar::of_letter(letter)
        {
            self.desk = Some(Desk::Menus(menus));
            return Effect::None;
        }
        // Where there is nothing to close, Esc begins what Norton took for a function key.
        self.escaped = key.code == KeyCode::Esc && self.following.is_none() && self.trade.is_none();
        self.update(painter, action)
    }

    /// Does what a click at a place of the screen asks for.
    pub fn click(&mut self, painter: &dyn Painter, at: Position) -> Effect {
        self.told = None;
        if let Some(mut desk) = self.desk.take() {
            let event = desk.click(at, self.layout.screen);
            return self.after(painter, desk, event);
        }
        if std::mem::take(&mut self.help) {
            return Effect::None;
        }
        if let Some(number) = super::around::function_key_at(&self.layout.around, at) {
            let key = KeyEvent::new(KeyCode::F(number), KeyModifiers::NONE);
            return self.update(painter, keys::action(key));
        }
        let picture = self.layout.picture;
        if let (Some(following), true) = (&mut self.following, picture.contains(at)) {
            let cells = crate::math::Size::new(picture.width.into(), picture.height.into());
            following.go_to([u32::from(at.x - picture.x), u32::from(at.y - picture.y)], cells);
        } else if let Some(menus) = MenuBar::at(at, self.layout.screen) {
            self.desk = Some(Desk::Menus(menus));
        }
        Effect::None
    }

    /// Does what a turn of the wheel asks for: in the picture, an action.
    pub fn wheel(&mut self, painter: &dyn Painter, action: Action) -> Effect {
        let is_open = self.desk.is_some() || self.help;
        self.update(painter, Some(action).filter(|_| !is_open))
    }

    /// Opens what an action asks for; gives whether it is one of these.
    pub fn opens(&mut self, painter: &dyn Painter, action: Action) -> bool {
        self.desk = Some(match action {
            Action::Menu => Desk::Menus(MenuBar::first()),
            Action::Open => Desk::Open(OpenDialog::new(&self.settings.folder)),
            Action::View => Desk::View(ViewDialog::new(self.places(painter))),
            Action::Glyphs => Desk::Glyphs(GlyphDialog::new(self.glyph_modes(), self.settings.glyphs)),
            Action::Save => Desk::Save(SaveDialog::new(&self.settings.title, self.settings.formats.clone())),
            _ => return false,
        });
        true
    }

    fn after(&mut self, painter: &dyn Painter, desk: Desk, event: DeskEvent) -> Effect {
        match event {
            DeskEvent::Stays => {
                self.desk = Some(desk);
                Effect::None
            }
            DeskEvent::Does(command) => {
                self.desk = Some(desk);
                self.follow_command(command)
            }
            DeskEvent::Closes(command) => command.map_or(Effect::None, |it| self.follow_command(it)),
            DeskEvent::Acts(action) => self.update(painter, Some(action)),
        }
    }

    fn follow_command(&mut self, command: DeskCommand) -> Effect {
        match command {
            DeskCommand::Open(name) => return Effect::Open(name),
            DeskCommand::Save(order) => return Effect::Save(order),
            DeskCommand::Append { path, line } => return Effect::Append(path, line),
            DeskCommand::Look(camera) => self.jump(*camera),
            DeskCommand::Draw(glyphs) => self.settings.glyphs = glyphs,
        }
        Effect::None
    }

    /// Where the scene may be seen from: where it is now, each view of its own, all of it from the sides of
    /// draughtsmen, and where the eye was.
    fn places(&self, painter: &dyn Painter) -> Vec<ViewPlace> {
        let aspect = self.aspect();
        let mut places = vec![(format!("now: {}", self.view_name()), self.camera.clone())];
        for view in 0..self.views {
            let camera = painter.camera(view, aspect);
            let name = camera.name.clone().unwrap_or_else(|| (view + 1).to_string());
            places.push((format!("view of the scene: {name}"), camera));
        }
        let all = painter.framed(self.camera.eye - self.camera.target, self.camera.up, aspect);
        places.push(("all of it from this side".to_owned(), all));
        for view in StandardView::ALL {
            places.push((format!("all of it {}", view.name()), view.camera(painter, aspect)));
        }
        if let Some(last) = self.history.last() {
            places.push(("the last view".to_owned(), last.clone()));
        }
        let edges = |(name, camera)| ViewPlace { name, camera: self.between_edges(camera) };
        places.into_iter().map(edges).collect()
    }

    /// The same camera with its field between the edges of the picture, as people type it.
    fn between_edges(&self, camera: Camera) -> Camera {
        let Some(request) = self.request().filter(|_| camera.span != FieldSpan::Edges) else { return camera };
        let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
        let field = PinholeCamera::new(&Camera { zoom: 1.0, ..camera.clone() }, &picture).field();
        Camera { field, span: FieldSpan::Edges, ..camera }
    }
}

#[cfg(test)]
#[path = "openings_tests.rs"]
mod tests;
