//! What `trade` measures: that it finds faults, says how large they are, and knows how well it knows.

mod support {
    pub mod request;
}

mod trade {
    mod defaults;
    mod faults;
    mod reference;
    mod sweep;

    use std::time::Instant;

    use ray13::frame::{Request, Studio};
    use ray13::math::Size;
    use ray13::scene::{ReadOptions, embedded, read};
    use ray13::stage::GiveUp;
    use ray13::trade::{EyeDistance, Reference, ReferenceGoal};

    use crate::support::request::request;

    /// A scene inside.
    pub fn inside(name: &str) -> Studio {
        let scene = embedded().iter().find(|scene| scene.name == name).unwrap();
        given(scene.text)
    }

    /// A scene from its text.
    pub fn given(text: &str) -> Studio {
        Studio::new(read("given.scene", text.as_bytes(), &ReadOptions::default()).unwrap()).unwrap()
    }

    /// A picture of 2 × 4 square dots to a cell.
    pub fn picture(studio: &Studio, dots: Size) -> Request {
        request(studio.camera(0, f64::from(dots.width) / f64::from(dots.height)), dots)
    }

    /// A reference of so many rays a dot.
    pub fn reference(studio: &Studio, base: &Request, rays: u32) -> Reference {
        let goal = ReferenceGoal { apart: 0.01, rays: Some(rays), until: Instant::now() };
        Reference::new(studio, base, &goal, EyeDistance::default(), &GiveUp::never()).unwrap()
    }
}
