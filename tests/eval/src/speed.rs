//! Decisions per second on one core.

use std::hint::black_box;

use cpu_time::ThreadTime;
use deictic_core::board;
use deictic_core::fuse::fuse;
use deictic_core::profile::Profile;

use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::order::Order;
use crate::reading::choice;
use crate::record::CATEGORIES;
use crate::sensing::Sensing;
use crate::situation::{FeatureForm, Prepared};

/// Samples ready to be decided, translated once.
pub struct Track {
    vocabulary: board::Vocabulary,
    sensing: Sensing,
    order: Order,
    samples: Vec<Prepared>,
}

impl Track {
    /// Translates a set.
    ///
    /// # Errors
    /// The core's, for a sample that does not fit.
    pub fn new(set: &Set, catalogue: &Catalogue) -> anyhow::Result<Self> {
        let order = Order::own(catalogue);
        let vocabulary = catalogue.vocabulary(&order);
        let sensing = Sensing::new(catalogue, &order)?;
        let samples = set
            .records
            .iter()
            .map(|r| Prepared::new(r, catalogue, &order, &vocabulary, FeatureForm::Sure))
            .collect::<anyhow::Result<_>>()?;
        Ok(Self {
            vocabulary,
            sensing,
            order,
            samples,
        })
    }

    /// How many samples it has.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    /// Seconds of this thread's own for one pass over all samples, the trace included; time in
    /// which something else had the core does not count.
    #[must_use]
    pub fn pass(&self, profile: &Profile) -> f64 {
        let mut trace = board::Trace::new();
        let started = ThreadTime::now();
        for sample in &self.samples {
            let decision = self
                .sensing
                .decide(sample, &self.vocabulary, profile, &mut trace);
            let _ = black_box(&decision);
        }
        started.elapsed().as_secs_f64()
    }

    /// The settled option of every category, as the catalogue's numbers, -1 for none: the
    /// reference's answers.
    ///
    /// # Errors
    /// The core's.
    pub fn answers(&self, profile: &Profile) -> anyhow::Result<Vec<[i16; CATEGORIES]>> {
        let mut trace = board::Trace::new();
        let mut answers = Vec::with_capacity(self.samples.len());
        for sample in &self.samples {
            fuse(sample.with(&self.vocabulary), profile, &mut trace)
                .map_err(|e| anyhow::anyhow!("the core refuses: {e:?}"))?;
            answers.push(std::array::from_fn(|c| {
                let decided = choice(&trace, c, profile).decided;
                decided.map_or(-1, |o| i16::from(self.order.outside(c, o)))
            }));
        }
        Ok(answers)
    }
}

/// Decisions per second over several tracks: the best of `rounds`, as whatever else runs on the
/// machine can only slow a round down, by emptying caches.
#[must_use]
pub fn per_second(tracks: &[Track], profile: &Profile, rounds: usize) -> f64 {
    let samples: usize = tracks.iter().map(Track::samples).sum();
    let round = || tracks.iter().map(|t| t.pass(profile)).sum::<f64>();
    let best = (0..rounds).map(|_| round()).fold(f64::INFINITY, f64::min);
    samples as f64 / best
}
