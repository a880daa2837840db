//! What fills the space that a ray goes through.
//!
//! A path carries the list of the glass objects it is in. Where they overlap, the object that comes last in
//! the file fills the place, so that water written behind its glass is water. The list follows from where the
//! path has been, not from its directions, so the way back sees the same media as the way in.

use std::ops::Range;

/// The index of refraction outside of all glass.
pub(crate) const OUTSIDE: f64 = 1.0;

/// A glass object that a path is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Medium {
    /// The object's index in the assembly.
    pub object: u32,
    /// The index of refraction of the surface through which it was entered.
    pub index: f64,
}

/// A glass surface that a path goes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interface {
    /// The object, with the index of refraction of this surface.
    pub filling: Medium,
    /// Whether the path goes into the object.
    pub entering: bool,
    /// Whether the object has an inside to be in: a face has sides only.
    pub solid: bool,
}

/// The indices of refraction on the two sides of a place, on the way of a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MediumTransition {
    /// Before it.
    pub before: f64,
    /// Behind it.
    pub behind: f64,
    /// The list of those who go on.
    pub list: MediumStack,
}

/// A list of glass objects, by its place in [`Media`].
pub(crate) type MediumStack = Range<usize>;

/// The lists of one path and its branches, one behind the other, so that none needs memory of its own. Each
/// is sorted by object and holds each object once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Media {
    lists: Vec<Medium>,
}

impl Media {
    /// Forgets all lists and starts a path inside these objects, sorted.
    #[inline]
    pub fn start(&mut self, inside: &[Medium]) -> MediumStack {
        self.lists.clear();
        self.lists.extend_from_slice(inside);
        0..inside.len()
    }

    /// The index of refraction that a list means.
    #[inline]
    pub fn index(&self, list: &MediumStack) -> f64 {
        self.lists[list.clone()].last().map_or(OUTSIDE, |filling| filling.index)
    }

    /// A path in `list` goes through surfaces that all lie in the same place, one per object.
    ///
    /// A path that enters an object was not in it before, and one that leaves an object was, whatever the
    /// list says: so a list that does not balance, as rounding or an open surface may leave it, mends itself.
    pub fn change(
        &mut self,
        list: &MediumStack,
        passages: impl Iterator<Item = Interface> + Clone,
    ) -> MediumTransition {
        let start = self.lists.len();
        for place in list.clone() {
            let filling = self.lists[place];
            if !passages.clone().any(|p| p.filling.object == filling.object) {
                self.lists.push(filling);
            }
        }
        let rest = self.lists.get(start..).and_then(<[_]>::last).copied();
        let (mut before, mut behind) = (rest, rest);
        for Interface { filling, entering, .. } in passages.clone() {
            let last = if entering { &mut behind } else { &mut before };
            if last.is_none_or(|last: Medium| last.object <= filling.object) {
                *last = Some(filling);
            }
        }
        let [before, behind] = [before, behind].map(|last| last.map_or(OUTSIDE, |filling| filling.index));
        self.lists.extend(passages.filter(|p| p.entering && p.solid).map(|p| p.filling));
        self.lists[start..].sort_unstable_by_key(|filling| filling.object);
        MediumTransition { before, behind, list: start..self.lists.len() }
    }

    /// Forgets a list and all that came after it.
    #[inline]
    pub fn forget(&mut self, list: &MediumStack) {
        self.lists.truncate(list.start);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passage(object: u32, index: f64, entering: bool) -> Interface {
        Interface { filling: Medium { object, index }, entering, solid: true }
    }

    /// The indices met on the way through these surfaces, one place after the other.
    fn indices(places: &[&[Interface]]) -> Vec<(f64, f64)> {
        let mut media = Media::default();
        let mut list = media.start(&[]);
        let mut met = Vec::new();
        for place in places {
            let change = media.change(&list, place.iter().copied());
            met.push((change.before, change.behind));
            list = change.list;
        }
        met
    }

    #[test]
    fn the_last_in_the_file_fills_an_overlap_on_the_way_in_and_back() {
        let (glass, water) = (|e| passage(0, 1.5, e), |e| passage(1, 1.33, e));
        let through = [&[glass(true)][..], &[water(true)], &[glass(false)], &[water(false)]];
        assert_eq!(indices(&through), [(1.0, 1.5), (1.5, 1.33), (1.33, 1.33), (1.33, 1.0)]);
        let back = [&[water(true)][..], &[glass(true)], &[water(false)], &[glass(false)]];
        assert_eq!(indices(&back), [(1.0, 1.33), (1.33, 1.33), (1.33, 1.5), (1.5, 1.0)]);
    }

    #[test]
    fn surfaces_in_one_place_are_crossed_together() {
        let touching = [&[passage(3, 1.5, true)][..], &[passage(3, 1.5, false), passage(1, 1.33, true)]];
        assert_eq!(indices(&touching), [(1.0, 1.5), (1.5, 1.33)]);
    }

    #[test]
    fn a_list_that_does_not_balance_mends_itself() {
        // Left without having been entered; entered twice; then left once.
        let ways =
            [passage(0, 1.5, false), passage(0, 1.5, true), passage(0, 1.5, true), passage(0, 1.5, false)];
        let places: Vec<&[Interface]> = ways.iter().map(std::slice::from_ref).collect();
        assert_eq!(indices(&places), [(1.5, 1.0), (1.0, 1.5), (1.0, 1.5), (1.5, 1.0)]);
    }

    #[test]
    fn a_face_has_sides_and_no_inside() {
        let face = |entering| Interface { solid: false, ..passage(0, 1.5, entering) };
        assert_eq!(indices(&[&[face(true)], &[face(false)]]), [(1.0, 1.5), (1.5, 1.0)]);
        let mut media = Media::default();
        let list = media.start(&[]);
        assert!(media.change(&list, [face(true)].into_iter()).list.is_empty());
    }

    #[test]
    fn forgotten_lists_leave_those_before_them() {
        let mut media = Media::default();
        let eye = media.start(&[Medium { object: 7, index: 1.2 }]);
        let inner = media.change(&eye, [passage(9, 1.7, true)].into_iter());
        assert_eq!(media.index(&inner.list), 1.7);
        media.forget(&inner.list);
        assert_eq!((media.index(&eye), media.lists.len()), (1.2, 1));
    }
}
