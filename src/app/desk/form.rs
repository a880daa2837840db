//! What a dialog asks for: lines, lists and buttons, one below the other, and where the keys go.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::hot;
use super::input_line::InputLine;

/// A page key moves a list by so many rows, about what is seen of it on 80 × 25.
const PAGE: usize = 8;

/// What a dialog asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DialogForm {
    /// What stands in its frame.
    pub title: &'static str,
    /// From the top.
    pub fields: Vec<FormField>,
    /// From the left, below the fields; the last goes back.
    pub buttons: Vec<&'static str>,
    /// What is wrong, or goes on, above the buttons.
    pub message: Option<String>,
    /// Columns that it likes to have, borders included.
    pub width: u16,
    /// Where the keys go: a field by its number, then a button.
    pub focus: usize,
    /// The line that letters are typed into while the keys go to a list; without one they are hot letters.
    pub typed_into: Option<usize>,
}

/// A field and what is said of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormField {
    /// Its name, with a hot letter.
    pub label: &'static str,
    /// What it is for, in a sentence.
    pub hint: &'static str,
    /// What is in it.
    pub input: FieldInput,
}

/// What a field takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FieldInput {
    /// A line that is typed into.
    Line(InputLine),
    /// One of several.
    List(ChoiceList),
    /// Nothing: it tells.
    Told(String),
}

/// Rows of which one is chosen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ChoiceList {
    /// All of them.
    pub rows: Vec<String>,
    /// The one.
    pub chosen: usize,
}

/// Where the keys go next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// To the next.
    On,
    /// To the one before.
    Back,
}

/// What a key did to a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormEvent {
    /// Nothing that changes what is asked for.
    Nothing,
    /// It was left.
    Cancelled,
    /// Another text, or another row, is in this field.
    Changed(usize),
    /// What is in this field is meant.
    Entered(usize),
    /// This button was pressed.
    Pressed(usize),
}

impl FormField {
    /// A line with a text that the first letter typed replaces.
    pub fn line(label: &'static str, hint: &'static str, text: &str) -> Self {
        Self { label, hint, input: FieldInput::Line(InputLine::new(text)) }
    }

    /// A list.
    pub fn list(label: &'static str, hint: &'static str, rows: Vec<String>, chosen: usize) -> Self {
        Self { label, hint, input: FieldInput::List(ChoiceList { rows, chosen }) }
    }

    /// A text that nobody types.
    pub fn told(label: &'static str, text: String) -> Self {
        Self { label, hint: "", input: FieldInput::Told(text) }
    }
}

impl DialogForm {
    /// A form whose keys go to its first field.
    pub fn new(title: &'static str, fields: Vec<FormField>, buttons: Vec<&'static str>) -> Self {
        Self { title, fields, buttons, message: None, width: 64, focus: 0, typed_into: None }
    }

    /// The text of a field; that of the row chosen where it is a list.
    pub fn text(&self, field: usize) -> String {
        match self.fields.get(field).map(|field| &field.input) {
            Some(FieldInput::Line(line)) => line.text(),
            Some(FieldInput::List(list)) => list.rows.get(list.chosen).cloned().unwrap_or_default(),
            Some(FieldInput::Told(text)) => text.clone(),
            None => String::new(),
        }
    }

    /// The row of a list that is chosen.
    pub fn chosen(&self, field: usize) -> usize {
        match self.fields.get(field).map(|field| &field.input) {
            Some(FieldInput::List(list)) => list.chosen,
            _ => 0,
        }
    }

    /// Puts something else into a field.
    pub fn set(&mut self, field: usize, input: FieldInput) {
        if let Some(field) = self.fields.get_mut(field) {
            field.input = input;
        }
    }

    /// Puts another text into a line.
    pub fn set_line(&mut self, field: usize, text: &str) {
        self.set(field, FieldInput::Line(InputLine::new(text)));
    }

    /// What is told of that where the keys go.
    pub fn hint(&self) -> &str {
        match self.fields.get(self.focus) {
            Some(field) => field.hint,
            None if self.focus + 1 == self.fields.len() + self.buttons.len() => "Goes back to the picture",
            None => "Tab goes on to the next; Enter does it, Esc goes back",
        }
    }

    /// Does what a key asks for.
    pub fn take(&mut self, key: KeyEvent) -> FormEvent {
        if let (KeyCode::Char(c), true) = (key.code, key.modifiers.contains(KeyModifiers::ALT)) {
            return self.hot_letter(c);
        }
        let focus = self.focus;
        match key.code {
            KeyCode::Esc | KeyCode::F(10) => return FormEvent::Cancelled,
            KeyCode::Tab => self.go(Way::On),
            KeyCode::BackTab => self.go(Way::Back),
            KeyCode::Enter if focus < self.fields.len() => return FormEvent::Entered(focus),
            KeyCode::Enter => return FormEvent::Pressed(focus - self.fields.len()),
            code => return self.take_inside(code, key),
        }
        FormEvent::Nothing
    }

