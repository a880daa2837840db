//! What menus and dialogs look like, and what they do.

use std::fs;

use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};

use super::*;
use crate::app::Settings;
use crate::app::attributes::text_and_attributes;
use crate::app::desk::{SaveFailure, SaveFormat};
use crate::app::theme::Theme;
use crate::app::window::Window;
use crate::frame::Studio;
use crate::glyph::{GlyphMode, Palette};
use crate::math::DVec3;
use crate::scene::{ReadOptions, read};

const SCENE: &[u8] = b"camera(\"front\", eye = [0, -9, 4], target = [0, 0, 0.5], field = [40, 25]);
    camera(\"side\", eye = [9, 0, 4], target = [0, 0, 0.5], field = [40, 25], zoom = 1.5); sphere(1);";

fn studio() -> Studio {
    Studio::new(read("a.scene", SCENE, &ReadOptions::default()).unwrap()).unwrap()
}

fn model(width: u16, height: u16) -> Model {
    let formats = [("txt", "Characters only"), ("png", "One pixel per dot")];
    let formats = formats.map(|(name, holds)| SaveFormat { name: name.to_owned(), holds: holds.to_owned() });
    let settings = Settings { title: "a.scene".to_owned(), formats: formats.to_vec(), ..Settings::default() };
    Model::new(&studio(), settings, Window { cells: Size::new(width, height), ..Window::default() })
}

/// Presses keys one after the other, and gives what the last asks of the world.
fn press(model: &mut Model, codes: &[KeyCode]) -> Effect {
    let studio = studio();
    let effects = codes.iter().map(|&code| model.key(&studio, code.into()));
    effects.last().unwrap_or(Effect::None)
}

fn typed(text: &str) -> Vec<KeyCode> {
    text.chars().map(KeyCode::Char).collect()
}

/// The rows that the open menu or dialog covers on a blank screen.
fn seen(model: &Model, palette: Palette) -> String {
    let screen = model.layout.screen;
    let mut buffer = Buffer::empty(screen);
    let places = model.desk.as_ref().unwrap().draw(&Theme::of(palette), screen, &mut buffer);
    let all = places.into_iter().reduce(Rect::union).unwrap();
    assert_eq!(all.intersection(screen), all);
    let mut part = Buffer::empty(all);
    for place in all.positions() {
        part[place] = buffer[place].clone();
    }
    text_and_attributes(&part)
}

/// The dialogs, each by its name and its key.
const DIALOGS: [(&str, u8); 4] = [("open", 2), ("view", 3), ("glyphs", 7), ("save", 8)];

#[test]
fn menus() {
    for (width, height) in [(80, 24), (80, 25), (200, 60), (20, 5)] {
        let mut model = model(width, height);
        press(&mut model, &[KeyCode::F(9)]);
        let mut all = String::new();
        for _ in 0..6 {
            all += &format!("{}\n", model.desk.as_ref().unwrap().hint());
            all += &seen(&model, Palette::DOS);
            press(&mut model, &[KeyCode::Right, KeyCode::Down]);
        }
        insta::assert_snapshot!(format!("menus_at_{width}_by_{height}"), all);
    }
}

/// What is seen without the name of the folder that is listed, which is another each time.
fn anywhere(seen: &str) -> String {
    let row = |row: &str| {
        let Some((head, tail)) = row.split_once("║ In   ") else { return row.to_owned() + "\n" };
        let (path, tail) = tail.split_once('║').expect("the border on the right");
        format!("{head}║ In   {:<width$}║{tail}\n", "(a folder)", width = path.chars().count())
    };
    seen.lines().map(row).collect()
}

#[test]
fn dialogs() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("parts")).unwrap();
    fs::write(folder.path().join("gear.scene"), "").unwrap();
    for (width, height) in [(80, 24), (80, 25), (200, 60), (20, 5)] {
        let mut all = String::new();
        for (name, key) in DIALOGS {
            let mut model = model(width, height);
            model.settings.folder = folder.path().to_owned();
            // The parent folder has a name of its own on every machine; the folder below has one too.
            press(&mut model, &[KeyCode::F(key), KeyCode::End]);
            let seen = anywhere(&seen(&model, Palette::DOS));
            all += &format!("{name}: {}\n{seen}", model.desk.as_ref().unwrap().hint());
        }
        let mut model = model(width, height);
        press(&mut model, &[KeyCode::F(3), KeyCode::BackTab, KeyCode::BackTab, KeyCode::Enter]);
        all += &format!("line: {}\n{}", model.desk.as_ref().unwrap().hint(), seen(&model, Palette::DOS));
        insta::assert_snapshot!(format!("dialogs_at_{width}_by_{height}"), all);
    }
}

