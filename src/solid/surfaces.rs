//! Stage 7, SOLID, for a packet of rays: the first place along each where it meets a surface that bounds no
//! solid.
//!
//! It does what [`super::surface`] does for one ray, and finds the same bits. The few rays of which eight at
//! a time can not be certain, through an edge to within rounding or along a polygon's plane, are asked one by
//! one.

use fearless_simd::{Simd, SimdBase, SimdMask, f64x8, mask64x8, u32x8};

use crate::math::{LANES, Mask, Number, REGISTERS, RayPacket, SimdReal};
use crate::stage::{Meter, Silent};

use super::crossing::{FirstCrossings, PlaceError, RayStarts, start_of};
use super::csg_query::{Departures, PacketCrossings};
use super::face::{Face, SteepCrossings};
use super::packet_shear::{Around, PacketShear};
use super::primitive::{WorldPrimitive, WorldShape};
use super::surface::{first_of_surface, firsts_of_tube};
use super::tube::Tube;

/// What is asked of a surface that bounds no solid.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceQuery<'a> {
    /// The rays.
    pub packet: &'a RayPacket,
    /// Which of them ask, a bit for each.
    pub wanted: u64,
    /// The surfaces that they leave; none for rays from the eye.
    pub departures: Option<&'a Departures>,
}

/// The first crossings of a surface, a primitive with its index, for the rays of `wanted`. `sheared` are the
/// planes across the packet's rays.
pub fn firsts_of_surface<S: Simd>(
    simd: S,
    asked: &SurfaceQuery,
    primitive: &WorldPrimitive,
    index: u32,
    sheared: &mut PacketShear,
    found: &mut PacketCrossings,
) {
    let SurfaceQuery { packet, wanted, departures } = *asked;
    (found.any, found.uncertain, found.entering) = (0, 0, 0);
    simd.vectorize(
        #[inline(always)]
        || {
            let (here, inward) = departures.map_or((0, 0), |d| d.here(simd, index));
            let asking = SurfaceRays { packet, form: &primitive.form, index, here, inward, departures };
            match &primitive.form {
                WorldShape::Face(face) => asking.polygon(simd, face, wanted, sheared, found),
                WorldShape::Patch(patch) => asking.polygon(simd, &patch.face, wanted, sheared, found),
                WorldShape::Tube(tube) => asking.tube(simd, tube, wanted, found),
                WorldShape::Bezier(_) => found.uncertain = wanted,
                _ => {}
            }
        },
    );
    let mut rest = std::mem::take(&mut found.uncertain);
    while rest != 0 {
        let lane = rest.trailing_zeros() as usize;
        rest &= rest - 1;
        let departure = departures.map(|d| d.get(lane));
        let ray = packet.ray(lane);
        if let Some(c) = first_of_surface(&ray, primitive, index, departure, &mut Meter::new(Silent)) {
            found.set(lane, &c);
        }
    }
}

/// Those of a register among some rays of a packet.
#[inline(always)]
fn rays_of_row<S: Simd>(simd: S, register: usize, rays: u64) -> mask64x8<S> {
    mask64x8::from_bitmask(simd, rays >> (register * LANES) & 0xFF)
}

/// One surface, and the rays of a packet that may meet it.
struct SurfaceRays<'a> {
    packet: &'a RayPacket,
    form: &'a WorldShape,
    index: u32,
    /// The rays that start on it, and which of these go to its inside.
    here: u64,
    inward: u64,
    departures: Option<&'a Departures>,
}

