//! Where the parts of a dialog stand, how they look, and what a click on them does.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Clear, Widget};

use super::form::{ChoiceList, DialogForm, FieldInput, FormEvent};
use super::hot;
use crate::app::theme::Theme;

/// Columns and rows by which a shadow stands beside what throws it; a cell is half as wide as it is high.
const SHADOW: [u16; 2] = [2, 1];

/// Rows of a list where there is room for them.
const LIST_ROWS: u16 = 12;

/// Rows that a list has at least before the form is scrolled instead.
const LEAST_LIST_ROWS: u16 = 3;

/// A message has at most so many rows.
const MESSAGE_ROWS: usize = 4;

/// Where the parts of a form stand.
struct FormPlan {
    /// All of it, with its frame.
    place: Rect,
    /// Each field and each button, as far as it is in sight.
    items: Vec<Rect>,
    /// The message.
    message: Rect,
    /// Its rows.
    message_rows: Vec<String>,
}

impl DialogForm {
    /// Draws it in the middle of an area, and gives its place with the shadow. What there is no room for is
    /// scrolled to where the keys go.
    pub fn draw(&self, theme: &Theme, area: Rect, buffer: &mut Buffer) -> Rect {
        let FormPlan { place, items, message, message_rows, .. } = self.plan(area);
        let all = draw_shadow(theme, place, buffer);
        Clear.render(place, buffer);
        let sheet = theme.dialog;
        Block::bordered()
            .border_type(BorderType::Double)
            .title(Line::from(Span::raw(format!(" {} ", self.title))).centered())
            .style(sheet.text)
            .render(place, buffer);
        let labels = self.label_columns();
        for (number, (field, item)) in self.fields.iter().zip(&items).enumerate() {
            if item.is_empty() {
                continue;
            }
            let has_keys = number == self.focus;
            let label = hot::line(field.label, sheet.text, sheet.hot);
            label.render(Rect { height: 1, ..*item }, buffer);
            match &field.input {
                FieldInput::Line(line) => {
                    line.draw(has_keys, theme.entry, beside(*item, labels), buffer);
                }
                FieldInput::Told(text) => {
                    let room = beside(Rect { height: 1, ..*item }, labels);
                    for (row, y) in
                        cut(text, usize::from(room.width).max(1)).into_iter().zip(item.top()..item.bottom())
                    {
                        Line::from(row).render(Rect { y, ..room }, buffer);
                    }
                }
                FieldInput::List(list) => draw_list(list, has_keys, theme, below_label(*item), buffer),
            }
        }
        for (row, y) in message_rows.iter().zip(message.top()..message.bottom()) {
            Line::styled(row.as_str(), sheet.hot).render(Rect { y, height: 1, ..message }, buffer);
        }
        for (number, (label, item)) in self.buttons.iter().zip(&items[self.fields.len()..]).enumerate() {
            if item.is_empty() {
                continue;
            }
            let has_keys = self.fields.len() + number == self.focus;
            let style = theme.button;
            let [text, letter] =
                if has_keys { [style.chosen, style.chosen_hot] } else { [style.text, style.hot] };
            buffer.set_style(*item, text);
            hot::line(label, text, letter).centered().render(*item, buffer);
        }
        all
    }

    /// Does what a click at a place asks for, on a form that is drawn in `area`; one beside it does nothing.
    pub fn click(&mut self, at: Position, area: Rect) -> FormEvent {
        let plan = self.plan(area);
        let Some(item) = plan.items.iter().position(|item| item.contains(at)) else {
            return FormEvent::Nothing;
        };
        self.focus = item;
        let Some(field) = self.fields.get(item) else { return FormEvent::Pressed(item - self.fields.len()) };
        let FieldInput::List(list) = &field.input else { return FormEvent::Nothing };
        let rows = below_label(plan.items[item]);
        if !rows.contains(at) {
            return FormEvent::Nothing;
        }
        let row = first_row(list, rows.height) + usize::from(at.y - rows.y);
        if row == list.chosen { FormEvent::Entered(item) } else { self.choose(item, row) }
    }

    /// Columns of the labels of lines, with a blank.
    fn label_columns(&self) -> u16 {
        let beside = self.fields.iter().filter(|field| !matches!(field.input, FieldInput::List(_)));
        beside.map(|field| hot::width(field.label) + 1).max().unwrap_or(0)
    }