    fn take_inside(&mut self, code: KeyCode, key: KeyEvent) -> FormEvent {
        let focus = self.focus;
        match self.fields.get_mut(focus).map(|field| &mut field.input) {
            Some(FieldInput::Line(line)) => {
                if line.take(key) {
                    return FormEvent::Changed(focus);
                }
            }
            Some(FieldInput::List(_)) if matches!(code, KeyCode::Char(_)) && self.typed_into.is_some() => {
                self.focus = self.typed_into.unwrap_or(focus);
                self.refresh();
                return self.take_inside(code, key);
            }
            Some(FieldInput::List(list)) => {
                let last = list.rows.len().saturating_sub(1);
                let next = match code {
                    KeyCode::Up => list.chosen.saturating_sub(1),
                    KeyCode::Down => list.chosen + 1,
                    KeyCode::PageUp => list.chosen.saturating_sub(PAGE),
                    KeyCode::PageDown => list.chosen + PAGE,
                    KeyCode::Home => 0,
                    KeyCode::End => last,
                    KeyCode::Char(c) => return self.hot_letter(c),
                    _ => return FormEvent::Nothing,
                };
                return self.choose(focus, next);
            }
            Some(FieldInput::Told(_)) | None => match code {
                KeyCode::Char(' ') if focus >= self.fields.len() => {
                    return FormEvent::Pressed(focus - self.fields.len());
                }
                KeyCode::Char(c) => return self.hot_letter(c),
                KeyCode::Left => self.go(Way::Back),
                KeyCode::Right => self.go(Way::On),
                _ => {}
            },
        }
        match code {
            KeyCode::Up => self.go(Way::Back),
            KeyCode::Down => self.go(Way::On),
            _ => {}
        }
        FormEvent::Nothing
    }

    /// Chooses a row of a list, the last where there are fewer.
    pub fn choose(&mut self, field: usize, row: usize) -> FormEvent {
        let Some(FieldInput::List(list)) = self.fields.get_mut(field).map(|field| &mut field.input) else {
            return FormEvent::Nothing;
        };
        let row = row.min(list.rows.len().saturating_sub(1));
        if std::mem::replace(&mut list.chosen, row) == row {
            return FormEvent::Nothing;
        }
        FormEvent::Changed(field)
    }

    /// Goes to the field of a hot letter, or presses its button.
    fn hot_letter(&mut self, c: char) -> FormEvent {
        let c = c.to_ascii_lowercase();
        let labels = self.fields.iter().map(|field| field.label).chain(self.buttons.iter().copied());
        let Some(found) = labels.into_iter().position(|label| hot::letter(label) == Some(c)) else {
            return FormEvent::Nothing;
        };
        self.focus = found;
        self.refresh();
        match found.checked_sub(self.fields.len()) {
            Some(button) => FormEvent::Pressed(button),
            None => FormEvent::Nothing,
        }
    }

    /// Takes the keys to the next, or the one before, past those that only tell.
    fn go(&mut self, way: Way) {
        let all = self.fields.len() + self.buttons.len();
        for _ in 0..all {
            self.focus = match way {
                Way::On => (self.focus + 1) % all,
                Way::Back => (self.focus + all - 1) % all,
            };
            let told = self.fields.get(self.focus).map(|field| &field.input);
            if !matches!(told, Some(FieldInput::Told(_))) {
                break;
            }
        }
        self.refresh();
    }

    /// The first letter typed into a line that the keys have come to replaces what is there.
    fn refresh(&mut self) {
        if let Some(FieldInput::Line(line)) = self.fields.get_mut(self.focus).map(|field| &mut field.input) {
            line.refresh();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form() -> DialogForm {
        let rows = ["a", "b", "c"].map(str::to_owned).to_vec();
        let fields = vec![
            FormField::line("&Name", "a name", "x"),
            FormField::told("Told", "that".to_owned()),
            FormField::list("&Row", "a row", rows, 0),
        ];
        DialogForm::new("TEST", fields, vec!["&OK", "Cancel"])
    }

    fn press(form: &mut DialogForm, codes: &[KeyCode]) -> Vec<FormEvent> {
        codes.iter().map(|&code| form.take(code.into())).collect()
    }

    #[test]
    fn tab_goes_round_and_past_what_only_tells() {
        let mut form = form();
        let mut seen = Vec::new();
        for _ in 0..4 {
            seen.push(form.focus);
            press(&mut form, &[KeyCode::Tab]);
        }
        assert_eq!((seen, form.focus), (vec![0, 2, 3, 4], 0));
        press(&mut form, &[KeyCode::BackTab, KeyCode::BackTab]);
        assert_eq!(form.focus, 3);
    }

    #[test]
    fn each_key_does_what_it_does_where_the_keys_go() {
        use FormEvent::{Cancelled, Changed, Entered, Nothing, Pressed};
        let mut form = form();
        assert_eq!(press(&mut form, &[KeyCode::Char('o'), KeyCode::Enter]), [Changed(0), Entered(0)]);
        assert_eq!(form.text(0), "o");
        let keys = [KeyCode::Down, KeyCode::Down, KeyCode::End, KeyCode::Down, KeyCode::Enter];
        assert_eq!(press(&mut form, &keys), [Nothing, Changed(2), Changed(2), Nothing, Entered(2)]);
        assert_eq!(form.text(2), "c");
        let keys = [KeyCode::Char('o'), KeyCode::Right, KeyCode::Enter, KeyCode::Esc];
        assert_eq!(press(&mut form, &keys), [Pressed(0), Nothing, Pressed(1), Cancelled]);
        let with_alt = KeyEvent::new(KeyCode::Char('r'), KeyModifiers::ALT);
        assert_eq!((form.take(with_alt), form.focus), (Nothing, 2));
    }
}
