//! Every view has a picture, wherever the eye stands, however large or far the scene.

mod support {
    pub mod agreement;
    pub mod cases;
    pub mod request;
    pub mod sound;
}

mod views {
    mod anywhere;
    mod extremes;
}
