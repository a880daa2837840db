//! From the dots of tiles to the dots of the picture.

use std::sync::{Arc, Mutex, PoisonError};

use crate::math::{DVec3, Grid, Size};
use crate::shade::{Channel, PrimaryHit};
use crate::solid::Assembly;
use crate::view::{TILE, Tile};

use super::{Frame, Request, Wants};

/// The dots of one tile in scan order: memory of a worker, which every tile fills anew. Each vector has a value per
/// dot; those that nobody wants are absent.
pub(super) struct TileDots<C> {
    pub light: Vec<C>,
    /// In the scene's unit; infinite where nothing is seen.
    pub depth: Option<Vec<f64>>,
    /// 0 where nothing is seen.
    pub normal: Option<Vec<DVec3>>,
    /// From 1 in file order; 0 where nothing is seen.
    pub object: Option<Vec<u32>>,
}

impl<C: Channel> TileDots<C> {
    /// Room for nothing yet.
    pub fn new(wants: Wants) -> Self {
        Self {
            light: Vec::new(),
            depth: wants.depth.then(Vec::new),
            normal: wants.normal.then(Vec::new),
            object: wants.object.then(Vec::new),
        }
    }

    /// Whether anyone wants to know what dots see, beside light.
    pub fn sees(&self) -> bool {
        self.depth.is_some() || self.normal.is_some() || self.object.is_some()
    }

    /// Sets what a dot sees, as far as anyone wants it.
    #[inline]
    pub fn see(&mut self, place: usize, seen: Option<PrimaryHit>, assembly: &Assembly) {
        if let Some(depth) = &mut self.depth {
            // A distance, however large: only nothing is infinitely far away.
            let distance = |seen: PrimaryHit| (seen.t * assembly.scene_frame.unit).min(f64::MAX);
            depth[place] = seen.map_or(f64::INFINITY, distance);
        }
        if let Some(normal) = &mut self.normal {
            normal[place] = seen.map_or(DVec3::ZERO, |seen| seen.normal);
        }
        if let Some(object) = &mut self.object {
            object[place] = seen.map_or(0, |seen| assembly.objects[seen.object as usize].number + 1);
        }
    }

    /// As many dots as the tile has. What stands in them is left over.
    pub fn fit(&mut self, tile: &Tile) {
        let area = tile.size.area();
        self.light.resize(area, C::DARK);
        if let Some(depth) = &mut self.depth {
            depth.resize(area, f64::INFINITY);
        }
        if let Some(normal) = &mut self.normal {
            normal.resize(area, DVec3::ZERO);
        }
        if let Some(object) = &mut self.object {
            object.resize(area, 0);
        }
    }
}

/// The dots of a picture; those that nobody wants are absent.
pub(super) struct PictureDots {
    pub light: Grid<f64>,
    pub color: Option<Grid<DVec3>>,
    pub depth: Option<Grid<f64>>,
    pub normal: Option<Grid<DVec3>>,
    pub object: Option<Grid<u32>>,
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
        }
    }

    /// The picture in rows of tiles, from the top.
    pub fn bands(&mut self) -> Vec<Band<'_>> {
        let rows = self.light.size().height.div_ceil(TILE) as usize;
        let mut light = rows_of_tiles(Some(&mut self.light));
        let mut color = rows_of_tiles(self.color.as_mut());
        let mut depth = rows_of_tiles(self.depth.as_mut());
        let mut normal = rows_of_tiles(self.normal.as_mut());
        let mut object = rows_of_tiles(self.object.as_mut());
        let next = || {
            Band(Mutex::new(Rows {
                light: light(),
                color: color(),
                depth: depth(),
                normal: normal(),
                object: object(),
            }))
        };
        std::iter::repeat_with(next).take(rows).collect()
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

/// A row of tiles within the picture. Its tiles are finished by different threads; each copies its dots in one go,
/// which takes a small part of the time of tracing them, so that they seldom wait for each other.
pub(super) struct Band<'a>(Mutex<Rows<'a>>);

struct Rows<'a> {
    light: Option<&'a mut [f64]>,
    color: Option<&'a mut [DVec3]>,
    depth: Option<&'a mut [f64]>,
    normal: Option<&'a mut [DVec3]>,
    object: Option<&'a mut [u32]>,
}

impl Band<'_> {
    /// Copies the dots of a tile to their places in a picture of so many columns.
    pub fn take<C: Channel>(&self, columns: u32, tile: &Tile, dots: &TileDots<C>) {
        // A thread that panicked while copying ends the whole picture.
        let mut rows = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = Place { columns: columns as usize, left: tile.corner[0] as usize, size: tile.size };
        place.copy(rows.light.as_deref_mut(), Some(&dots.light), |light| light.gray());
        place.copy(rows.color.as_deref_mut(), Some(&dots.light), |light| light.rgb());
        place.copy(rows.depth.as_deref_mut(), dots.depth.as_ref(), |&depth| depth);
        place.copy(rows.normal.as_deref_mut(), dots.normal.as_ref(), |&normal| normal);
        place.copy(rows.object.as_deref_mut(), dots.object.as_ref(), |&object| object);
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
