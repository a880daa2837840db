//! `s`, `c`, `p` and `pp`: what is seen.

use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

use crate::math::{DAffine3, DMat3, DVec3, Placement};
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::model::is_within_reach;
use crate::scene::{Corner, Diagnostic, MaterialId, Object, Primitive, REACH, Shape, Solid};

use super::entity::Entity;
use super::light::Fills;
use crate::scene::outline::{drop_repeated, has_area};

/// The shortest corner that can be written: three digits, each with a blank.
const CORNER_BYTES: usize = 6;

/// The shortest place in a texture: two digits, each with a blank.
const TEXTURE_BYTES: usize = 4;

/// Lengths whose reciprocals and products of three are far from the limits of f64.
const PLAIN: RangeInclusive<f64> = 1e-90..=1e90;

/// The objects, in file order.
#[derive(Debug, Default)]
pub struct Solids {
    objects: Vec<Object>,
    /// Corners of the face that is being read; kept to be used again.
    places: Vec<DVec3>,
    corners: Vec<Corner>,
    without_area: usize,
    first_without_area: Option<Range<usize>>,
}

impl Solids {
    /// `s x y z radius`: a ball.
    pub fn sphere(&mut self, entity: &mut Entity, fills: &mut Fills) -> Result<(), Reported> {
        let center = entity.vector(|| "the centre".to_owned())?;
        let [radius] = entity.numbers(["the radius"])?;
        entity.check(radius, radius.value > 0.0, "the radius is above 0")?;
        // What has no reciprocal has no inverse map; the general question costs more than the rest of a
        // sphere.
        let large_enough = radius.value.recip().is_finite();
        entity.check(radius, large_enough, "it is smaller than a 64-bit float holds")?;
        let map = DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(radius.value)), center);
        self.placed(entity, Shape::Sphere, map, fills.current())
    }

    /// `c` base x y z radius, apex x y z radius: the side of a cylinder or a cone, open at both ends.
    pub fn tube(&mut self, entity: &mut Entity, fills: &mut Fills) -> Result<(), Reported> {
        let base = entity.vector(|| "the base".to_owned())?;
        let [bottom] = entity.numbers(["the radius at the base"])?;
        let apex = entity.vector(|| "the apex".to_owned())?;
        let [top] = entity.numbers(["the radius at the apex"])?;
        for radius in [bottom, top] {
            entity.check(radius, radius.value >= 0.0, "a radius is 0 or more")?;
        }
        let largest = bottom.value.max(top.value);
        entity.check(bottom, largest > 0.0, "one of the radii is above 0")?;
        let half = 0.5 * apex - 0.5 * base;
        let size = half.abs().max_element();
        if size == 0.0 {
            return Err(entity.wrong(entity.keyword, "base and apex are the same point"));
        }
        let (x, y) = (half / size).normalize_or(DVec3::Z).any_orthonormal_pair();
        let linear = DMat3::from_cols(x * largest, y * largest, half);
        let map = DAffine3::from_mat3_translation(linear, 0.5 * base + 0.5 * apex);
        // Three columns at right angles, neither long nor short: the map has an inverse.
        let is_plain = [largest, size].iter().all(|length| PLAIN.contains(length));
        if !is_plain && Placement::new(&map).is_none() {
            return Err(entity.wrong(entity.keyword, "it is smaller than a 64-bit float holds"));
        }
        let shape = Shape::Tube { bottom: bottom.value / largest, top: top.value / largest };
        self.placed(entity, shape, map, fills.current())
    }

    /// `p n`, then n corners.
    pub fn face(&mut self, entity: &mut Entity, fills: &mut Fills) -> Result<(), Reported> {
        let count = corner_count(entity, CORNER_BYTES)?;
        self.face_of(entity, fills, CornerList { count, textured: false })
    }

    /// `pp n`, then n times a corner and its normal.
    pub fn patch(&mut self, entity: &mut Entity, fills: &mut Fills) -> Result<(), Reported> {
        let count = corner_count(entity, 2 * CORNER_BYTES)?;
        self.patch_of(entity, fills, CornerList { count, textured: false })
    }

    /// `tt name`, then 3 times a corner and its place in the texture.
    pub fn textured_triangle(&mut self, entity: &mut Entity, fills: &mut Fills) -> Result<(), Reported> {
        entity.texture_name()?;
        self.face_of(entity, fills, CornerList { count: 3, textured: true })
    }

    /// `ttp name`, then 3 times a corner, its normal and its place in the texture.
    pub fn textured_triangle_patch(
        &mut self,
        entity: &mut Entity,
        fills: &mut Fills,
    ) -> Result<(), Reported> {
        entity.texture_name()?;
        self.patch_of(entity, fills, CornerList { count: 3, textured: true })
    }

    /// `tpp n`, then n times a corner, its normal and its place in the texture that the last `f` names.
    pub fn textured_patch(&mut self, entity: &mut Entity, fills: &mut Fills) -> Result<(), Reported> {
        let count = corner_count(entity, 2 * CORNER_BYTES + TEXTURE_BYTES)?;
        self.patch_of(entity, fills, CornerList { count, textured: true })
    }

    fn face_of(&mut self, entity: &mut Entity, fills: &mut Fills, list: CornerList) -> Result<(), Reported> {
        self.places.clear();
        for number in 1..=list.count {
            self.places.push(entity.vector(|| list.corner_name(number))?);
            list.ignore_texture(entity, number)?;
        }
        drop_repeated(&mut self.places, |&place| place);
        if has_area(self.places.iter().copied()) {
            self.surface(entity, Shape::Face(Arc::from(&self.places[..])), fills.current())
        } else {
            self.leave_out(entity);
            Ok(())
        }
    }

    fn patch_of(&mut self, entity: &mut Entity, fills: &mut Fills, list: CornerList) -> Result<(), Reported> {
        self.corners.clear();
        for number in 1..=list.count {
            let place = entity.vector(|| list.corner_name(number))?;
            let normal = entity.vector(|| format!("the normal of {}", list.corner_name(number)))?;
            self.corners.push(Corner { place, normal });
            list.ignore_texture(entity, number)?;
        }
        drop_repeated(&mut self.corners, |corner| corner.place);
        if has_area(self.corners.iter().map(|corner| corner.place)) {
            self.surface(entity, Shape::Patch(Arc::from(&self.corners[..])), fills.current())
        } else {
            self.leave_out(entity);
            Ok(())
        }
    }

    /// A surface whose corners are in the world already.
    fn surface(&mut self, entity: &mut Entity, shape: Shape, material: MaterialId) -> Result<(), Reported> {
        if !is_within_reach(&shape.bounds()) {
            return Err(too_far(entity));
        }
        let solid = Solid::Primitive(Primitive::new(shape, DAffine3::IDENTITY, material));
        self.objects.push(Object { name: None, solid });
        Ok(())
    }

    fn placed(
        &mut self,
        entity: &mut Entity,
        shape: Shape,
        map: DAffine3,
        material: MaterialId,
    ) -> Result<(), Reported> {
        if !is_within_reach(&shape.bounds().mapped(&map)) {
            return Err(too_far(entity));
        }
        self.objects
            .push(Object { name: None, solid: Solid::Primitive(Primitive::new(shape, map, material)) });
        Ok(())
    }

    fn leave_out(&mut self, entity: &Entity) {
        self.without_area += 1;
        self.first_without_area.get_or_insert_with(|| entity.keyword.span());
    }

    /// The same with those of what follows in the file, whose materials are now `ids`.
    pub fn append(&mut self, next: Self, ids: &[MaterialId]) {
        self.objects.extend(next.objects.into_iter().map(|mut object| {
            if let Solid::Primitive(primitive) = &mut object.solid {
                primitive.material = ids[primitive.material.0 as usize];
            }
            object
        }));
        self.without_area += next.without_area;
        self.first_without_area = self.first_without_area.take().or(next.first_without_area);
    }

    /// Whether any face was left out.
    pub fn any_left_out(&self) -> bool {
        self.without_area > 0
    }

    /// How many objects there are.
    pub fn len(&self) -> usize {
        self.objects.len()
    }

    /// Makes room for objects to come.
    pub fn reserve(&mut self, objects: usize) {
        self.objects.reserve_exact(objects);
    }

    /// All objects, and a note of what was left out.
    pub fn finish(mut self, sink: &mut Sink) -> Vec<Object> {
        if let Some(place) = self.first_without_area {
            let message = match self.without_area {
                1 => "a face has no area and is left out".to_owned(),
                count => format!("{count} faces, of which this is the first, have no area and are left out"),
            };
            sink.note(Diagnostic::note(place, message));
        }
        self.objects.shrink_to_fit();
        self.objects
    }
}

