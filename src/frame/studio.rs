//! A scene made ready for pictures.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use fearless_simd::Level;

use crate::lattice::{Bvh8, Lattice, OverBudget, Structure, SubLattices, Tree};
use crate::math::DVec3;
use crate::plan::StructureChoice;
use crate::scene::{Camera, Scene};
use crate::solid::{Assembly, AssemblyError};
use crate::stage::Progress;
use crate::view::{Turntable, framed, framed_from};

use super::frame_cache::FrameCache;
use super::scratch_pool::ScratchPool;

/// A scene made ready: its solids are put together once, its lattice is built when a picture first wants it,
/// and all pictures share both.
#[derive(Debug)]
pub struct Studio {
    scene: Scene,
    pub(super) progress: Progress,
    pub(super) assembly: Assembly,
    assembling: Duration,
    level: Level,
    lattice: OnceLock<(Result<Lattice, OverBudget>, Duration)>,
    tree: OnceLock<(Tree, Duration)>,
    boxes: OnceLock<(Bvh8, Duration)>,
    subs: OnceLock<(SubLattices, Duration)>,
    /// The workers of the last picture, kept while the number of threads stays the same.
    workers: Mutex<Option<Workers>>,
    pub(super) kept: Mutex<Option<FrameCache>>,
    pub(super) spare: ScratchPool,
}

type Workers = (usize, Arc<rayon::ThreadPool>);

/// What was built, and how long it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Built {
    /// Putting the solids together.
    pub assembling: Duration,
    /// Building lattice, tree, boxes and sub-lattices, as far as they were wanted.
    pub cutting: Duration,
}

impl Studio {
    /// Makes a scene ready. Fails for solids that no reader gives.
    pub fn new(scene: Scene) -> Result<Self, AssemblyError> {
        Self::watched(scene, Progress::default())
    }

    /// The same, where `progress` says how far this is, and how far each picture.
    pub fn watched(scene: Scene, progress: Progress) -> Result<Self, AssemblyError> {
        let start = Instant::now();
        let assembly = Assembly::watched(&scene, &progress)?;
        let assembling = start.elapsed();
        Ok(Self {
            scene,
            progress,
            assembly,
            assembling,
            level: Level::new(),
            lattice: OnceLock::new(),
            tree: OnceLock::new(),
            boxes: OnceLock::new(),
            subs: OnceLock::new(),
            workers: Mutex::new(None),
            kept: Mutex::new(None),
            spare: ScratchPool::default(),
        })
    }

    /// The same studio, where the fast engine runs at another SIMD width than the widest that this processor
    /// has: to see that the pictures are the same.
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The SIMD width of the fast engine.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Puts another scene in the place of this one. Where it has the same solids ([`Scene::has_solids_of`]),
    /// as after a change of lights, materials or world, nothing is put together or cut anew, and pictures of
    /// a view that was drawn before take over what their rays from the eye met; else all is made anew, as by
    /// [`Studio::new`], whose errors leave the studio as it was.
    ///
    /// ```
    /// # use ray13::{frame::Studio, scene::{self, ReadOptions}};
    /// let mut studio = Studio::new(scene::read("ball.csg", b"sphere(1);", &ReadOptions::default())?)?;
    /// let mut scene = studio.scene().clone();
    /// scene.materials[0].kr = 0.3;
    /// studio.set_scene(scene)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_scene(&mut self, scene: Scene) -> Result<(), AssemblyError> {
        if self.scene.has_solids_of(&scene) {
            self.assembly.take_materials(&scene);
            if let Some(kept) = self.kept.get_mut().unwrap_or_else(PoisonError::into_inner) {
                kept.forget_light();
            }
            self.scene = scene;
        } else {
            let new = Self::watched(scene, self.progress.clone())?;
            let (workers, spare) = (std::mem::take(&mut self.workers), std::mem::take(&mut self.spare));
            *self = Self { level: self.level, workers, spare, ..new };
        }
        Ok(())
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Where it can be read how far a picture is that is being drawn.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// What was built so far.
    pub fn built(&self) -> Built {
        let times = [
            self.lattice.get().map(|(_, time)| *time),
            self.tree.get().map(|(_, time)| *time),
            self.boxes.get().map(|(_, time)| *time),
            self.subs.get().map(|(_, time)| *time),
        ];
        Built { assembling: self.assembling, cutting: times.into_iter().flatten().sum() }
    }

