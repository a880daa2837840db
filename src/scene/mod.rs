//! Stage 1, OBJECTS: text in, [`Scene`] out. Kind, place, size and surface of every solid.

mod model;

pub use model::{
    Anchor, Camera, Facets, HalfSpace, Light, Material, MaterialId, Mesh, Object, Primitive, Scene, Shape,
    Solid, World,
};
