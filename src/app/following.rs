//! One ray that is followed, over the picture: its dot is marked, its story stands beside it.

use std::array;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use super::actions::Action;
use super::follow_order::{FollowOrder, FollowedDot};
use super::lattice_views;
use super::theme::Theme;
use crate::frame::{FollowedRay, Request};
use crate::math::Size;
use crate::tell::Story;

/// A place of the picture, and the story of the ray there.
#[derive(Clone, Debug)]
pub struct Following {
    /// The place, as shares of the picture's width and height, 0 to 1: a picture of another size has it too.
    place: [f64; 2],
    /// The ray that is told of, as soon as there is one; of a picture or a place that may have changed.
    told: Option<FollowedDot>,
    /// The step in hand, by its line.
    step: usize,
    /// Whether the lattice is shown in the place of the story.
    lattice: bool,
}

impl Following {
    /// The middle of the picture.
    pub const fn middle() -> Self {
        Self { place: [0.5; 2], told: None, step: 0, lattice: false }
    }

    /// The cell of a picture that holds the place.
    fn cell(&self, cells: Size) -> [u32; 2] {
        let sides = [cells.width, cells.height];
        array::from_fn(|axis| {
            ((self.place[axis] * f64::from(sides[axis])) as u32).min(sides[axis].saturating_sub(1))
        })
    }

    /// Takes the middle of a cell as the place.
    pub fn go_to(&mut self, cell: [u32; 2], cells: Size) {
        let sides = [cells.width, cells.height];
        self.place = array::from_fn(|axis| {
            let cell = cell[axis].min(sides[axis].saturating_sub(1));
            (f64::from(cell) + 0.5) / f64::from(sides[axis].max(1))
        });
    }

    /// What is to be followed for a picture; absent where that is told of already.
    pub fn order(&self, request: Request) -> Option<FollowOrder> {
        let per_cell = request.glyphs.dots_per_cell();
        let [column, row] = self.cell(request.cells());
        let dot = [column * per_cell.width, row * per_cell.height];
        let order = FollowOrder { request, dot };
        self.told.as_ref().is_none_or(|told| told.order != order).then_some(order)
    }

    /// Tells of a ray from now on, from its first step.
    pub fn tell(&mut self, followed: FollowedDot) {
        self.told = Some(followed);
        self.step = 0;
    }

    /// Tells anew, whatever is told of already: another scene is shown.
    pub fn forget(&mut self) {
        self.told = None;
    }

    /// Shows the lattice in the place of the story.
    pub fn show_lattice(&mut self) {
        self.lattice = true;
    }

    /// The ray that is told of.
    fn ray(&self) -> Option<&FollowedRay> {
        self.told.as_ref()?.ray.as_deref().map(|(ray, _)| ray)
    }

    fn story(&self) -> Option<&Story> {
        self.told.as_ref()?.ray.as_deref().map(|(_, story)| story)
    }

    /// Does what an arrow or a page key asks for here; other actions are not this one's.
    pub fn takes(&mut self, cells: Size, action: Action) -> bool {
        let [column, row] = self.cell(cells);
        let steps = self.story().map_or(0, |story| story.lines.len());
        match action {
            Action::Lattice => self.lattice = !self.lattice,
            Action::OrbitLeft => self.go_to([column.saturating_sub(1), row], cells),
            Action::OrbitRight => self.go_to([column + 1, row], cells),
            Action::OrbitUp => self.go_to([column, row.saturating_sub(1)], cells),
            Action::OrbitDown => self.go_to([column, row + 1], cells),
            Action::StepBack => self.step = self.step.saturating_sub(1),
            Action::StepOn => self.step = (self.step + 1).min(steps.saturating_sub(1)),
            _ => return false,
        }
        true
    }