#[test]
fn without_colours_hot_letters_are_bold_and_what_has_the_keys_is_reversed() {
    let mut model = model(80, 24);
    press(&mut model, &[KeyCode::F(7)]);
    insta::assert_snapshot!("the_glyph_dialog_without_colours", seen(&model, Palette::MONO));
    press(&mut model, &[KeyCode::Esc, KeyCode::F(9), KeyCode::Down]);
    insta::assert_snapshot!("the_file_menu_without_colours", seen(&model, Palette::MONO));
}

#[test]
fn no_screen_is_too_small_for_a_dialog() {
    for (width, height) in [(1, 1), (2, 2), (10, 3), (20, 5), (40, 10), (79, 24), (300, 90)] {
        for (_, key) in DIALOGS {
            let mut model = model(width, height);
            press(&mut model, &[KeyCode::F(key)]);
            for _ in 0..8 {
                assert!(seen(&model, Palette::DOS).len() > 2);
                press(&mut model, &[KeyCode::Tab]);
            }
        }
    }
}

#[test]
fn where_no_function_key_arrives_esc_and_a_digit_or_alt_is_one() {
    let alt = |c| KeyEvent::new(KeyCode::Char(c), KeyModifiers::ALT);
    let mut model = model(80, 24);
    press(&mut model, &[KeyCode::Esc, KeyCode::Char('3')]);
    assert!(matches!(model.desk, Some(Desk::View(_))));
    // An Esc that closes something begins no function key.
    let before = model.camera.clone();
    press(&mut model, &[KeyCode::Esc, KeyCode::Char('3')]);
    assert!(model.desk.is_none() && model.camera != before, "3 is the view from the right");
    model.key(&studio(), alt('7'));
    assert!(matches!(model.desk, Some(Desk::Glyphs(_))));
    press(&mut model, &[KeyCode::Esc]);
    model.key(&studio(), alt('v'));
    assert!(matches!(model.desk, Some(Desk::Menus(_))));
    press(&mut model, &[KeyCode::Esc]);
    assert_eq!(press(&mut model, &[KeyCode::Esc, KeyCode::Char('0')]), Effect::Quit);
}

#[test]
fn a_menu_does_what_its_key_does() {
    let mut by_menu = model(80, 24);
    press(&mut by_menu, &[KeyCode::F(9), KeyCode::Right, KeyCode::Char('t')]);
    let mut by_key = model(80, 24);
    press(&mut by_key, &[KeyCode::Char('7')]);
    assert_eq!((by_menu.view_name(), by_menu.request()), ("from the top".to_owned(), by_key.request()));
    assert_eq!(press(&mut by_menu, &[KeyCode::F(9), KeyCode::Char('q')]), Effect::Quit);
    let mut model = model(80, 24);
    press(&mut model, &[KeyCode::F(9), KeyCode::Char('o')]);
    assert!(matches!(model.desk, Some(Desk::Open(_))));
    // Ctrl-C ends the program whatever is open.
    let control_c = KeyEvent::new(KeyCode::Char('c'), KeyModifiers::CONTROL);
    assert_eq!(model.key(&studio(), control_c), Effect::Quit);
}

#[test]
fn numbers_that_are_typed_are_where_the_eye_goes() {
    let mut model = model(80, 24);
    let keys = [vec![KeyCode::F(3), KeyCode::Tab], typed("1, -2, x"), vec![KeyCode::Enter]].concat();
    press(&mut model, &keys);
    let Some(Desk::View(dialog)) = &model.desk else { panic!("a mistake keeps it open") };
    assert!(dialog.form.message.as_ref().unwrap().starts_with("eye: expected 3 numbers"));
    press(&mut model, &[&[KeyCode::Backspace], &typed("3")[..], &[KeyCode::Enter]].concat());
    assert_eq!((model.desk.is_none(), model.camera.eye), (true, DVec3::new(1.0, -2.0, 3.0)));
    press(&mut model, &[KeyCode::Backspace]);
    assert_eq!(model.camera.eye, DVec3::new(0.0, -9.0, 4.0), "back to the last view");
    // The second view of the list is the scene's own second.
    press(&mut model, &[KeyCode::F(3), KeyCode::Down, KeyCode::Down, KeyCode::Enter]);
    assert_eq!((model.camera.eye, model.camera.zoom), (DVec3::new(9.0, 0.0, 4.0), 1.5));
}