    /// The camera of a view of the scene, by its index; the framing from the scene's bounds where it has none
    /// or `index` is past the last. `aspect` is the width of the picture divided by its height, on the
    /// screen.
    pub fn camera(&self, index: usize, aspect: f64) -> Camera {
        self.scene.views.get(index).cloned().unwrap_or_else(|| self.framed(aspect))
    }

    /// A camera that sees the whole scene.
    pub fn framed(&self, aspect: f64) -> Camera {
        if self.assembly.objects.is_empty() {
            // Nothing to see, from anywhere: as if a unit ball stood at the origin.
            return framed(DVec3::length, aspect);
        }
        framed(|v| self.assembly.support(v), aspect)
    }

    /// A camera that sees the whole scene from a side: `back` is the direction from the scene to the eye, and
    /// `up` is upwards in the picture. That of [`Studio::framed`] where these are no directions, or one.
    pub fn framed_from(&self, back: DVec3, up: DVec3, aspect: f64) -> Camera {
        let largest = |v: DVec3| v.abs().max_element();
        // Scaled first, so that no square overflows or vanishes.
        let [back, up] = [back, up].map(|v| (v / largest(v)).normalize());
        // Their product has the sine of the angle between them as its length; below, none of its digits
        // holds.
        if !(back.is_finite() && up.is_finite() && back.cross(up).length() > f64::EPSILON) {
            return self.framed(aspect);
        }
        if self.assembly.objects.is_empty() {
            return framed_from(back, up, DVec3::length, aspect);
        }
        framed_from(back, up, |v| self.assembly.support(v), aspect)
    }

    /// A turntable through the middle of the scene's bounds, whose axis is along `up`.
    pub fn turntable(&self, up: DVec3) -> Turntable {
        if self.assembly.objects.is_empty() {
            return Turntable::new(DVec3::ZERO, up);
        }
        let middle = |axis: DVec3| 0.5 * (self.assembly.support(axis) - self.assembly.support(-axis));
        Turntable::new(DVec3::new(middle(DVec3::X), middle(DVec3::Y), middle(DVec3::Z)), up)
    }

    /// A camera that sees the whole scene at any place of a turntable.
    pub fn framed_turning(&self, turntable: &Turntable, aspect: f64) -> Camera {
        if self.assembly.objects.is_empty() {
            return self.framed(aspect);
        }
        framed(|v| turntable.swept_support(|v| self.assembly.support(v), v), aspect)
    }

    /// The lattice, built now if it was not before; else why there is none.
    pub fn lattice(&self) -> Result<&Lattice, OverBudget> {
        let (lattice, _) = self.lattice.get_or_init(|| timed(|| Lattice::new(&self.assembly)));
        lattice.as_ref().map_err(|&e| e)
    }

    /// The tree, built now if it was not before.
    pub fn tree(&self) -> &Tree {
        &self.tree.get_or_init(|| timed(|| Tree::new(&self.assembly))).0
    }

    /// The boxes around boxes, built now if they were not before.
    pub fn boxes(&self) -> &Bvh8 {
        &self.boxes.get_or_init(|| timed(|| Bvh8::new(&self.assembly))).0
    }

    /// How space is cut for a plan, and why that is not the lattice that the plan wants.
    pub(super) fn structure(&self, choice: StructureChoice) -> (Structure<'_>, Option<OverBudget>) {
        if choice == StructureChoice::None {
            return (Structure::None, None);
        }
        let subs =
            &self.subs.get_or_init(|| timed(|| SubLattices::watched(&self.assembly, &self.progress))).0;
        match choice {
            StructureChoice::Tree => return (Structure::Tree(self.tree(), subs), None),
            StructureChoice::Boxes => return (Structure::Boxes(self.boxes(), subs), None),
            _ => {}
        }
        match self.lattice() {
            Ok(lattice) => (Structure::Lattice(lattice, subs), None),
            Err(over) => (Structure::Tree(self.tree(), subs), Some(over)),
        }
    }

    /// Workers for a number of threads, 0 for one per processor. Where threads can not be had, the caller's
    /// alone.
    pub(super) fn workers(&self, threads: usize) -> Option<Arc<rayon::ThreadPool>> {
        let mut kept = self.workers.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pool)) = kept.as_ref().filter(|(number, _)| *number == threads) {
            return Some(Arc::clone(pool));
        }
        let pool = Arc::new(rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok()?);
        *kept = Some((threads, Arc::clone(&pool)));
        Some(pool)
    }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed())
}
