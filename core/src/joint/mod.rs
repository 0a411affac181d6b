//! The joint model: one posterior over whole intents, from every word, the words' presence and the
//! things on the table at once. It stands beside the paper's models, which settle an action first.
//!
//! ```text
//! sentences, sensors ── word ──┐
//! scene, requirements ─ survey ┴─ posterior ── belief ── outcome ── Decision
//! ```
//!
//! * [`word`]: how well an option explains a word, at each of [`LEVELS`] noise levels, with rivals
//!   (options that are raised beside the one that was meant). Whole numbers: see [`cost`].
//! * [`sensors`]: learned confusion tables; without one a plain sensor is assumed. A sensor may also
//!   say by itself how likely what it saw is under each option; nothing of that is noise then.
//! * [`fit`]: how well a thing meets a requirement, as the product of its feature likelihoods; and
//!   how well the words' presence fits an action's signature.
//! * [`survey`]: which actions are weighed, and which things fit them how well. Actions that take a
//!   kind of thing alike share one row of fits.
//! * [`posterior`]: at each [`level`] the posterior is a product of one factor per category, so that
//!   it costs rows times options and never actions times objects times storages.
//! * [`belief`]: the posterior and the noise that was heard, as a confidence that means what it says
//!   on samples of any level, and the cuts that hold wrong executions to a given share.
//!
//! [`Evidence`] stays in the trace after a decision: costs of all options, to which more words can be
//! added ([`Evidence::hear`]) before it is solved again.
//!
//! Limits. The confidence and the cuts are fitted to generated sets; another installation
//! recalibrates (`deictic-eval calibrate`). A word of uncertain category counts by its probability.

use crate::category::{Category, CategorySet};
use crate::decision::Decision;
use crate::math::larger;
use crate::profile::{Profile, ProfileError};
use crate::sentence::{ANSWER, MODALITIES, Word};
use crate::situation::Situation;
use crate::trace::Trace;
use crate::vocabulary::Vocabulary;

pub mod belief;
pub mod calibration;
pub mod cost;
pub mod evidence;
pub mod fit;
pub mod level;
mod likelihoods;
mod outcome;
pub mod posterior;
pub mod sensors;
pub mod survey;
pub mod tables;
pub mod word;

pub use evidence::Evidence;
pub use sensors::{Sensor, Sensors, Tables};

/// Noise levels that a word is weighed at: as measured on real gestures, and normal with standard
/// deviation 0.2, 0.4 and 0.6 (the paper, Considered noise levels n1 to n4).
pub const LEVELS: usize = 4;

/// One figure per noise level.
pub type Levels = [f32; LEVELS];

/// Decides by the joint posterior, with the sensors' tables where they are known. Leaves the
/// marginals in the trace's merged words, and what was believed in [`Trace::belief`].
///
/// # Errors
/// [`ProfileError`] when the profile is not sound; the trace is then empty.
#[inline(never)]
pub fn fuse<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    trace: &mut Trace<C, N>,
) -> Result<Decision<C>, ProfileError> {
    profile.check().inspect_err(|_| trace.clear())?;
    let Situation {
        vocabulary,
        scene,
        observations,
        sensors,
    } = situation;
    trace.restart(vocabulary.options());
    trace.belief = belief::Belief::NONE;
    let Trace {
        categories,
        alpha,
        beta,
        evidence,
        ..
    } = trace;
    evidence.restart();
    for (word, &options) in categories.iter_mut().zip(vocabulary.options()) {
        word.options = options;
        word.present = 0.0;
        word.quantity = None;
    }
    let used = vocabulary.options().len();
    let mut said = [[None; C]; MODALITIES];
    for sentence in observations.iter() {
        if sentence.modality() == ANSWER {
            for q in sentence.words().iter().filter_map(Word::category) {
                if let Some(word) = categories.get_mut(q.index()) {
                    word.present = 1.0;
                }
                evidence.note_answer(q);
            }
            continue;
        }
        let Some(said) = said.get_mut(usize::from(sentence.modality())) else {
            continue;
        };
        let mut present = [0.0; C];
        let (Some(said), Some(present)) = (said.get_mut(..used), present.get_mut(..used)) else {
            continue;
        };
        if !gather(sentence.words(), vocabulary, said, present) {
            continue;
        }
        let mut spoken = CategorySet::EMPTY;
        let traces = categories.iter_mut().zip(&*present).zip(&*said);
        for (q, ((word, p), said)) in traces.enumerate() {
            word.present = larger(word.present, *p);
            if let Some(said) = said {
                spoken = spoken.with(q);
                word.quantity = said.quantity().or(word.quantity);
            }
        }
        evidence.note(present, spoken);
    }
    evidence.survey(vocabulary, scene, alpha, beta);
    for (modality, said) in (0_u8..).zip(&said) {
        for (q, said) in said.iter().enumerate().take(used) {
            if let (Some(category), Some(said)) = (Category::from_index(q), said) {
                evidence.hear(
                    vocabulary,
                    sensors,
                    modality,
                    category,
                    said,
                    profile.weight(modality),
                );
            }
        }
    }
    if let Some(answers) = observations.get(ANSWER) {
        for word in answers.words() {
            if let Some(category) = word.category() {
                let weight = profile.weight(ANSWER);
                evidence.hear(vocabulary, sensors, ANSWER, category, word, weight);
                if let Some(trace) = categories.get_mut(category.index()) {
                    trace.quantity = word.quantity().or(trace.quantity);
                }
            }
        }
    }
    let found = evidence.solve(
        vocabulary,
        sensors,
        observations.confirmations(),
        categories,
    );
    Ok(outcome::outcome(situation, profile, found, trace))
}

/// The words of one modality by category, and how likely each category is present; whether there is
/// any. A word whose likelihoods are all 0 counts here: noise may have clipped it.
fn gather<'a, const C: usize, const N: usize, const F: usize>(
    words: &'a [Word<C, N>],
    vocabulary: &Vocabulary<N, C, F>,
    said: &mut [Option<&'a Word<C, N>>],
    present: &mut [f32],
) -> bool {
    let mut tops = [0.0; C];
    let mut any = false;
    for word in words.iter().filter(|word| !word.likelihoods().is_empty()) {
        any = true;
        let mut likeliest = (0, 0.0);
        for (q, (present, &p)) in present.iter_mut().zip(word.categories()).enumerate() {
            *present = larger(*present, p);
            if p > likeliest.1 {
                likeliest = (q, p);
            }
        }
        let (q, p) = likeliest;
        let options = vocabulary.options().get(q).map(|&n| usize::from(n));
        if let (Some(said), Some(top)) = (said.get_mut(q), tops.get_mut(q))
            && p >= *top
            && options == Some(word.likelihoods().len())
        {
            *top = p;
            *said = Some(word);
        }
    }
    any
}
