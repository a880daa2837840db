//! The best fit against its definition.

use super::*;
use crate::glyph::choice::Ground;
use crate::glyph::shape::{BLOCKS, HALVES};
use proptest::prelude::*;

/// Dots all around of every light.
const ANY: LevelRange = LevelRange { darkest: Level::MIN, lightest: Level::MAX };

#[test]
fn even_light_is_its_level() {
    let fit = BestFit::new(BLOCKS, Papers::All, Palette::DOS);
    for level in Level::all() {
        assert_eq!(fit.nearest(&[level.light(); DOT_COUNT], || ANY), Show::Level(level));
    }
}

#[test]
fn every_candidate_is_nearest_to_itself() {
    for (shapes, papers, palette) in [
        (BLOCKS, Papers::All, Palette::DOS),
        (HALVES, Papers::Dim, Palette::DOS),
        (BLOCKS, Papers::All, Palette::MONO),
        (BLOCKS, Papers::All, Palette::Mono(Ground::Light)),
    ] {
        let fit = BestFit::new(shapes, papers, palette);
        let edges = fit.shows.iter().filter_map(|show| match show {
            Show::Edge(cell) => Some(*cell),
            Show::Level(_) => None,
        });
        for cell in edges {
            let shape = shapes.iter().find(|shape| shape.glyph == cell.glyph).expect("of the table");
            let dots = shape.dots(palette.ink_light(cell), palette.paper_light(cell));
            assert_eq!(fit.nearest(&dots, || ANY), Show::Edge(cell));
        }
    }
}

#[test]
fn what_looks_the_same_is_there_once() {
    // Six pairs of the four grays; seven ways to part the quadrants, and two quarters that each look two
    // ways.
    let fit = BestFit::new(BLOCKS, Papers::All, Palette::DOS);
    assert_eq!(fit.shows.len(), 13 + 6 * (2 * 7 + 4));
}

#[test]
fn paper_is_a_dim_gray_where_it_can_be() {
    // Every choice of quadrants has its complement, so ink and paper may change places; a quarter has none.
    let fit = BestFit::new(BLOCKS, Papers::All, Palette::DOS);
    let bright = |paint: Paint| matches!(paint, Paint::DarkGray | Paint::White);
    for show in &fit.shows {
        if let Show::Edge(cell) = show {
            let quarter = matches!(cell.glyph, '▂' | '▆');
            assert!(!bright(cell.paper) || bright(cell.ink) || quarter, "{cell:?}");
        }
    }
}

proptest! {
    /// The table's rounded sums against the definition `eᵀ K e`, in f64.
    #[test]
    fn the_choice_is_the_least_error(dots in prop::array::uniform8(0.0..=1.0)) {
        let fit = BestFit::new(BLOCKS, Papers::All, Palette::DOS);
        let overlaps = overlaps();
        let cost = |show: Show| {
            let shown = match show {
                Show::Level(level) => [level.light(); DOT_COUNT],
                Show::Edge(cell) => {
                    let shape = BLOCKS.iter().find(|shape| shape.glyph == cell.glyph).expect("of the table");
                    shape.dots(Palette::DOS.ink_light(cell), Palette::DOS.paper_light(cell))
                }
            };
            let error: Dots = std::array::from_fn(|d| lightness(dots[d]) - lightness(shown[d]));
            let pairs = (0..DOT_COUNT).flat_map(|a| (0..DOT_COUNT).map(move |b| (a, b)));
            pairs.map(|(a, b)| error[a] * overlaps[a][b] * error[b]).sum::<f64>()
        };
        let least = fit.shows.iter().map(|&show| cost(show)).fold(f64::INFINITY, f64::min);
        // f32 carries the products of lightnesses, up to 10⁵, to a few parts in 10⁷.
        prop_assert!(cost(fit.nearest(&dots, || ANY)) <= least + 0.1);
    }
}
