//! Sides that meet, as outlines.

use std::collections::{BTreeSet, HashMap};

use super::sides::{CELL, Side};
use crate::math::DVec2;

/// The outlines that sides make, whose ends are the same where they lie in one cell of OpenSCAD's grid, or in
/// cells beside each other: from a loose end on, then around what is closed. At a place where more than
/// two meet, the side that was read first comes first. As in OpenSCAD, an open line is closed by its ends.
/// Corners are where the first of their ends is, or in the middle of its cell of the grid.
pub fn outlines(sides: &[Side], is_on_grid: bool) -> Vec<Vec<DVec2>> {
    let mut net = Net::of(sides, is_on_grid);
    let (mut rest, mut outlines) = (0..net.ends.len(), Vec::new());
    while let Some((side, end)) =
        net.loose_end().or_else(|| rest.find(|&side| net.is_open[side]).map(|side| (side, 0)))
    {
        outlines.push(net.outline(side, end));
    }
    outlines
}

/// Sides by the places where they meet.
struct Net {
    places: Vec<DVec2>,
    /// By side: the numbers of its places.
    ends: Vec<[u32; 2]>,
    /// By place: the sides that end there, in the order in which they were read.
    at: Vec<Vec<u32>>,
    /// By place: how many of those are open still, and how many that come first are not.
    count: Vec<u32>,
    passed: Vec<u32>,
    /// By side: whether it is part of no outline yet.
    is_open: Vec<bool>,
    /// Sides that end where no other does.
    loose: BTreeSet<usize>,
}

impl Net {
    fn of(sides: &[Side], is_on_grid: bool) -> Self {
        let (mut cells, mut places) = (HashMap::new(), Vec::new());
        let mut number = |place: DVec2| {
            let cell = (place / CELL).round();
            // Adding 0 makes −0 and 0 the same cell.
            let key = |cell: DVec2| (cell + DVec2::ZERO).to_array().map(f64::to_bits);
            // The cell itself, then those that share a side with it, then those that share a corner.
            let near = [[0, 0], [-1, 0], [0, -1], [0, 1], [1, 0], [-1, -1], [-1, 1], [1, -1], [1, 1]];
            let mut known = near.iter().map(|step| key(cell + DVec2::from(step.map(f64::from))));
            if let Some(&number) = known.find_map(|key| cells.get(&key)) {
                return number;
            }
            let number = places.len() as u32;
            places.push(if is_on_grid { cell * CELL } else { place });
            cells.insert(key(cell), number);
            number
        };
        let ends = sides.iter().map(|side| side.map(&mut number));
        // A side within a cell has no length.
        let ends: Vec<[u32; 2]> = ends.filter(|[from, to]| from != to).collect();
        let mut at = vec![Vec::new(); places.len()];
        for (side, places) in ends.iter().enumerate() {
            for &place in places {
                at[place as usize].push(side as u32);
            }
        }
        let count: Vec<u32> = at.iter().map(|sides| sides.len() as u32).collect();
        let is_loose = |&side: &usize| ends[side].iter().any(|&place| count[place as usize] == 1);
        let loose = (0..ends.len()).filter(is_loose).collect();
        let (passed, is_open) = (vec![0; places.len()], vec![true; ends.len()]);
        Self { places, ends, at, count, passed, is_open, loose }
    }

    /// The first open side that has an end where no other does, and which.
    fn loose_end(&mut self) -> Option<(usize, usize)> {
        while let Some(side) = self.loose.pop_first() {
            let is_loose = |&end: &usize| self.count[self.ends[side][end] as usize] == 1;
            if self.is_open[side]
                && let Some(end) = (0..2).find(is_loose)
            {
                return Some((side, end));
            }
        }
        None
    }

    /// The outline from an end of a side on, until nothing goes on.
    fn outline(&mut self, side: usize, end: usize) -> Vec<DVec2> {
        let mut at = self.ends[side][end];
        let (mut met, mut next) = (vec![at], Some(side));
        while let Some(side) = next {
            self.is_open[side] = false;
            let ends = self.ends[side];
            for place in ends {
                self.count[place as usize] -= 1;
            }
            at = if ends[0] == at { ends[1] } else { ends[0] };
            met.push(at);
            next = self.first_open(at);
        }
        for &place in &met {
            if self.count[place as usize] == 1 {
                let loose = self.first_open(place);
                self.loose.extend(loose);
            }
        }
        if at == met[0] {
            met.pop();
        }
        met.iter().map(|&place| self.places[place as usize]).collect()
    }

    /// The first side at a place that is part of no outline yet.
    fn first_open(&mut self, place: u32) -> Option<usize> {
        let place = place as usize;
        let passed = &mut self.passed[place];
        let open = |&&side: &&u32| !self.is_open[side as usize];
        *passed += self.at[place][*passed as usize..].iter().take_while(open).count() as u32;
        self.at[place].get(*passed as usize).map(|&side| side as usize)
    }
}
