//! Measures how near each glyph mode comes to the picture it shows, and prints the table of
//! `docs/13-grays.md`: `cargo run --release --example grays`; with `terminals` behind `--` only that of the
//! levels on known terminals.

mod drawn;
mod measure;
mod terminals;

use std::io::{self, Write};
use std::rc::Rc;
use std::sync::Arc;

use measure::{Picture, errors, times};
use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{ColorDepth, GlyphMode, Palette, compose};
use ray13::math::{Grid, Size};
use ray13::output;
use ray13::plan::Options;
use ray13::scene::{ReadOptions, embedded, read};
use ray13::tone::Tone;

/// The screen that is measured, in cells: square, as cells are twice as high as wide.
const SCREEN: Size = Size::new(80, 40);
/// The screen of the pictures that are printed.
const SMALL: Size = Size::new(48, 16);

/// One row of the table: the characters, and along each axis of a dot how many rays.
struct Row {
    mode: GlyphMode,
    palette: Palette,
    rays: u32,
}

/// `shade` in four grays, or in ink alone, stands before the rows that are compared with it.
const ROWS: [Row; 20] = {
    use GlyphMode::{Blocks, Braille, Cp437, Half, Quadrant, Shade};
    const DOS: Palette = Palette::DOS;
    const MONO: Palette = Palette::MONO;
    const GRAY: Palette = Palette::Gray(ColorDepth::Direct);
    const GRAY_256: Palette = Palette::Gray(ColorDepth::Indexed);
    const fn row(mode: GlyphMode, palette: Palette, rays: u32) -> Row {
        Row { mode, palette, rays }
    }
    [
        row(Shade, DOS, 1),
        row(Blocks, DOS, 1),
        row(Cp437, DOS, 1),
        row(Quadrant, DOS, 1),
        row(Half, DOS, 1),
        row(Shade, GRAY, 1),
        row(Blocks, GRAY, 1),
        row(Blocks, GRAY_256, 1),
        row(Cp437, GRAY, 1),
        row(Quadrant, GRAY, 1),
        row(Half, GRAY, 1),
        row(Shade, DOS, 4),
        row(Blocks, DOS, 4),
        row(Cp437, DOS, 4),
        row(Shade, GRAY, 4),
        row(Blocks, GRAY, 4),
        row(Shade, MONO, 1),
        row(Blocks, MONO, 1),
        row(Quadrant, MONO, 1),
        row(Braille, MONO, 1),
    ]
};

/// Pictures that share a column of the table.
struct Column {
    name: String,
    pictures: Vec<Picture>,
}

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    terminals::table(&mut out)?;
    if std::env::args().nth(1).is_some_and(|only| only == "terminals") {
        return Ok(());
    }
    writeln!(out)?;
    table(&mut out)?;
    small_pictures(&mut out)
}

fn table(out: &mut impl Write) -> io::Result<()> {
    let columns = columns();
    let references: Vec<Vec<[Grid<f64>; 2]>> = columns
        .iter()
        .map(|column| column.pictures.iter().map(|picture| picture.reference(SCREEN)).collect())
        .collect();
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    writeln!(
        out,
        "| glyphs | palette | rays per dot | {} | scenes | better than shade |",
        names.join(" | ")
    )?;
    writeln!(out, "|---|---|---|{}---|---|", "---|".repeat(names.len()))?;
    let mut shade = Vec::new();
    for Row { mode, palette, rays } in ROWS {
        let found: Vec<Vec<[f64; 2]>> = columns
            .iter()
            .zip(&references)
            .map(|(column, references)| {
                let shown = column.pictures.iter().zip(references);
                shown
                    .map(|(picture, reference)| {
                        let light = picture.dots(times(SCREEN, mode.dots_per_cell()), rays);
                        errors(reference, &compose(&light, mode, palette, Tone::default()), palette)
                    })
                    .collect()
            })
            .collect();
        let depth = if palette == Palette::Gray(ColorDepth::Indexed) { ", 256" } else { "" };
        write!(out, "| `{}` | {}{depth} | {} |", mode.name(), palette.name(), rays * rays)?;
        for column in &found {
            let [near, far] = [0, 1].map(|eye| mean(column.iter().map(|picture| picture[eye])));
            write!(out, " {near:.2} / {far:.2} |")?;
        }
        let scenes = &found[..found.len() - 1];
        write!(out, " {:.2} |", mean(scenes.iter().map(|views| mean(views.concat().into_iter()))))?;
        if mode == GlyphMode::Shade && matches!(palette, Palette::Dos(_) | Palette::Mono(_)) {
            writeln!(out, " |")?;
            shade = found;
            continue;
        }
        let gain = |(found, shade): (&[f64; 2], &[f64; 2])| {
            100.0 * mean(found.iter().zip(shade).map(|(found, shade)| 1.0 - found / shade))
        };
        let by_scene: Vec<Vec<f64>> = scenes
            .iter()
            .zip(&shade)
            .map(|(found, shade)| found.iter().zip(shade).map(gain).collect())
            .collect();
        let least = by_scene.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        let all = mean(by_scene.iter().map(|views| mean(views.iter().copied())));
        writeln!(out, " {all:.0} %, at least {least:.0} % |")?;
    }
    Ok(())
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len();
    values.sum::<f64>() / count as f64
}

/// A scene, small, as plain text.
fn small_pictures(out: &mut impl Write) -> io::Result<()> {
    let (_, studio) = &studios()[1];
    for mode in GlyphMode::ALL {
        let frame = studio.draw(&request(studio, 0, SMALL, times(SMALL, mode.dots_per_cell()), mode));
        writeln!(out, "\n{}:", mode.name())?;
        output::text(&frame.cells.expect("they were asked for"), out)?;
    }
    Ok(())
}

/// A column for each embedded scene, of all its views, and one for the drawn pictures.
fn columns() -> Vec<Column> {
    let mut columns: Vec<Column> = studios()
        .into_iter()
        .map(|(name, studio)| {
            let views = 0..studio.scene().views.len().max(1);
            Column { name, pictures: views.map(|view| seen(Rc::clone(&studio), view)).collect() }
        })
        .collect();
    columns.push(Column { name: "drawn".to_owned(), pictures: drawn::pictures() });
    columns
}

/// The scenes inside the program, with their names.
fn studios() -> Vec<(String, Rc<Studio>)> {
    embedded()
        .iter()
        .map(|scene| {
            let read = read(scene.name, scene.text.as_bytes(), &ReadOptions::default());
            let studio = Studio::new(read.expect("embedded scenes are scenes")).expect("of solids");
            (scene.name.to_owned(), Rc::new(studio))
        })
        .collect()
}

/// A view of a scene.
fn seen(studio: Rc<Studio>, view: usize) -> Picture {
    Picture::new(move |dots| {
        let frame = studio.draw(&request(&studio, view, SCREEN, dots, GlyphMode::Ascii));
        Arc::unwrap_or_clone(frame.light)
    })
}

/// A view on a screen of cells that are twice as high as wide.
fn request(studio: &Studio, view: usize, screen: Size, dots: Size, glyphs: GlyphMode) -> Request {
    let aspect = f64::from(screen.width) / (2.0 * f64::from(screen.height));
    Request {
        camera: studio.camera(view, aspect),
        dots,
        dot_aspect: aspect * f64::from(dots.height) / f64::from(dots.width),
        options: Options::default(),
        wants: Wants::CELLS,
        glyphs,
        palette: Palette::MONO,
        tone: Tone::default(),
    }
}