#[test]
fn a_view_is_written_as_a_line() {
    let mut model = model(80, 24);
    press(&mut model, &[KeyCode::F(3)]);
    let alt_w = KeyEvent::new(KeyCode::Char('w'), KeyModifiers::ALT);
    model.key(&studio(), alt_w);
    let keys = [typed("best"), vec![KeyCode::Tab], typed("b.scene"), vec![KeyCode::Enter]].concat();
    let line = "camera(\"best\", eye = [0, -9, 4], target = [0, 0, 0.5], field = [40, 25]);";
    assert_eq!(press(&mut model, &keys), Effect::Append("b.scene".into(), line.to_owned()));
}

#[test]
fn the_picture_is_in_the_characters_that_are_chosen_at_once() {
    let mut model = model(80, 24);
    let before = model.settings.glyphs;
    press(&mut model, &[KeyCode::F(7), KeyCode::End]);
    let chosen = model.settings.glyphs;
    assert_ne!(chosen, before);
    press(&mut model, &[KeyCode::Esc]);
    assert_eq!(model.settings.glyphs, before);
    press(&mut model, &[KeyCode::F(7), KeyCode::End, KeyCode::Enter]);
    assert_eq!((model.settings.glyphs, model.desk.is_none()), (chosen, true));
    assert!(GlyphMode::ALL.contains(&chosen));
}

#[test]
fn another_scene_is_seen_from_its_own_view() {
    let mut model = model(80, 24);
    press(&mut model, &[KeyCode::Char('7'), KeyCode::F(2)]);
    let keys = [vec![KeyCode::BackTab], typed("die"), vec![KeyCode::Enter]].concat();
    assert_eq!(press(&mut model, &keys), Effect::Open("die".to_owned()));
    assert!(model.desk.is_some(), "until it is read");
    let other = read("b.scene", b"camera(\"low\", eye = [5, 5, 1]); cube(1);", &ReadOptions::default());
    model.open(&Studio::new(other.unwrap()).unwrap(), "b.scene".to_owned(), "there".into());
    assert_eq!((model.view_name(), model.settings.title.as_str()), ("low".to_owned(), "b.scene"));
    assert!(model.desk.is_none() && model.history.is_empty() && model.settings.folder.ends_with("there"));
}

#[test]
fn what_is_not_saved_says_why() {
    let mut model = model(80, 24);
    press(&mut model, &[KeyCode::F(8)]);
    assert!(matches!(press(&mut model, &[KeyCode::Enter]), Effect::Save(order) if !order.replaces));
    let Some(Desk::Save(dialog)) = &mut model.desk else { panic!("until it is saved") };
    dialog.failed(SaveFailure::Exists);
    assert!(dialog.form.message.as_ref().unwrap().contains("a.txt is there already"));
    let keys = [KeyCode::Tab, KeyCode::Tab, KeyCode::Enter];
    assert!(matches!(press(&mut model, &keys), Effect::Save(order) if order.replaces));
}

#[test]
fn a_click_does_what_the_key_does() {
    let studio = studio();
    let mut model = model(80, 24);
    // The key bar, the menu bar, a row of a menu, and beside it.
    model.click(&studio, Position::new(50, 23));
    assert!(matches!(model.desk, Some(Desk::Glyphs(_))));
    press(&mut model, &[KeyCode::Esc]);
    model.click(&studio, Position::new(3, 0));
    assert!(matches!(model.desk, Some(Desk::Menus(_))));
    model.click(&studio, Position::new(70, 20));
    assert!(model.desk.is_none());
    model.click(&studio, Position::new(3, 0));
    model.click(&studio, Position::new(4, 2));
    assert!(matches!(model.desk, Some(Desk::Open(_))));
}