    /// Marks the dot in `picture`, and writes the story over the half of `screen` that the dot is not in;
    /// gives the places of both.
    pub fn draw(&self, theme: &Theme, picture: Rect, screen: Rect, buffer: &mut Buffer) -> [Rect; 2] {
        let cells = Size::new(picture.width.into(), picture.height.into());
        let [column, row] = self.cell(cells).map(|cell| u16::try_from(cell).unwrap_or(u16::MAX));
        let at = Rect {
            x: picture.x.saturating_add(column),
            y: picture.y.saturating_add(row),
            width: 1,
            height: 1,
        };
        if let Some(cell) = buffer.cell_mut(at.as_position()).filter(|_| picture.contains(at.as_position())) {
            cell.set_symbol("┼").set_style(theme.mark);
        }
        let height = (screen.height / 2).max(3).min(screen.height);
        let is_below = at.y < screen.y + screen.height / 2;
        let y = if is_below { screen.bottom() - height } else { screen.y };
        let place = Rect { y, height, ..screen };
        Clear.render(place, buffer);
        let title = match &self.told {
            Some(told) => format!(" RAY of dot {}, {} ", told.order.dot[0], told.order.dot[1]),
            None => " RAY ".to_owned(),
        };
        let block = Block::bordered()
            .title(Span::styled(title, theme.bright))
            .title_bottom(Line::from(" arrows: ray  PgUp PgDn: step  v: lattice  Esc ").right_aligned())
            .style(theme.text);
        let inside = block.inner(place);
        block.render(place, buffer);
        let Some(story) = self.story() else {
            let why = if self.told.is_some() { "there is no ray to follow" } else { "following it" };
            Line::from(why).render(inside, buffer);
            return [at, place];
        };
        if let (true, Some(ray)) = (self.lattice, self.ray()) {
            lattice_views::draw(ray, theme, inside, buffer);
            return [at, place];
        }
        let rows = story.rows(inside.width.into());
        // The step in hand stands in the middle, as far as there is more above and below.
        let in_hand = rows.iter().position(|row| row.line == self.step).unwrap_or(0);
        let room = usize::from(inside.height);
        let first = in_hand.saturating_sub(room / 2).min(rows.len().saturating_sub(room));
        for (row, y) in rows[first..].iter().zip(inside.top()..inside.bottom()) {
            let style = if row.line == self.step { theme.chosen } else { theme.text };
            let area = Rect { y, height: 1, ..inside };
            buffer.set_style(area, style);
            Line::from(row.to_string()).style(style).render(area, buffer);
        }
        [at, place]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::Settings;
    use crate::app::model::Model;
    use crate::app::window::Window;
    use crate::frame::Studio;
    use crate::glyph::Palette;
    use crate::scene::{ReadOptions, Scene, read};

    fn studio(text: &str) -> Studio {
        Studio::new(read("a.scene", text.as_bytes(), &ReadOptions::default()).unwrap()).unwrap()
    }

    fn press(model: &mut Model, studio: &Studio, actions: &[Action]) {
        for &action in actions {
            model.update(studio, Some(action));
            settle(model, studio);
        }
    }

    /// Follows what is to be followed, as the thread for it does.
    fn settle(model: &mut Model, studio: &Studio) {
        if let Some(order) = model.follow_order() {
            model.tell(order.follow(studio));
        }
    }

    fn lines(model: &Model) -> Vec<String> {
        let story = model.following.as_ref().and_then(Following::story).unwrap();
        story.lines.iter().map(|line| line.text.clone()).collect()
    }

    fn cell(model: &Model) -> [u32; 2] {
        model.following.as_ref().unwrap().cell(model.request().unwrap().cells())
    }

    #[test]
    fn arrows_take_another_ray_and_moves_another_picture() {
        let studio = studio("light(at = [3, -4, 5]); sphere(1);");
        let mut model = Model::new(&studio, Settings::default(), Window::default());
        let camera = model.camera.clone();
        press(&mut model, &studio, &[Action::Follow]);
        let middle = lines(&model);
        assert!(middle.iter().any(|line| line.contains("first of all it meets object 1: sphere 1")));
        press(&mut model, &studio, &[Action::OrbitLeft]);
        assert_ne!(lines(&model), middle);
        press(&mut model, &studio, &[Action::OrbitRight]);
        assert_eq!((lines(&model), &model.camera), (middle.clone(), &camera));
        press(&mut model, &studio, &[Action::FlyForward]);
        assert!(lines(&model) != middle && model.camera != camera);
        press(&mut model, &studio, &[Action::Close, Action::OrbitLeft]);
        assert!(model.following.is_none() && model.view_name().ends_with('*'));
    }

    #[test]
    fn neither_dots_nor_steps_go_past_their_ends() {
        let studio = studio("light(at = [3, -4, 5]); sphere(1);");
        let mut model = Model::new(&studio, Settings::default(), Window::default());
        press(&mut model, &studio, &[Action::Follow]);
        press(&mut model, &studio, &[Action::OrbitRight; 99]);
        press(&mut model, &studio, &[Action::OrbitDown; 99]);
        press(&mut model, &studio, &[Action::StepOn; 99]);
        let picture = model.layout.picture;
        assert_eq!(cell(&model), [u32::from(picture.width) - 1, u32::from(picture.height) - 1]);
        assert_eq!(model.following.as_ref().unwrap().step + 1, lines(&model).len());
        press(&mut model, &studio, &[Action::OrbitLeft; 99]);
        press(&mut model, &studio, &[Action::OrbitUp; 99]);
        press(&mut model, &studio, &[Action::StepBack; 99]);
        assert_eq!((cell(&model), model.following.as_ref().unwrap().step), ([0, 0], 0));
    }

    /// A place was a cell: on a terminal that had been smaller for a while it was another.
    #[test]
    fn a_smaller_terminal_keeps_the_place() {
        let studio = studio("light(at = [3, -4, 5]); sphere(1);");
        let [large, small] = [(200, 60), (20, 5)].map(|(width, height)| Window {
            cells: ratatui::layout::Size::new(width, height),
            ..Window::default()
        });
        let mut model = Model::new(&studio, Settings::default(), large);
        press(&mut model, &studio, &[Action::Follow]);
        press(&mut model, &studio, &[Action::OrbitRight; 70]);
        let before = cell(&model);
        for window in [small, large] {
            model.resize(&studio, window);
            settle(&mut model, &studio);
        }
        assert_eq!(cell(&model), before);
    }

    #[test]
    fn no_area_is_too_small() {
        let studio = Studio::new(Scene::default()).unwrap();
        let model = Model::new(&studio, Settings::default(), Window::default());
        let mut following = Following::middle();
        for _ in 0..2 {
            for (width, height) in [(0, 0), (1, 1), (5, 3), (40, 2), (200, 60)] {
                let area = Rect::new(0, 0, width, height);
                let places = following.draw(&Theme::of(Palette::DOS), area, area, &mut Buffer::empty(area));
                assert_eq!(places[1].intersection(area), places[1]);
            }
            if let Some(order) = following.order(model.request().unwrap()) {
                following.tell(order.follow(&studio));
            }
        }
    }
}
