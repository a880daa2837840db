//! The third step of a picture: from finished tiles to its dots.

use std::sync::{Arc, Mutex, PoisonError};

use crate::integrate::History;
use crate::math::{DVec3, Grid, Size};
use crate::shade::Channel;
use crate::view::TILE;

use super::finished_tile::FinishedTile;
use super::{Frame, Request};

/// The dots of a picture; those that nobody wants are absent.
pub(super) struct PictureDots {
    pub light: Grid<f64>,
    pub color: Option<Grid<DVec3>>,
    pub depth: Option<Grid<f64>>,
    pub normal: Option<Grid<DVec3>>,
    pub object: Option<Grid<u32>>,
    /// What the rays through the middles met.
    pub history: Option<Grid<History>>,
}

impl PictureDots {
    /// Room for all dots, which is what a picture that was given up leaves, where nobody else has it.
    pub fn new(request: &Request, given_up: Option<Frame>) -> Self {
        let (size, wants) = (request.dots, request.wants);
        let (mut light, mut color, mut depth, mut normal, mut object) = (None, None, None, None, None);
        if let Some(frame) = given_up {
            light = Some(frame.light);
            (color, depth, normal, object) = (frame.color, frame.depth, frame.normal, frame.object);
        }
        Self {
            light: room(light, size, 0.0),
            color: request.wants_color().then(|| room(color, size, DVec3::ZERO)),
            depth: wants.depth.then(|| room(depth, size, f64::INFINITY)),
            normal: wants.normal.then(|| room(normal, size, DVec3::ZERO)),
            object: wants.object.then(|| room(object, size, 0)),
            history: None,
        }
    }

    /// Makes room for histories.
    pub fn keep_histories(&mut self) {
        self.history = Some(Grid::filled(self.light.size(), History::MISS));
    }

    /// Sets the light of some dots.
    pub fn set<C: Channel>(&mut self, dots: &[RefinedDot<C>]) {
        for RefinedDot { column, row, light } in dots {
            self.light[(*column, *row)] = light.gray();
            if let Some(color) = &mut self.color {
                color[(*column, *row)] = light.rgb();
            }
        }
    }

    /// The picture, as far as its tiles are finished.
    pub fn assembly(&mut self) -> PictureAssembly<'_> {
        let size = self.light.size();
        let rows = size.height.div_ceil(TILE) as usize;
        let mut light = rows_of_tiles(Some(&mut self.light));
        let mut color = rows_of_tiles(self.color.as_mut());
        let mut depth = rows_of_tiles(self.depth.as_mut());
        let mut normal = rows_of_tiles(self.normal.as_mut());
        let mut object = rows_of_tiles(self.object.as_mut());
        let mut history = rows_of_tiles(self.history.as_mut());
        let next = || {
            Band(Mutex::new(Rows {
                light: light(),
                color: color(),
                depth: depth(),
                normal: normal(),
                object: object(),
                history: history(),
            }))
        };
        PictureAssembly { size, bands: std::iter::repeat_with(next).take(rows).collect() }
    }
}

/// A dot that more rays have given another light.
#[derive(Clone, Copy, Debug)]
pub(super) struct RefinedDot<C> {
    pub column: u32,
    pub row: u32,
    pub light: C,
}

/// A picture to which finished tiles are added, in any order and by any thread.
pub(super) struct PictureAssembly<'a> {
    size: Size,
    /// Its rows of tiles, from the top.
    bands: Vec<Band<'a>>,
}

impl PictureAssembly<'_> {
    /// Columns and rows of dots.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Copies the dots of a tile to their places.
    pub fn take<C: Channel>(&self, finished: &FinishedTile<C>) {
        self.bands[(finished.tile.corner[1] / TILE) as usize].take(self.size.width, finished);
    }
}

/// A grid to write all dots of, whatever stands in it now.
fn room<T: Clone>(old: Option<Arc<Grid<T>>>, size: Size, blank: T) -> Grid<T> {
    let alone = old.and_then(Arc::into_inner).filter(|grid| grid.size() == size);
    alone.unwrap_or_else(|| Grid::filled(size, blank))
}

/// One row of tiles after the other; absent where there is no grid.
fn rows_of_tiles<'a, T>(grid: Option<&'a mut Grid<T>>) -> impl FnMut() -> Option<&'a mut [T]> {
    let mut rows = grid.map(|grid| {
        let dots = grid.size().width as usize * TILE as usize;
        // `chunks_mut` refuses a width of 0, whose grid has no values at all.
        grid.values_mut().chunks_mut(dots.max(1))
    });
    move || rows.as_mut().and_then(Iterator::next)
}

/// A row of tiles within the picture. Its tiles are finished by different threads; each copies its dots in
/// one go, which takes a small part of the time of tracing them, so that they seldom wait for each other.
struct Band<'a>(Mutex<Rows<'a>>);

struct Rows<'a> {
    light: Option<&'a mut [f64]>,
    color: Option<&'a mut [DVec3]>,
    depth: Option<&'a mut [f64]>,
    normal: Option<&'a mut [DVec3]>,
    object: Option<&'a mut [u32]>,
    history: Option<&'a mut [History]>,
}

