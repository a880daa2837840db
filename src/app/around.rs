//! What stands around the picture: frame, titles, function keys. It is the same before the scene is there and
//! after.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Clear, Widget};

use super::keys;
use super::layout::{Around, Panels, Rows};
use super::theme::Theme;
use crate::stage::WorkStep;

/// Columns of the least part of a note that tells anything: its line, and the word that it is about.
const LEAST_NOTE: u16 = 24;

/// What the frame says.
#[derive(Clone, Debug, Default)]
pub struct Labels<'a> {
    /// The name of the scene.
    pub title: &'a str,
    /// What the view is called; absent before there is one.
    pub view: Option<String>,
    /// What is shown otherwise than asked for.
    pub note: Option<String>,
    /// How far a picture is that is drawn dot by dot.
    pub drawing: Option<String>,
    /// What is at work, where that takes long enough to be said.
    pub working: Option<WorkStep>,
}

/// How far a piece of work is, in words.
pub fn words(step: WorkStep) -> String {
    let name = step.task.name();
    step.percent.map_or_else(|| name.to_owned(), |percent| format!("{name} {percent} %"))
}

/// Draws it. What is inside the panels, and the line of figures, is left alone.
pub fn draw(around: &Around, labels: &Labels, theme: &Theme, buffer: &mut Buffer) {
    match around {
        Around::Nothing => {}
        Around::Rows(rows) => draw_rows(rows, labels, theme, buffer),
        Around::Panels(panels) => draw_panels(panels, labels, theme, buffer),
    }
}

fn draw_panels(panels: &Panels, labels: &Labels, theme: &Theme, buffer: &mut Buffer) {
    let title = format!(" {} ═", labels.title.to_uppercase());
    Block::bordered()
        .border_type(BorderType::Double)
        .style(theme.text)
        .title(Line::from(vec![Span::raw("═"), Span::styled(" RAY13 ", theme.bright)]))
        .title(Line::from(title).right_aligned())
        .render(panels.outer, buffer);
    let chart = Block::bordered().style(theme.text).title(Span::styled(" FLOW CHART ", theme.bright));
    chart.render(panels.chart, buffer);

    let mut picture = Block::bordered().style(theme.text).title(Span::styled(" PICTURE ", theme.bright));
    if let Some(view) = &labels.view {
        picture = picture.title(Line::from(format!(" view: {view} ")).right_aligned());
    }
    if let Some(note) = &labels.note {
        picture = picture.title_bottom(format!(" {note} "));
    }
    if let Some(step) = labels.working {
        picture = picture.title_bottom(Line::from(format!(" {} ", words(step))).right_aligned());
    } else if let Some(drawing) = &labels.drawing {
        picture = picture.title_bottom(Line::from(format!(" {drawing} ")).right_aligned());
    }
    picture.render(panels.picture, buffer);
    draw_bar(panels.bar, theme, buffer);
}

/// The rows alone.
fn draw_rows(rows: &Rows, labels: &Labels, theme: &Theme, buffer: &mut Buffer) {
    let program = " RAY13 ";
    buffer.set_string(rows.title.x, rows.title.y, "═".repeat(rows.title.width.into()), theme.text);
    buffer.set_string(rows.title.x + 1, rows.title.y, program, theme.bright);
    let view = labels.view.as_ref().map(|view| format!(" view: {view} ═"));
    let name = format!(" {} ═", labels.title.to_uppercase());
    let whole = name.clone() + view.as_deref().unwrap_or_default();
    // Between the two names there is a piece of the line; the program's own stays whole.
    let room = rows.title.width.saturating_sub(program.len() as u16 + 2);
    let fits = |text: &String| Line::from(text.as_str()).width() <= room.into();
    let text =
        [whole, name].into_iter().find(fits).unwrap_or_else(|| format!(" {}", labels.title.to_uppercase()));
    let columns = (Line::from(text.as_str()).width() as u16).min(room);
    let place = Rect { x: rows.title.right() - columns, width: columns, ..rows.title };
    Line::from(text).style(theme.text).render(place, buffer);

    draw_bar(rows.bar, theme, buffer);
    // What is at work, or shown otherwise than asked for, stands between the two names.
    let free = place.x.saturating_sub(rows.title.x + program.len() as u16 + 3);
    if let Some(text) =
        labels.working.map(words).or_else(|| labels.drawing.clone()).or_else(|| labels.note.clone())
    {
        let text = format!(" {text} ");
        let whole = Line::from(text.as_str()).width() as u16;
        if whole <= free || free >= LEAST_NOTE {
            let x = rows.title.x + program.len() as u16 + 2;
            let place = Rect { x, width: whole.min(free), ..rows.title };
            Line::from(text).style(theme.dim).render(place, buffer);
        }
    }
}

