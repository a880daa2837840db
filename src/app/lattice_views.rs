//! The lattice from the top, the front and the side, with the cells that a ray enters.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Widget;

use super::theme::Theme;
use crate::frame::FollowedRay;
use crate::math::{Bounds, DVec3};
use crate::stage::{RayEvent, RayKind};

/// The views: name, the axis to the right and the axis upwards.
const VIEWS: [(&str, usize, usize); 3] = [("top: x, y", 0, 1), ("front: x, z", 0, 2), ("side: y, z", 1, 2)];

/// A character cell is about twice as high as it is wide.
const ROW_PER_COLUMN: f64 = 2.0;

/// Points of a ray that are marked for each column of a view: enough that no column is missed by one that
/// goes across.
const POINTS_PER_COLUMN: u32 = 4;

/// Draws the three views beside each other.
pub fn draw(followed: &FollowedRay, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    let width = area.width / 3;
    for (number, (name, right, up)) in (0..).zip(VIEWS) {
        let place = Rect { x: area.x + number * width, width: width.saturating_sub(1), ..area };
        if place.height < 2 || place.width == 0 {
            return;
        }
        Line::styled(format!(" {name}"), theme.bright).render(Rect { height: 1, ..place }, buffer);
        let inside = Rect { y: place.y + 1, height: place.height - 1, ..place };
        if let Some(view) = FlatView::new(followed, [right, up], inside) {
            view.draw(followed, theme, buffer);
        }
    }
}

/// A view along an axis.
struct FlatView {
    /// To the right, and upwards.
    axes: [usize; 2],
    /// Where it is drawn.
    area: Rect,
    /// What stands in the lower left corner.
    low: [f64; 2],
    /// A column, and a row, in the scene's unit.
    step: [f64; 2],
}

impl FlatView {
    /// A view of all that there is; `None` where that has no size.
    fn new(followed: &FollowedRay, axes: [usize; 2], area: Rect) -> Option<Self> {
        let world = followed.drawn_space.world;
        let low = axes.map(|axis| world.lo[axis]);
        let size = axes.map(|axis| world.hi[axis] - world.lo[axis]);
        // The last column and the last row hold the upper bounds themselves.
        let room = [area.width, area.height].map(|cells| f64::from(cells.saturating_sub(1).max(1)));
        let column = (size[0] / room[0]).max(size[1] / room[1] / ROW_PER_COLUMN);
        let is_drawn = column > 0.0 && column.is_finite();
        is_drawn.then_some(Self { axes, area, low, step: [column, column * ROW_PER_COLUMN] })
    }

    fn column(&self, x: f64) -> Option<u16> {
        let column = ((x - self.low[0]) / self.step[0]).round();
        (0.0..f64::from(self.area.width)).contains(&column).then(|| self.area.x + column as u16)
    }

    fn row(&self, y: f64) -> Option<u16> {
        let row = ((y - self.low[1]) / self.step[1]).round();
        let is_inside = (0.0..f64::from(self.area.height)).contains(&row);
        is_inside.then(|| self.area.bottom() - 1 - row as u16)
    }

    /// The rectangle of a box, as far as it is in sight.
    fn rectangle(&self, b: &Bounds) -> Option<Rect> {
        let [right, up] = self.axes;
        let (left, end) = (self.column(b.lo[right])?, self.column(b.hi[right])?);
        let (bottom, top) = (self.row(b.lo[up])?, self.row(b.hi[up])?);
        Some(Rect { x: left, y: top, width: end - left + 1, height: bottom - top + 1 })
    }

    fn draw(&self, followed: &FollowedRay, theme: &Theme, buffer: &mut Buffer) {
        let space = &followed.drawn_space;
        for b in &space.boxes {
            for place in self.rectangle(b).into_iter().flat_map(Rect::positions) {
                buffer[place].set_symbol("░");
            }
        }
        for cell in cells_entered(followed) {
            for place in self.rectangle(&cell).into_iter().flat_map(Rect::positions) {
                buffer[place].set_style(theme.chosen);
            }
        }
        let [right, up] = self.axes;
        let all = self.rectangle(&space.world).unwrap_or_default();
        let columns: Vec<u16> = space.planes[right].iter().filter_map(|&x| self.column(x)).collect();
        let rows: Vec<u16> = space.planes[up].iter().filter_map(|&y| self.row(y)).collect();
        for place in all.positions() {
            let symbol = match (columns.contains(&place.x), rows.contains(&place.y)) {
                (true, true) => "┼",
                (true, false) => "│",
                (false, true) => "─",
                (false, false) => continue,
            };
            buffer[place].set_symbol(symbol);
        }
        self.draw_ray(followed, theme, all, buffer);
    }

