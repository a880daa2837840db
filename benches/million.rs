//! Writes a scene of very many objects as NFF, the same for the same arguments:
//! `cargo run --release --example million -- --objects 1000000 --shape spheres --spread even > million.nff`.
//!
//! `--shape` is `spheres`, `cylinders` or `mixed` (spheres, cylinders and cones), `--spread` is `even` or
//! `clustered`, `--seed` any whole number; those above and a seed of 1 where nothing is said.

mod scenery;

use std::error::Error;
use std::io::{BufWriter, Write, stdout};

use scenery::{Scenery, Shape, Spread};

fn main() -> Result<(), Box<dyn Error>> {
    let scenery = asked_for(std::env::args().skip(1))?;
    let mut out = BufWriter::new(stdout().lock());
    scenery.write(&mut out)?;
    Ok(out.flush()?)
}

fn asked_for(mut arguments: impl Iterator<Item = String>) -> Result<Scenery, Box<dyn Error>> {
    let mut scenery = Scenery { objects: 1_000_000, shape: Shape::Spheres, spread: Spread::Even, seed: 1 };
    while let Some(name) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{name} needs a value"))?;
        match (name.as_str(), value.as_str()) {
            ("--objects", number) => scenery.objects = number.parse()?,
            ("--seed", number) => scenery.seed = number.parse()?,
            ("--shape", "spheres") => scenery.shape = Shape::Spheres,
            ("--shape", "cylinders") => scenery.shape = Shape::Cylinders,
            ("--shape", "mixed") => scenery.shape = Shape::Mixed,
            ("--spread", "even") => scenery.spread = Spread::Even,
            ("--spread", "clustered") => scenery.spread = Spread::Clustered,
            _ => return Err(format!("{name} {value} means nothing here").into()),
        }
    }
    Ok(scenery)
}