/// Help, menus and the end stay where there is no room for all.
const LAST_TO_GO: [u8; 3] = [1, 9, 10];

/// Columns of the ten slots of a key bar as Norton had it, on 80 columns.
const SLOTS: u16 = 80;

/// Draws the function keys: in ten slots of one width where there is room for these, else as many as fit,
/// each whole.
fn draw_bar(area: Rect, theme: &Theme, buffer: &mut Buffer) {
    buffer.set_style(area, theme.key_number);
    for Slot { number, label, place } in slots(area) {
        let number = number.to_string();
        let columns = (number.len() as u16).min(place.width);
        buffer.set_stringn(place.x, place.y, number, columns.into(), theme.key_number);
        let label_place = Rect { x: place.x + columns, width: place.width - columns, ..place };
        buffer.set_style(label_place, theme.key_label);
        buffer.set_stringn(label_place.x, place.y, label, label_place.width.into(), theme.key_label);
    }
}

/// A function key in the bar.
struct Slot {
    number: u8,
    label: &'static str,
    place: Rect,
}

/// The function keys in a bar, from the left; a blank parts them.
fn slots(bar: Rect) -> Vec<Slot> {
    let is_wide = bar.width >= SLOTS;
    let mut x = bar.x;
    let slot = |(number, label): (u8, &'static str)| {
        let digits = number.to_string().len() as u16;
        // The last one's second digit takes the blank.
        let width =
            if is_wide { bar.width / 10 - u16::from(digits == 1) } else { digits + label.len() as u16 };
        if is_wide {
            x = bar.x + bar.width / 10 * u16::from(number - 1);
        }
        let place = Rect { x, width, ..bar }.intersection(bar);
        x = (x + width + 1).min(bar.right());
        Slot { number, label, place }
    };
    keys_that_fit(bar.width).into_iter().map(slot).collect()
}

/// The function key whose label stands at a place of the screen.
pub fn function_key_at(around: &Around, at: Position) -> Option<u8> {
    let bar = match around {
        Around::Nothing => return None,
        Around::Rows(rows) => rows.bar,
        Around::Panels(panels) => panels.bar,
    };
    slots(bar).into_iter().find(|slot| slot.place.contains(at)).map(|slot| slot.number)
}

/// Says something in the line of figures, or in that of the keys where there is no other; gives its place.
pub fn draw_hint(around: &Around, text: &str, theme: &Theme, buffer: &mut Buffer) -> Rect {
    let (place, style) = match around {
        Around::Nothing => return Rect::ZERO,
        Around::Rows(rows) => (rows.bar, theme.key_number),
        Around::Panels(panels) => (panels.status, theme.text),
    };
    Clear.render(place, buffer);
    buffer.set_style(place, style);
    let text: String = text.chars().filter(|c| !c.is_control()).collect();
    Line::styled(format!(" {text}"), style).render(place, buffer);
    place
}

/// All keys where they fit; else the first, which is Help, the last, which is Quit, the menus, and of the
/// others as many as fit, counted from the last.
fn keys_that_fit(columns: u16) -> Vec<(u8, &'static str)> {
    let all = keys::function_keys();
    let width = |keys: &[(u8, &str)]| {
        keys.iter().map(|(number, label)| number.to_string().len() + label.len() + 1).sum::<usize>()
    };
    // The blank behind the last needs no room.
    let fits = |keys: &[(u8, &str)]| width(keys) <= usize::from(columns) + 1;
    let (mut keys, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|(n, _)| LAST_TO_GO.contains(n));
    for other in others.into_iter().rev() {
        let with = [&keys[..], &[other]].concat();
        if fits(&with) {
            keys = with;
        }
    }
    while keys.len() > 2 && !fits(&keys) {
        keys.remove(1);
    }
    keys.sort_unstable();
    keys
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_go_from_the_left_but_help_and_quit_stay() {
        let labels = |columns| keys_that_fit(columns).into_iter().map(|(_, label)| label).collect::<Vec<_>>();
        assert_eq!(labels(80).len(), 10);
        assert_eq!(labels(66), labels(80));
        assert_eq!(labels(46), ["Help", "Turbo", "Trade", "Glyphs", "Save", "Menu", "Quit"]);
        assert_eq!(labels(20), ["Help", "Menu", "Quit"]);
        assert_eq!(labels(1), ["Help", "Quit"]);
    }
}
