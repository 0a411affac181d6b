//! Decisions made here, by the code that a unit runs.

use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Tables;
use deictic_core::large::{Decision, Intent, Observations, Scene, Sentence, Trace};
use deictic_core::profile::{Model, Profile};

use crate::explain::{self, Advice};
use crate::vocabulary::Lexicon;

/// Decides on at most one sentence per modality, the later among several, and leaves in `trace` why;
/// with `sensors` where these are known.
///
/// # Errors
/// [`Advice`] when a sentence does not fit the vocabulary, or the profile cannot be.
pub fn decide<'s>(
    sentences: impl IntoIterator<Item = &'s Sentence>,
    scene: &Scene,
    lexicon: &Lexicon,
    profile: &Profile,
    sensors: Tables<'_>,
    trace: &mut Trace,
) -> Result<Decision, Advice> {
    let mut observations = Observations::new();
    for sentence in sentences {
        observations
            .insert(sentence.clone(), lexicon.vocabulary())
            .map_err(|e| explain::sentence_error(&e))?;
    }
    let situation = Situation {
        vocabulary: lexicon.vocabulary(),
        scene,
        observations: &observations,
        sensors,
    };
    fuse(situation, profile, trace).map_err(|e| explain::profile_error(&e))
}

/// What was heard and seen, before anything is known of what can be done: the likeliest action with
/// the likeliest parameters.
#[must_use]
pub fn heard<'s>(
    sentences: impl IntoIterator<Item = &'s Sentence>,
    lexicon: &Lexicon,
    profile: &Profile,
) -> Option<Intent> {
    let usual = match profile.model {
        // Its threshold is of no use to other models.
        Model::Joint => Profile::PAPER,
        _ => *profile,
    };
    let plain = Profile {
        model: Model::M1,
        guarded: false,
        ..usual
    };
    let mut trace = Box::new(Trace::new());
    let none = Tables::NONE;
    let decision = decide(sentences, &Scene::new(1), lexicon, &plain, none, &mut trace).ok()?;
    decision.best
}