impl Band<'_> {
    /// Copies the dots of a tile to their places in a picture of so many columns.
    fn take<C: Channel>(&self, columns: u32, dots: &FinishedTile<C>) {
        // A thread that panicked while copying ends the whole picture.
        let mut rows = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let tile = &dots.tile;
        let place = Place { columns: columns as usize, left: tile.corner[0] as usize, size: tile.size };
        place.copy(rows.light.as_deref_mut(), Some(&dots.light), |light| light.gray());
        place.copy(rows.color.as_deref_mut(), Some(&dots.light), |light| light.rgb());
        place.copy(rows.depth.as_deref_mut(), dots.depth.as_ref(), |&depth| depth);
        place.copy(rows.normal.as_deref_mut(), dots.normal.as_ref(), |&normal| normal);
        place.copy(rows.object.as_deref_mut(), dots.object.as_ref(), |&object| object);
        place.copy(rows.history.as_deref_mut(), dots.history.as_ref(), |&history| history);
    }
}

/// Where a tile lies in its band.
struct Place {
    columns: usize,
    left: usize,
    size: Size,
}

impl Place {
    fn copy<T, U>(&self, band: Option<&mut [T]>, tile: Option<&Vec<U>>, value: impl Fn(&U) -> T) {
        let (Some(band), Some(tile)) = (band, tile) else { return };
        let width = self.size.width as usize;
        for (row, dots) in band.chunks_mut(self.columns).zip(tile.chunks(width)) {
            for (place, dot) in row[self.left..][..width].iter_mut().zip(dots) {
                *place = value(dot);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::prepare::Work;
    use super::super::render::TileRenderer;
    use super::*;
    use crate::frame::{Studio, Wants};
    use crate::glyph::{GlyphMode, Palette};
    use crate::integrate::TileIntegrator;
    use crate::plan::{EngineChoice, Options};
    use crate::scene::{self, ReadOptions};
    use crate::stage::{Counts, GiveUp, Stopwatch};
    use crate::tone::Tone;
    use crate::view::tiles;

    const SCENE: &str = "light(at = [3, -4, 5]); material(name = \"glass\", kt = 0.7, index = 1.5); \
        translate([0.4, -2, 0]) material(\"glass\") sphere(0.6); material(kr = 0.4) cube(1); \
        translate([-1, 1, 0]) sphere(1);";

    fn studio() -> Studio {
        Studio::new(scene::read("test", SCENE.as_bytes(), &ReadOptions::default()).unwrap()).unwrap()
    }

    fn request(engine: EngineChoice, samples: u32, wants: Wants) -> Request {
        Request {
            camera: studio().camera(0, 1.5),
            dots: Size::new(75, 50),
            dot_aspect: 1.0,
            options: Options { engine, samples, threads: 1, ..Options::default() },
            wants,
            glyphs: GlyphMode::Shade,
            palette: Palette::MONO,
            tone: Tone::Lightness,
        }
    }

    /// Every other tile of a picture.
    struct EveryOther {
        first: usize,
        dots: Size,
        wants: Wants,
    }

    impl<C: Channel> Work<C> for EveryOther {
        type Done = Vec<FinishedTile<C>>;

        fn by<I: TileIntegrator<C>>(self, renderer: &TileRenderer<I>) -> Self::Done {
            let mut memory = renderer.memory();
            let own = tiles(self.dots).into_iter().skip(self.first).step_by(2);
            own.map(|tile| {
                let mut finished = FinishedTile::new(self.wants);
                renderer.render(&tile, Stopwatch::still(), &mut memory, &mut finished);
                finished
            })
            .collect()
        }
    }

    #[test]
    fn tiles_of_two_renderers_in_any_order_are_the_picture_of_one() {
        for (engine, samples) in [EngineChoice::Exact, EngineChoice::Fast]
            .into_iter()
            .flat_map(|engine| [1, 2, 3].map(|samples| (engine, samples)))
        {
            let request = request(engine, samples, Wants::ALL);
            let drawn = studio().draw(&request);
            let mut dots = PictureDots::new(&request, None);
            let picture = dots.assembly();
            let mut counts = Counts::default();
            for first in [1, 0] {
                let studio = studio();
                let work = EveryOther { first, dots: request.dots, wants: request.wants };
                for finished in
                    studio.prepare(&request, None, &GiveUp::never()).work::<f64, _>(work).iter().rev()
                {
                    counts += finished.counts;
                    picture.take(finished);
                }
            }
            assert_eq!(dots.light, *drawn.light);
            assert_eq!(dots.depth.as_ref(), drawn.depth.as_deref());
            assert_eq!(dots.normal.as_ref(), drawn.normal.as_deref());
            assert_eq!(dots.object.as_ref(), drawn.object.as_deref());
            assert_eq!(counts, drawn.counts);
        }
    }

    #[test]
    fn the_middle_of_a_dot_is_traced_where_it_is_asked_for_and_shaded_where_it_is_a_sample() {
        for engine in [EngineChoice::Exact, EngineChoice::Fast] {
            for samples in 1..=4 {
                let drawn = |wants| studio().draw(&request(engine, samples, wants));
                let (light, all) = (drawn(Wants::LIGHT), drawn(Wants::ALL));
                assert_eq!(light.light, all.light);
                let (dots, rays) = (light.light.values().len() as u64, u64::from(samples).pow(2));
                assert_eq!(light.counts.primary_rays, dots * rays);
                assert_eq!(all.counts.primary_rays, dots * rays);
                assert_eq!(all.counts.shadow_rays, light.counts.shadow_rays);
                assert_eq!(all.counts.secondary_rays, light.counts.secondary_rays);
                // What the middle sees does not depend on the samples.
                let middle = studio().draw(&request(engine, 1, Wants::ALL));
                assert_eq!((all.depth, all.normal, all.object), (middle.depth, middle.normal, middle.object));
            }
        }
    }
}