/// Takes the number of corners, if the rest of the file has room for them.
fn corner_count(entity: &mut Entity, bytes: usize) -> Result<usize, Reported> {
    let [number] = entity.numbers(["the number of corners"])?;
    let whole = number.value >= 3.0 && number.value.fract() == 0.0;
    entity.check(number, whole, "the number of corners is a whole number, 3 or more")?;
    // The last corner needs no blank behind it. A cast of what is too large gives the largest number.
    let room = (entity.tokens.bytes_left() + 1) / bytes;
    if number.value as usize > room {
        let left = format!("room for {} corners", number.token.shown());
        return Err(entity.cut_off(&left));
    }
    Ok(number.value as usize)
}

fn too_far(entity: &mut Entity) -> Reported {
    entity.wrong(entity.keyword, &format!("it reaches farther than {REACH:e} from the origin"))
}

/// The corners that an entity lists.
#[derive(Clone, Copy, Debug)]
struct CornerList {
    count: usize,
    /// Whether each has its place in a texture behind it.
    textured: bool,
}

impl CornerList {
    /// Corners are counted from 1.
    fn corner_name(self, number: usize) -> String {
        format!("corner {number} of {}", self.count)
    }

    fn ignore_texture(self, entity: &mut Entity, number: usize) -> Result<(), Reported> {
        if self.textured {
            for axis in ["u", "v"] {
                entity.number(|| format!("{axis} of {}", self.corner_name(number)))?;
            }
        }
        Ok(())
    }
}