impl SurfaceRays<'_> {
    #[inline(always)]
    fn polygon<S: Simd>(
        &self,
        simd: S,
        face: &Face,
        wanted: u64,
        sheared: &mut PacketShear,
        found: &mut PacketCrossings,
    ) {
        sheared.know(simd, self.packet);
        // A plane is not met again by a ray that leaves it.
        let wanted = wanted & !self.here;
        self.polygon_along::<S, 0>(simd, face, wanted, sheared, found);
        self.polygon_along::<S, 1>(simd, face, wanted, sheared, found);
        self.polygon_along::<S, 2>(simd, face, wanted, sheared, found);
    }

    /// For the rays that go farthest along axis `MAIN`.
    #[inline(always)]
    fn polygon_along<S: Simd, const MAIN: usize>(
        &self,
        simd: S,
        face: &Face,
        wanted: u64,
        sheared: &PacketShear,
        found: &mut PacketCrossings,
    ) {
        let rays = wanted & sheared.main(MAIN);
        if rays == 0 {
            return;
        }
        for register in 0..REGISTERS {
            let asking = rays_of_row(simd, register, rays);
            if !asking.any_true() {
                continue;
            }
            let across = sheared.load::<S, MAIN>(simd, self.packet, register);
            let mut around = Around::nothing(simd);
            for (b, corners) in face.stretches() {
                if b.is_none_or(|b| across.may_cross(b)) {
                    across.add(&mut around, corners);
                }
            }
            let mut uncertain = around.uncertain & asking;
            let odd = around.odd & asking & !uncertain;
            if odd.any_true() {
                let SteepCrossings { end, against, steep } =
                    face.steep_crossings(&self.packet.load(simd, register));
                uncertain |= odd & !steep;
                let before = end.t.is_at_most(start_of(
                    end.error,
                    PlaceError::of(self.form),
                    self.place_error(simd, register),
                ));
                let any = odd & steep & !before;
                self.put(simd, register, &FirstCrossings { end, entering: against, any }, found);
            }
            found.uncertain |= uncertain.bits() << (register * LANES);
        }
    }

    #[inline(always)]
    fn tube<S: Simd>(&self, simd: S, tube: &Tube, wanted: u64, found: &mut PacketCrossings) {
        for register in 0..REGISTERS {
            let asking = rays_of_row(simd, register, wanted);
            if asking.any_true() {
                let (here, inward) =
                    (rays_of_row(simd, register, self.here), rays_of_row(simd, register, self.inward));
                let starts = RayStarts { here, inward, place_error: self.place_error(simd, register) };
                let firsts = firsts_of_tube(&self.packet.load(simd, register), tube, self.form, &starts);
                self.put(simd, register, &FirstCrossings { any: firsts.any & asking, ..firsts }, found);
            }
        }
    }

    /// [`super::Departure::place_error`] of eight.
    #[inline(always)]
    fn place_error<S: Simd>(&self, simd: S, register: usize) -> Option<f64x8<S>> {
        self.departures.map(
            #[inline(always)]
            |departures| departures.place_error.load(simd, register),
        )
    }

    /// Notes the first crossings of a register.
    #[inline(always)]
    fn put<S: Simd>(
        &self,
        simd: S,
        register: usize,
        firsts: &FirstCrossings<f64x8<S>>,
        found: &mut PacketCrossings,
    ) {
        let any = firsts.any.bits() << (register * LANES);
        if any == 0 {
            return;
        }
        found.t.store(register, firsts.end.t);
        found.error.store(register, firsts.end.error);
        found.surface.put_ids::<f64, S>(simd, register, any, firsts.end.surface.ids());
        found.primitive.put_ids::<f64, S>(simd, register, any, u32x8::splat(simd, self.index));
        found.any |= any;
        found.entering |= any & firsts.entering.bits() << (register * LANES);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use fearless_simd::Level;
    use proptest::prelude::*;

    use super::*;
    use crate::math::{DAffine3, DVec3, PACKET, Placement, Ray, dispatch};
    use crate::scene::{Corner, MaterialId, Shape};
    use crate::solid::Departure;

    fn point() -> impl Strategy<Value = DVec3> {
        // Round numbers make ties: corners in line with a ray, edges along axes.
        let coordinate = || prop_oneof![-1.0..1.0_f64, (-4..=4_i8).prop_map(|i| f64::from(i) / 4.0)];
        (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    /// Polygons, flat along an axis or as bent as their corners say, and tubes.
    fn shape() -> impl Strategy<Value = Shape> {
        let outline = || {
            (prop::collection::vec(point(), 3..8), 0..4_usize).prop_map(|(mut corners, flat)| {
                for p in &mut corners {
                    if flat < 3 {
                        p[flat] = 0.25;
                    }
                }
                corners
            })
        };
        prop_oneof![
            outline().prop_map(|corners| Shape::Face(corners.into())),
            outline().prop_map(|corners| {
                let corner = |&place: &DVec3| Corner { place, normal: place };
                Shape::Patch(corners.iter().map(corner).collect())
            }),
            (0.0..=1.0).prop_map(|top| Shape::Tube { bottom: 1.0, top }),
            Just(Shape::Tube { bottom: 0.0, top: 1.0 }),
            Just(Shape::Tube { bottom: 1.0, top: 1.0 }),
        ]
    }

    /// A ray at or past what `shape` is made of: `aim` picks one of its points, and a place on the way to
    /// another.
    fn ray_at(shape: &Shape, o: DVec3, (aim, share): (usize, f64), free: DVec3) -> Ray {
        let corners = match shape {
            Shape::Face(corners) => corners.to_vec(),
            Shape::Patch(corners) => corners.iter().map(|corner| corner.place).collect(),
            _ => vec![DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::NEG_ONE],
        };
        let (a, b) = (corners[aim % corners.len()], corners[(aim + 1) % corners.len()]);
        let (from, to) = match aim / 8 {
            0 => (o, a),
            1 => (o, a + (b - a) * share),
            // Along an edge, and so along the plane where the outline is flat.
            2 => (a, b),
            3 => (corners.iter().sum::<DVec3>() / corners.len() as f64, a),
            4 => (o, DVec3::new(o.x, o.y, -2.0)),
            _ => (o, o + free),
        };
        Ray::new(from, (to - from).normalize_or(DVec3::X))
    }

    fn assert_like_alone(
        primitive: &WorldPrimitive,
        rays: &[Ray],
        wanted: u64,
        departures: Option<&Departures>,
    ) -> Result<u32, TestCaseError> {
        let mut packet = RayPacket::EMPTY;
        for (lane, ray) in rays.iter().enumerate() {
            packet.set(lane, ray);
        }
        let mut met = 0;
        for level in [Level::new(), Level::baseline()] {
            let (mut sheared, mut found) = (PacketShear::UNKNOWN, PacketCrossings::NONE);
            dispatch!(level, simd => firsts_of_surface(
                simd, &SurfaceQuery { packet: &packet, wanted, departures }, primitive, 3, &mut sheared, &mut found,
            ));
            prop_assert_eq!((found.uncertain, found.any & !wanted), (0, 0));
            for (lane, ray) in rays.iter().enumerate().filter(|(lane, _)| wanted >> lane & 1 == 1) {
                let departure = departures.map(|d| d.get(lane));
                let alone = first_of_surface(ray, primitive, 3, departure, &mut Meter::new(Silent));
                let together = (found.any >> lane & 1 == 1).then(|| {
                    let numbers = [&found.t, &found.error].map(|column| column.0[lane].to_bits());
                    let ids = [&found.primitive, &found.surface].map(|column| column.0[lane]);
                    (numbers, ids, found.entering >> lane & 1 == 1)
                });
                let alone =
                    alone.map(|c| ([c.t, c.error].map(f64::to_bits), [c.primitive, c.surface], c.entering));
                prop_assert_eq!(together, alone, "{} {:?}", lane, ray);
                met += u32::from(alone.is_some());
            }
        }
        Ok(met)
    }

    fn primitive(shape: &Shape, map: &DAffine3) -> WorldPrimitive {
        let form = WorldShape::new(shape, Placement::new(map).unwrap(), DVec3::splat(1e-15));
        WorldPrimitive { form, material: MaterialId(0) }
    }

    proptest! {
        #[test]
        fn eight_at_a_time_find_what_each_finds_alone(
            shape in shape(),
            turn in (point(), -3.0..3.0_f64),
            aims in prop::collection::vec((point(), (0..48_usize, 0.0..1.0_f64), point()), PACKET),
            wanted in any::<u64>(),
            (here, inward, place_error) in (any::<u64>(), any::<u64>(), 0.0..1e-12_f64),
        ) {
            let map = DAffine3::from_axis_angle(turn.0.normalize_or(DVec3::Z), turn.1);
            let map = if turn.1 > 0.0 { map } else { DAffine3::IDENTITY };
            let primitive = primitive(&shape, &map);
            let rays: Vec<Ray> = aims
                .iter()
                .map(|&(o, aim, free)| ray_at(&shape, o * 3.0, aim, free))
                .map(|ray| Ray::new(map.transform_point3(ray.o), (map.matrix3 * ray.d).normalize()))
                .collect();
            assert_like_alone(&primitive, &rays, wanted, None)?;
            let mut departures = Departures::NONE;
            for lane in 0..PACKET {
                let (primitive, inward) = (2 + (here >> lane & 1) as u32, inward >> lane & 1 == 1);
                departures.set(lane, &Departure { primitive, surface: 0, inward, place_error });
            }
            assert_like_alone(&primitive, &rays, wanted, Some(&departures))?;
        }
    }

    #[test]
    fn outlines_in_groups_are_as_they_are_for_one_ray() {
        let corner = |i: u32| {
            let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 300.0);
            DVec3::new(cos, sin, 0.1 * cos) * if i.is_multiple_of(2) { 1.0 } else { 0.8 }
        };
        let corners: Vec<DVec3> = (0..300).map(corner).collect();
        let primitive = primitive(&Shape::Face(Arc::from(&corners[..])), &DAffine3::IDENTITY);
        let mut met = 0;
        for start in 0..75 {
            let ray = |i: u32| {
                let o = DVec3::new(0.1, 0.2, 3.0);
                Ray::new(o, (corner(start * 4 + i % 8) * (0.8 + 0.04 * f64::from(i / 8)) - o).normalize())
            };
            let rays: Vec<Ray> = (0..64).map(ray).collect();
            met += assert_like_alone(&primitive, &rays, u64::MAX, None).unwrap();
        }
        // Beyond the teeth, and between them, there is nothing.
        assert!((75 * 64..75 * 128).contains(&met), "{met}");
    }
}