    fn plan(&self, area: Rect) -> FormPlan {
        let width = self.width.min(area.width);
        let text_width = usize::from(width.saturating_sub(4)).max(1);
        let mut message_rows: Vec<String> = self
            .message
            .iter()
            .flat_map(|text| text.lines())
            .flat_map(|line| cut(line, text_width))
            .collect();
        message_rows.truncate(MESSAGE_ROWS);
        let lists =
            self.fields.iter().filter(|field| matches!(field.input, FieldInput::List(_))).count() as u16;
        let others = self.fields.len() as u16 + message_rows.len() as u16 + 1;
        // Borders, what is not rows of lists, and a blank row above the buttons where there is one to spare.
        let room = area.height.saturating_sub(others + 2);
        let each = room.checked_div(lists).unwrap_or(0).clamp(LEAST_LIST_ROWS, LIST_ROWS);
        let height_of = |input: &FieldInput| match input {
            FieldInput::List(list) => 1 + each.min(u16::try_from(list.rows.len().max(1)).unwrap_or(u16::MAX)),
            FieldInput::Line(_) => 1,
            FieldInput::Told(text) => {
                let room = text_width.saturating_sub(self.label_columns().into()).max(1);
                cut(text, room).len().min(MESSAGE_ROWS) as u16
            }
        };
        let fields: Vec<u16> = self.fields.iter().map(|field| height_of(&field.input)).collect();
        let used = fields.iter().sum::<u16>() + message_rows.len() as u16 + 1;
        let gap = u16::from(used + 2 < area.height);
        let height = (used + gap + 2).min(area.height);
        let place = Rect {
            x: area.x + (area.width - width) / 2,
            y: area.y + (area.height - height) / 2,
            width,
            height,
        };
        let inside = Rect {
            x: place.x + 2.min(width),
            y: place.y + 1.min(height),
            width: width.saturating_sub(4),
            height: height.saturating_sub(2),
        };
        let buttons_row = used + gap - 1;
        // From the first row that is in sight on, so that what has the keys is.
        let (top, bottom) = match fields.get(self.focus) {
            Some(rows) => {
                let top = fields[..self.focus].iter().sum::<u16>();
                (top, top + rows)
            }
            None => (buttons_row, buttons_row + 1),
        };
        let first = bottom.saturating_sub(inside.height).min(top);
        let at = |row: u16, rows: u16| {
            let from = row.max(first);
            let to = (row + rows).min(first + inside.height);
            let height = to.saturating_sub(from);
            Rect { y: inside.y + from.saturating_sub(first).min(inside.height), height, ..inside }
        };
        let mut row = 0;
        let mut items = Vec::with_capacity(fields.len() + self.buttons.len());
        for rows in &fields {
            items.push(at(row, *rows));
            row += rows;
        }
        let message = at(row, message_rows.len() as u16);
        items.extend(button_places(&self.buttons, at(buttons_row, 1)));
        FormPlan { place, items, message, message_rows }
    }
}

/// The buttons in the middle of a row, with two blanks on either side of each name.
fn button_places(labels: &[&str], row: Rect) -> Vec<Rect> {
    let widths: Vec<u16> = labels.iter().map(|label| hot::width(label) + 4).collect();
    let all = widths.iter().sum::<u16>() + 2 * widths.len().saturating_sub(1) as u16;
    let mut x = row.x + row.width.saturating_sub(all) / 2;
    let places = widths.into_iter().map(|width| {
        let place = Rect { x, width, ..row }.intersection(row);
        x = (x + width + 2).min(row.right());
        place
    });
    places.collect()
}

/// Darkens what lies in the shadow of a place, and gives both.
pub fn draw_shadow(theme: &Theme, place: Rect, buffer: &mut Buffer) -> Rect {
    let shadow = Rect { x: place.x + SHADOW[0], y: place.y + SHADOW[1], ..place }.intersection(buffer.area);
    if shadow.is_empty() {
        return place.intersection(buffer.area);
    }
    buffer.set_style(shadow, theme.shadow);
    place.union(shadow)
}

/// The rest of a row behind a label.
fn beside(item: Rect, columns: u16) -> Rect {
    let columns = columns.min(item.width);
    Rect { x: item.x + columns, width: item.width - columns, height: item.height.min(1), ..item }
}

/// The rows of a list, below its label.
fn below_label(item: Rect) -> Rect {
    let label = 1.min(item.height);
    Rect { y: item.y + label, height: item.height - label, ..item }
}

/// The first row of a list that is in sight: the one chosen stands in the middle, as far as there are more.
fn first_row(list: &ChoiceList, rows: u16) -> usize {
    let room = usize::from(rows);
    list.chosen.saturating_sub(room / 2).min(list.rows.len().saturating_sub(room))
}

fn draw_list(list: &ChoiceList, has_keys: bool, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    buffer.set_style(area, theme.entry);
    let first = first_row(list, area.height);
    for (number, y) in (first..list.rows.len()).zip(area.top()..area.bottom()) {
        let style = match (number == list.chosen, has_keys) {
            (true, true) => theme.dialog.chosen,
            (true, false) => theme.entry_chosen,
            (false, _) => theme.entry,
        };
        let row = Rect { y, height: 1, ..area };
        buffer.set_style(row, style);
        // Names of files come from outside.
        let text: String = list.rows[number].chars().filter(|c| !c.is_control()).collect();
        Line::styled(format!(" {text}"), style).render(row, buffer);
    }
    // What there is above and below has its mark in the last column.
    let marks = [
        (first > 0, area.top(), "↑"),
        (first + usize::from(area.height) < list.rows.len(), area.bottom().saturating_sub(1), "↓"),
    ];
    for (_, y, mark) in marks.into_iter().filter(|(more, ..)| *more && !area.is_empty()) {
        buffer[(area.right() - 1, y)].set_symbol(mark);
    }
}

/// A line in pieces of so many columns, parted between words where that goes.
fn cut(line: &str, width: usize) -> Vec<String> {
    let mut rows = vec![String::new()];
    for word in line.split(' ') {
        let letters: Vec<char> = word.chars().filter(|c| !c.is_control()).collect();
        for piece in letters.chunks(width) {
            let piece: String = piece.iter().collect();
            let last = rows
                .last_mut()
                .filter(|row| row.is_empty() || row.chars().count() + 1 + piece.chars().count() <= width);
            match last {
                Some(row) if row.is_empty() => row.push_str(&piece),
                Some(row) => {
                    row.push(' ');
                    row.push_str(&piece);
                }
                None => rows.push(piece),
            }
        }
    }
    rows
}