    /// Marks the ray from where it comes into the world to what it meets.
    fn draw_ray(&self, followed: &FollowedRay, theme: &Theme, all: Rect, buffer: &mut Buffer) {
        let (o, d, world) = (followed.ray.o, followed.ray.d, followed.drawn_space.world);
        let farthest = world.corners().into_iter().map(|corner| (corner - o).length()).fold(0.0, f64::max);
        let hit = eye_events(followed).iter().find_map(|event| match event {
            RayEvent::Hit { t, .. } => Some(t * followed.scene_frame.unit),
            _ => None,
        });
        let end = hit.unwrap_or(farthest);
        // A ray that goes across passes the world's diagonal, which is less than its three sides together.
        let columns = (world.hi - world.lo).element_sum() / self.step[0];
        let nearest = (o.clamp(world.lo, world.hi) - o).length();
        let points = (columns as u32).clamp(1, 1_000) * POINTS_PER_COLUMN;
        for point in 0..=points {
            let t = nearest + (end - nearest) * f64::from(point) / f64::from(points);
            let p: DVec3 = o + d * t;
            let [right, up] = self.axes.map(|axis| p[axis]);
            let is_inside = p.cmpge(world.lo).all() && p.cmple(world.hi).all();
            if let (true, Some(x), Some(y)) = (is_inside, self.column(right), self.row(up))
                && all.contains((x, y).into())
            {
                let ink = theme.mark.fg;
                let cell = &mut buffer[(x, y)];
                cell.set_symbol("•");
                if let Some(ink) = ink.filter(|_| theme.chosen.bg != Some(cell.bg)) {
                    cell.set_fg(ink);
                }
            }
        }
    }
}

/// What happens to the ray from the eye itself.
fn eye_events(followed: &FollowedRay) -> &[RayEvent] {
    let events = &followed.events;
    let is_other = |event: &RayEvent| matches!(event, RayEvent::Sent { kind, .. } if *kind != RayKind::Eye);
    &events[..events.iter().position(is_other).unwrap_or(events.len())]
}

/// The cells of the lattice that the ray from the eye enters.
fn cells_entered(followed: &FollowedRay) -> Vec<Bounds> {
    let planes = &followed.drawn_space.planes;
    let sides = [0, 1, 2].map(|axis| planes[axis].len().saturating_sub(1));
    if sides.contains(&0) {
        return Vec::new();
    }
    let bounds = |number: usize| {
        let place = [number % sides[0], number / sides[0] % sides[1], number / (sides[0] * sides[1])];
        let corner =
            |up: usize| DVec3::from([0, 1, 2].map(|axis| planes[axis][(place[axis] + up).min(sides[axis])]));
        Bounds::new(corner(0), corner(1))
    };
    let number = |event: &RayEvent| match event {
        RayEvent::Cell { number, .. } => *number,
        _ => None,
    };
    eye_events(followed).iter().filter_map(number).map(|number| bounds(number as usize)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::attributes::text_and_attributes;
    use crate::frame::{Request, Studio, pcat};
    use crate::glyph::Palette;
    use crate::scene::{ReadOptions, read};

    fn followed() -> FollowedRay {
        let text = include_bytes!("../../tests/files/follow.scene");
        let scene = read("follow.scene", text, &ReadOptions::default()).unwrap();
        let studio = Studio::new(scene).unwrap();
        let request: Request = pcat::request(studio.camera(0, 1.0));
        studio.follow(&request, [60, 100]).unwrap()
    }

    #[test]
    fn planes_boxes_and_the_cells_of_a_ray() {
        let followed = followed();
        assert!(!cells_entered(&followed).is_empty());
        for (width, height) in [(78, 10), (198, 26)] {
            let area = Rect::new(0, 0, width, height);
            let mut buffer = Buffer::empty(area);
            draw(&followed, &Theme::of(Palette::DOS), area, &mut buffer);
            insta::assert_snapshot!(format!("views_at_{width}_by_{height}"), text_and_attributes(&buffer));
        }
        for (width, height) in [(0, 0), (1, 1), (5, 3), (40, 2), (9, 90)] {
            let area = Rect::new(0, 0, width, height);
            draw(&followed, &Theme::of(Palette::MONO), area, &mut Buffer::empty(area));
        }
    }
}
