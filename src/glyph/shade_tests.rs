//! The cells of the levels, in each palette.

use super::*;
use proptest::prelude::*;

const VGA: Palette = Palette::DOS;

fn even(palette: Palette, cell: Cell) -> f64 {
    let Some(Coverage::Even(ink)) = coverage(cell.glyph) else { panic!("a shade covers evenly") };
    palette.ink_light(cell) * ink + palette.paper_light(cell) * (1.0 - ink)
}

#[test]
fn the_mix_of_ink_and_paper_is_the_light_of_the_level() {
    for papers in [Papers::All, Papers::Dim] {
        let shades = Shades::new(VGA, papers);
        for level in Level::all() {
            let cell = shades.cell(level, 0, 0);
            assert!((even(VGA, cell) - level.light()).abs() < 1e-15, "level {}", level.get());
            assert_eq!(shades.light(level), even(VGA, cell));
            let shaded = cell.glyph != ' ' || papers == Papers::Dim;
            assert!(!shaded || matches!(cell.paper, Paint::Black | Paint::LightGray), "{cell:?}");
        }
    }
}

#[test]
fn a_pc_has_the_printed_table() {
    use Paint::{Black, DarkGray, LightGray, White};
    let written = |papers| -> Vec<(char, Paint, Paint)> {
        let shades = Shades::new(VGA, papers);
        Level::all().map(|l| shades.cell(l, 0, 0)).map(|c| (c.glyph, c.ink, c.paper)).collect()
    };
    let mut table = vec![
        (' ', DarkGray, Black),
        ('░', DarkGray, Black),
        ('▒', DarkGray, Black),
        ('▓', DarkGray, Black),
        (' ', DarkGray, DarkGray),
        ('▓', DarkGray, LightGray),
        ('▒', DarkGray, LightGray),
        ('░', DarkGray, LightGray),
        (' ', LightGray, LightGray),
        ('░', White, LightGray),
        ('▒', White, LightGray),
        ('▓', White, LightGray),
        (' ', White, White),
    ];
    assert_eq!(written(Papers::All), table);
    // A Linux console has no paper of these two.
    table[4] = ('█', DarkGray, Black);
    table[12] = ('█', White, LightGray);
    assert_eq!(written(Papers::Dim), table);
}

#[test]
fn ink_alone_is_the_nearest_that_looks_even() {
    let shades = [0_u8, 2, 3, 4, 5, 6, 7, 8];
    for level in Level::all() {
        let away = |eighths: u8| (lightness(f64::from(eighths) / EIGHTHS) - lightness(level.light())).abs();
        let nearest = shades.into_iter().min_by(|&a, &b| away(a).total_cmp(&away(b)));
        assert_eq!(Some(MONO[usize::from(level.get())]), nearest, "level {}", level.get());
    }
}

#[test]
fn ink_alone_covers_what_it_says_on_dark_paper_and_on_light() {
    for ground in [Ground::Dark, Ground::Light] {
        let palette = Palette::Mono(ground);
        let shades = Shades::new(palette, Papers::All);
        for level in Level::all() {
            let quarters = (0..4).map(|k| even(palette, shades.cell(level, k % 2, k / 2)) / 4.0);
            assert_eq!(quarters.sum::<f64>(), shades.light(level), "{ground:?}");
        }
    }
}

#[test]
fn ascii_is_a_ramp_of_the_terminals_own_colours() {
    let ramp = |ground| -> String { Level::all().map(|level| ascii(level, ground).glyph).collect() };
    assert_eq!(ramp(Ground::Dark), " .-,:;*=xo$#@");
    assert_eq!(ramp(Ground::Light), "@#$ox=*;:,-. ");
}

/// Black and white and two grays between, as terminals have them.
fn any_grays() -> impl Strategy<Value = FourGrays> {
    let colors = (0_u8..40, 70_u8..130, 150_u8..235, 245_u8..=255)
        .prop_map(|(a, b, c, d)| [[a; 3], [b; 3], [c; 3], [d; 3]]);
    colors.prop_filter_map("grays in order", FourGrays::of_attributes)
}

proptest! {
    #[test]
    fn levels_keep_their_order_in_any_grays(grays in any_grays()) {
        for papers in [Papers::All, Papers::Dim] {
            let shades = Shades::new(Palette::Dos(grays), papers);
            let lights: Vec<f64> = Level::all().map(|level| shades.light(level)).collect();
            prop_assert!(lights.is_sorted(), "{lights:?}");
            for level in Level::all() {
                prop_assert_eq!(shades.light(level), even(Palette::Dos(grays), shades.cell(level, 0, 0)));
            }
        }
    }

    /// The definition: of all shades of two grays none is nearer in lightness by more than its grain costs.
    #[test]
    fn no_other_shade_is_nearer(grays in any_grays(), level in 0_u8..13) {
        let meant = lightness(Level::new(level).unwrap_or_default().light());
        let found = lightness(Shades::new(Palette::Dos(grays), Papers::All).light(Level::new(level).unwrap_or_default()));
        let lights = grays.lights();
        for (dark, bright) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            for quarters in 0..=4 {
                let share = f64::from(quarters) / 4.0;
                let other = lightness(lights[dark] * (1.0 - share) + lights[bright] * share);
                let most = GRAIN * 100.0;
                prop_assert!((found - meant).abs() <= (other - meant).abs() + most + 1e-9);
            }
        }
    }
}
