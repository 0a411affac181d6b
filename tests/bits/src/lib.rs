//! One number that is the same on every target exactly when every decision is the same, bit for bit.
//!
//! ```
//! use deictic_bits::{Bench, START};
//!
//! let mut bench = Bench::new(); // about 7 KiB; on a board a static
//! let half = bench.hash(START, 0..50);
//! let all = bench.hash(half, 50..100);
//! assert_eq!(all, bench.hash(START, 0..100));
//! ```
//!
//! Sample `i` follows from `i` alone, by integer arithmetic and divisions by powers of two, so that
//! no target can make another. Each is decided by every model, with a merge, a threshold and a
//! family of settings that go round with `i`; hashed are all figures of the trace and all of the
//! decision. [`SAMPLES`] of them must give [`GOLDEN`].
#![no_std]
#![forbid(unsafe_code)]

mod digest;
pub mod growth;
pub mod hand;
pub mod random;
mod sample;
mod sensing;
mod settings;

use core::ops::Range;

use deictic_core::board;
use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Sensors;
use deictic_core::profile::{Model, Profile, ProfileError};

use digest::Digest;
use random::Random;

/// Bytes of the sensors' tables: those of nine actions, seven objects and four storages, twice.
const SENSORS: usize = 2 * (81 + 49 + 16);

/// How many samples [`GOLDEN`] covers; every combination of settings takes part in 416 of them.
pub const SAMPLES: u32 = 15_000;

/// [`Bench::hash`] over all [`SAMPLES`], from [`START`]. A change means that some decision has
/// changed somewhere, if only in its last bit.
pub const GOLDEN: u64 = 0x25e8_a358_2ed9_11f8;

/// Where a hash begins: the offset of FNV-1a.
pub const START: u64 = 0xcbf2_9ce4_8422_2325;

/// Every model.
const MODELS: [Model; 5] = [
    Model::Baseline,
    Model::M1,
    Model::M2,
    Model::M3,
    Model::Joint,
];

/// One situation and the memory to decide on it; at home in a static.
pub struct Bench {
    vocabulary: board::Vocabulary,
    scene: board::Scene,
    observations: board::Observations,
    sensors: Sensors<SENSORS>,
    trace: board::Trace,
}

impl Default for Bench {
    fn default() -> Self {
        Self::new()
    }
}

impl Bench {
    /// An empty bench.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            vocabulary: board::Vocabulary::EMPTY,
            scene: board::Scene::new(0),
            observations: board::Observations::new(),
            sensors: Sensors::new(),
            trace: board::Trace::new(),
        }
    }

    /// Decides the samples in `range` and continues `hash` with every figure that arises, so that a
    /// board can go on in portions and report in between.
    pub fn hash(&mut self, hash: u64, range: Range<u32>) -> u64 {
        let mut digest = Digest(hash);
        for i in range {
            self.sample(i);
            for model in MODELS {
                let profile = settings::profile(i, model);
                let decision = self.decide(&profile);
                digest.trace(&self.trace);
                digest.decision(&decision);
            }
        }
        digest.0
    }

    /// Puts the situation of the instruction budget on the bench: the paper's vocabulary of 9
    /// actions, 7 objects and 4 storages, 8 features, a scene of 5 objects and 3 storages, and a
    /// gesture and a language sentence with all three words. To be decided with
    /// [`Profile::PAPER`], which is M3, or [`Profile::JOINT`], whose sensors are then known.
    pub fn m3_case(&mut self) {
        sample::m3_case(
            &mut self.vocabulary,
            &mut self.scene,
            &mut self.observations,
        );
        sensing::learn(&mut self.sensors, &mut Random::new(0), &self.vocabulary);
    }

    /// Puts a situation of this size on the bench, one of [`growth::DRAWS`]; the sensors are known.
    pub fn sized(&mut self, size: growth::Size, draw: u64) {
        growth::fill(
            size,
            draw,
            &mut self.vocabulary,
            &mut self.scene,
            &mut self.observations,
        );
        sensing::learn(&mut self.sensors, &mut Random::new(draw), &self.vocabulary);
    }

    /// Puts sample `i` on the bench.
    pub fn sample(&mut self, i: u32) {
        sample::fill(
            i,
            &mut self.vocabulary,
            &mut self.scene,
            &mut self.observations,
        );
        self.sensors.clear();
        let mut random = Random::new(u64::from(i));
        if random.one_in(2) {
            sensing::learn(&mut self.sensors, &mut random, &self.vocabulary);
        }
    }

    /// Decides on what is on the bench.
    ///
    /// # Errors
    /// The core's; none for what [`Bench::sample`] and [`Bench::m3_case`] make.
    pub fn decide(&mut self, profile: &Profile) -> Result<board::Decision, ProfileError> {
        let situation = Situation {
            vocabulary: &self.vocabulary,
            scene: &self.scene,
            observations: &self.observations,
            sensors: self.sensors.view(),
        };
        fuse(situation, profile, &mut self.trace)
    }

    /// What can be said on the bench.
    #[must_use]
    pub fn vocabulary(&self) -> &board::Vocabulary {
        &self.vocabulary
    }

    /// What is there on the bench.
    #[must_use]
    pub fn scene(&self) -> &board::Scene {
        &self.scene
    }

    /// What was said and shown on the bench.
    #[must_use]
    pub fn observations(&self) -> &board::Observations {
        &self.observations
    }

    /// The figures of the last decision.
    #[must_use]
    pub fn trace(&self) -> &board::Trace {
        &self.trace
    }
}
