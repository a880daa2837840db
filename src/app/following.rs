//! One ray that is followed, over the picture: its dot is marked, its story stands beside it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use super::Painter;
use super::actions::Action;
use super::theme::Theme;
use crate::frame::Request;
use crate::math::Size;
use crate::tell::Story;

/// A dot of the picture, and the story of its ray.
#[derive(Clone, Debug)]
pub struct Following {
    /// The cell of the picture whose first dot is followed.
    cell: [u32; 2],
    /// That dot.
    dot: [u32; 2],
    /// Absent where there is nothing to follow.
    story: Option<Story>,
    /// The step in hand, by its line.
    step: usize,
}

impl Following {
    /// The dot in the middle of a picture.
    pub fn middle(painter: &dyn Painter, request: &Request) -> Self {
        let Size { width, height } = request.cells();
        let mut following = Self { cell: [width / 2, height / 2], dot: [0; 2], story: None, step: 0 };
        following.again(painter, request);
        following
    }

    /// Follows the same place in another picture, from the first step.
    pub fn again(&mut self, painter: &dyn Painter, request: &Request) {
        let Size { width, height } = request.cells();
        let last = [width, height].map(|cells| cells.saturating_sub(1));
        self.cell = std::array::from_fn(|axis| self.cell[axis].min(last[axis]));
        let per_cell = request.glyphs.dots_per_cell();
        self.dot = [self.cell[0] * per_cell.width, self.cell[1] * per_cell.height];
        let followed = painter.follow(request, self.dot);
        self.story = followed.map(|followed| Story::new(&followed, request, painter.scene(), None));
        self.step = 0;
    }

    /// Does what an arrow or a page key asks for here; other actions are not this one's.
    pub fn takes(&mut self, painter: &dyn Painter, request: &Request, action: Action) -> bool {
        let [column, row] = self.cell;
        let steps = self.story.as_ref().map_or(0, |story| story.lines.len());
        match action {
            Action::OrbitLeft => self.cell[0] = column.saturating_sub(1),
            Action::OrbitRight => self.cell[0] = column + 1,
            Action::OrbitUp => self.cell[1] = row.saturating_sub(1),
            Action::OrbitDown => self.cell[1] = row + 1,
            Action::StepBack => {
                self.step = self.step.saturating_sub(1);
                return true;
            }
            Action::StepOn => {
                self.step = (self.step + 1).min(steps.saturating_sub(1));
                return true;
            }
            _ => return false,
        }
        self.again(painter, request);
        true
    }

    /// Marks the dot in `picture`, and writes the story over the half of `screen` that the dot is not in;
    /// gives the places of both.
    pub fn draw(&self, theme: &Theme, picture: Rect, screen: Rect, buffer: &mut Buffer) -> [Rect; 2] {
        let [column, row] = self.cell.map(|cell| u16::try_from(cell).unwrap_or(u16::MAX));
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
        let title = format!(" RAY of dot {}, {} ", self.dot[0], self.dot[1]);
        let block = Block::bordered()
            .title(Span::styled(title, theme.bright))
            .title_bottom(Line::from(" arrows: ray  PgUp PgDn: step  Esc ").right_aligned())
            .style(theme.text);
        let inside = block.inner(place);
        block.render(place, buffer);
        let Some(story) = &self.story else {
            Line::from("there is no ray to follow").render(inside, buffer);
            return [at, place];
        };
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
        }
    }

    fn lines(model: &Model) -> Vec<String> {
        let story = model.following.as_ref().and_then(|following| following.story.as_ref()).unwrap();
        story.lines.iter().map(|line| line.text.clone()).collect()
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
        let Following { cell, step, .. } = model.following.as_ref().unwrap();
        assert_eq!(*cell, [u32::from(picture.width) - 1, u32::from(picture.height) - 1]);
        assert_eq!(*step + 1, lines(&model).len());
        press(&mut model, &studio, &[Action::OrbitLeft; 99]);
        press(&mut model, &studio, &[Action::OrbitUp; 99]);
        press(&mut model, &studio, &[Action::StepBack; 99]);
        let Following { cell, step, .. } = model.following.as_ref().unwrap();
        assert_eq!((*cell, *step), ([0, 0], 0));
    }

    #[test]
    fn no_area_is_too_small() {
        let studio = Studio::new(Scene::default()).unwrap();
        let model = Model::new(&studio, Settings::default(), Window::default());
        let following = Following::middle(&studio, &model.request().unwrap());
        for (width, height) in [(0, 0), (1, 1), (5, 3), (40, 2), (200, 60)] {
            let area = Rect::new(0, 0, width, height);
            let places = following.draw(&Theme::of(Palette::DOS), area, area, &mut Buffer::empty(area));
            assert_eq!(places[1].intersection(area), places[1]);
        }
    }
}
