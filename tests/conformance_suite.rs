//! What every engine must do, written once: each row below is a test of each engine that is named at the
//! bottom.
//!
//! `RAY13_LONG=1 cargo test --release --test conformance -- --nocapture` runs a hundred times as many cases
//! and prints figures.

mod support {
    pub mod oracle;
}

mod conformance {
    pub mod aim;
    pub mod chance;
    pub mod coincidence;
    pub mod distance;
    pub mod engine;
    pub mod expressions;
    pub mod faults;
    pub mod leaving;
    pub mod long;
    pub mod packets;
    pub mod planes;
    pub mod scale;
    pub mod solids;
    pub mod tally;
}

/// The rows, as tests of one engine.
macro_rules! conformance {
    ($name:ident, $subject:ty) => {
        mod $name {
            use ray13::scene::Shape;

            use crate::conformance::expressions::{laws, random};
            use crate::conformance::{coincidence, distance, leaving, planes, scale, solids};

            #[test]
            fn spheres_at_any_distance() {
                distance::at_any_distance::<$subject>("sphere", &Shape::Sphere, true);
            }

            #[test]
            fn ellipsoids_at_any_distance() {
                distance::at_any_distance::<$subject>("ellipsoid", &Shape::Sphere, false);
            }

            #[test]
            fn cylinders_at_any_distance() {
                distance::at_any_distance::<$subject>("cylinder", &solids::CYLINDER, false);
            }

            #[test]
            fn cones_at_any_distance() {
                distance::at_any_distance::<$subject>("cone", &solids::CONE, false);
            }

            #[test]
            fn truncated_cones_at_any_distance() {
                distance::at_any_distance::<$subject>("truncated cone", &solids::TRUNCATED_CONE, false);
            }

            #[test]
            fn boxes_at_any_distance() {
                distance::at_any_distance::<$subject>("box", &Shape::Cube, false);
            }

            #[test]
            fn prisms_at_any_distance() {
                distance::at_any_distance::<$subject>("prism", &solids::prism(), false);
            }

            #[test]
            fn ellipsoids_of_any_ratio() {
                distance::at_any_ratio::<$subject>("thin ellipsoid", &Shape::Sphere);
            }

            #[test]
            fn cylinders_of_any_ratio() {
                distance::at_any_ratio::<$subject>("thin cylinder", &solids::CYLINDER);
            }

            #[test]
            fn cones_of_any_ratio() {
                distance::at_any_ratio::<$subject>("thin cone", &solids::CONE);
            }

            #[test]
            fn boxes_of_any_ratio() {
                distance::at_any_ratio::<$subject>("thin box", &Shape::Cube);
            }

            #[test]
            fn a_surface_is_left_once() {
                leaving::surfaces_are_left_once::<$subject>();
            }

            #[test]
            fn a_reversed_ray_finds_the_same_ends() {
                leaving::a_reversed_ray_finds_the_same_ends::<$subject>();
            }

            #[test]
            fn one_of_two_abutting_boxes_claims_a_ray() {
                planes::one_of_two_abutting_boxes_claims_a_ray::<$subject>();
            }

            #[test]
            fn faces_are_half_open() {
                planes::faces_are_half_open::<$subject>();
            }

            #[test]
            fn a_union_of_boxes_is_one() {
                planes::a_union_of_boxes_is_one::<$subject>();
            }

            #[test]
            fn a_way_is_blocked_by_the_next_hit() {
                leaving::a_way_is_blocked_by_the_next_hit::<$subject>();
            }

            #[test]
            fn random_surfaces_agree_with_the_oracle() {
                random::random_surfaces_agree_with_the_oracle::<$subject>();
            }

            #[test]
            fn random_patches_agree_with_the_oracle() {
                random::random_patches_agree_with_the_oracle::<$subject>();
            }

            #[test]
            fn a_sponge_is_one_in_any_order() {
                laws::a_sponge_is_one_in_any_order::<$subject>();
            }

            #[test]
            fn the_laws_of_sets_hold() {
                laws::the_laws_of_sets_hold::<$subject>();
            }

            #[test]
            fn random_expressions_agree_with_the_oracle() {
                random::random_expressions_agree_with_the_oracle::<$subject>();
            }

            #[test]
            fn a_picture_is_the_same_at_any_scale() {
                scale::a_picture_is_the_same_at_any_scale::<$subject>();
            }

            #[test]
            fn a_picture_is_the_same_anywhere() {
                scale::a_picture_is_the_same_anywhere::<$subject>();
            }

            #[test]
            fn a_solid_minus_itself_is_nothing() {
                coincidence::a_solid_minus_itself_is_nothing::<$subject>();
            }

            #[test]
            fn a_solid_and_itself_is_the_solid() {
                coincidence::a_solid_and_itself_is_the_solid::<$subject>();
            }

            #[test]
            fn a_flush_hole_is_open() {
                coincidence::a_flush_hole_is_open::<$subject>();
            }

            #[test]
            fn a_flush_hole_is_open_under_other_maps() {
                coincidence::a_flush_hole_is_open_under_other_maps::<$subject>();
            }
        }
    };
}

conformance!(exact, crate::conformance::engine::ExactEngine);
conformance!(fast, crate::conformance::packets::FastEngine);
