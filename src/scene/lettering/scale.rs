//! The numbers that OpenSCAD's renderer of letters counts in.

/// OpenSCAD draws letters at a size of 10⁵ points, 100 dots to the inch, and takes the result by the 10⁵th
/// part: a text of size 1 is set in a font whose em is 100/72. FreeType has that as 138 889, in 64ths of a
/// dot.
pub const EM: i32 = 138_889;

/// The unit of the coordinates that FreeType gives for that size.
pub const UNIT: f64 = 1e-5;

/// What OpenSCAD 2021.01 takes ways and heights by, but not outlines: it counts 1 024 of FreeType's units to
/// a thousand. Letters stand 2 % closer than in their font.
pub const OF_WAYS: f64 = 1000.0 / 1024.0;
