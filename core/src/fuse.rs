//! The whole method on one set of observations (the paper, Proposed solution): align, merge, check
//! feasibility, decide.
//!
//! On a Cortex-M4F one M3 decision over the paper's vocabulary stays below 12,000 instructions; the
//! golden figures are in `tests/expected/`.

use serde::{Deserialize, Serialize};

use crate::align;
use crate::category::Category;
use crate::decide::{Decision, decide};
use crate::entropy;
use crate::feasibility::{alignment, alpha, signature_mismatch};
use crate::judgement::{Judgement, judge};
use crate::math;
use crate::merge::{Mix, mix_in, penalise};
use crate::profile::{BetaScope, Missing, Model, Presence, Profile, ProfileError, Threshold};
use crate::reference;
use crate::scene::Scene;
use crate::sentence::{GESTURE, LANGUAGE, Observations, SentenceError, Word};
use crate::trace::{CategoryTrace, Trace};
use crate::vocabulary::{Action, Vocabulary};

/// Why nothing could be decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FuseError {
    /// A sentence does not fit the vocabulary.
    Sentence {
        /// Which modality's.
        modality: u8,
        /// What is wrong with it.
        error: SentenceError,
    },
    /// The profile cannot be.
    Profile(ProfileError),
}

/// All that one decision looks at, besides the profile.
#[derive(Clone, Copy)]
pub struct Situation<
    'a,
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
> {
    /// What can be said.
    pub vocabulary: &'a Vocabulary<N, C, F>,
    /// What is there.
    pub scene: &'a Scene<E, F>,
    /// What was said and shown.
    pub observations: &'a Observations<W, C, N>,
}

/// Decides with the profile's own mixing operator; see [`fuse_with`].
///
/// # Errors
/// [`FuseError`] when a sentence or the profile is not sound; the trace is then empty.
pub fn fuse<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    trace: &mut Trace<C, N>,
) -> Result<Decision<C>, FuseError> {
    fuse_with(situation, profile, &profile.merge, trace)
}

/// Decides with any mixing operator, and leaves in `trace` why.
///
/// # Errors
/// [`FuseError`] when a sentence or the profile is not sound; the trace is then empty.
pub fn fuse_with<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    mix: &impl Mix,
    trace: &mut Trace<C, N>,
) -> Result<Decision<C>, FuseError> {
    trace.clear();
    profile.check().map_err(FuseError::Profile)?;
    let Situation {
        vocabulary,
        scene,
        observations,
    } = situation;
    for sentence in observations.iter() {
        sentence
            .check(vocabulary)
            .map_err(|error| FuseError::Sentence {
                modality: sentence.modality(),
                error,
            })?;
    }
    for (q, &options) in vocabulary.options().iter().enumerate() {
        let (Some(category), Some(word)) =
            (Category::from_index(q), trace.categories_mut().get_mut(q))
        else {
            break;
        };
        word.options = options;
        let spoken = merge_category(situation, category, profile, mix, word);
        word.present = match profile.presence {
            Presence::Probability => align::presence(observations, category),
            Presence::Sum(least) => f32::from(u8::from(visible(observations, category, least))),
        };
        if spoken && profile.threshold.is_relative() {
            entropy::normalise(word.merged_and_h().0);
        }
        if spoken && category != Category::ACTION {
            settle(category, profile, word);
        }
    }
    weigh_actions(vocabulary, scene, profile, trace);
    Ok(decide(vocabulary, scene, profile, trace))
}

/// Mixes all modalities' words of one category into `word.merged`; whether there was any.
fn merge_category<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
>(
    situation: Situation<'_, N, C, F, E, W>,
    category: Category,
    profile: &Profile,
    mix: &impl Mix,
    word: &mut CategoryTrace<N>,
) -> bool {
    let observations = situation.observations;
    let mut buffer = [0.0; N];
    let mut spoken = false;
    let mut mixed = false;
    for sentence in observations.iter() {
        let modality = sentence.modality();
        let (merged, h) = word.merged_and_h();
        let Some(said) = align::word_of(sentence, category) else {
            if profile.missing == Missing::Zero {
                let zeros = buffer.get_mut(..merged.len()).unwrap_or_default();
                zeros.fill(0.0);
                mix_in(merged, zeros, 1.0, !mixed, mix);
                mixed = true;
            }
            continue;
        };
        let Some((scratch, _)) = buffer.split_at_mut_checked(merged.len()) else {
            continue;
        };
        for (to, from) in scratch.iter_mut().zip(said.likelihoods()) {
            *to = *from;
        }
        if profile.reference_quirks {
            soften_one_hot(situation, category, modality, scratch);
        }
        if profile.penalised {
            penalise(scratch, h, profile.least_h);
        }
        mix_in(merged, scratch, profile.weight(modality), !mixed, mix);
        word.quantity = said.quantity().or(word.quantity);
        mixed = true;
        spoken = true;
    }
    if !spoken {
        word.merged_and_h().0.fill(0.0);
    }
    spoken
}

/// The reference's preprocessing of one-hot language words; rare in data, as they arise by clipping
/// only.
fn soften_one_hot<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
>(
    situation: Situation<'_, N, C, F, E, W>,
    category: Category,
    modality: u8,
    word: &mut [f32],
) {
    let language = situation.observations.get(LANGUAGE);
    let hot = language
        .and_then(|s| align::word_of(s, category))
        .is_some_and(|w| reference::is_one_hot(w.likelihoods()));
    if !hot {
        return;
    }
    let there =
        |i: usize| u8::try_from(i).is_ok_and(|i| situation.scene.find(category, i).is_some());
    match (category, modality) {
        (Category::ACTION, LANGUAGE) => reference::lift(word, |_| true),
        (Category::OBJECT, LANGUAGE) => reference::lift(word, there),
        (Category::OBJECT, GESTURE) => reference::stretch(word, there),
        _ => {}
    }
}

/// Whether one modality's likelihoods of this category sum to more than `least`.
fn visible<const W: usize, const C: usize, const N: usize>(
    observations: &Observations<W, C, N>,
    category: Category,
    least: f32,
) -> bool {
    observations
        .iter()
        .filter_map(|sentence| align::word_of(sentence, category))
        .any(|word: &Word<C, N>| word.likelihoods().iter().sum::<f32>() > least)
}

/// Judges the options of a merged word.
fn settle<const N: usize>(category: Category, profile: &Profile, word: &mut CategoryTrace<N>) {
    let (merged, h) = word.merged_and_h();
    if profile.reference_quirks {
        reference::boost(merged, category, profile.merge);
    }
    let entropy = entropy::diagonal_cross_entropy(merged, h);
    let (judgement, threshold) = judge(merged, h, entropy, profile.threshold);
    word.entropy = entropy;
    word.threshold = threshold;
    word.judgement = judgement;
}

/// Applies alpha and beta to the merged action word (eq. 5) and judges it.
fn weigh_actions<const N: usize, const C: usize, const F: usize, const E: usize>(
    vocabulary: &Vocabulary<N, C, F>,
    scene: &Scene<E, F>,
    profile: &Profile,
    trace: &mut Trace<C, N>,
) {
    let mut present = [0.0; C];
    for (p, word) in present.iter_mut().zip(trace.categories()) {
        *p = word.present;
    }
    let ln_penalty = math::ln(profile.signature_penalty);
    let mut judged = [Judgement::NOTHING; 2];
    for (judgement, category) in judged.iter_mut().zip([Category::OBJECT, Category::STORAGE]) {
        if let Some(word) = trace.category(category) {
            *judgement = word.judgement;
        }
    }
    if let Some(word) = trace.category(Category::ACTION) {
        trace.heard = word.merged;
    }
    let factors = trace.alpha.iter_mut().zip(trace.beta.iter_mut());
    for ((alpha_a, beta_a), action) in factors.zip(vocabulary.actions()) {
        if matches!(profile.model, Model::M2 | Model::M3) {
            *alpha_a = alpha(signature_mismatch(action.signature, &present), ln_penalty);
        }
        if profile.model == Model::M3 {
            *beta_a = beta(action, scene, profile.beta, judged);
        }
    }
    let (alphas, betas) = (trace.alpha, trace.beta);
    let Some(word) = trace.categories_mut().first_mut() else {
        return;
    };
    let (merged, _) = word.merged_and_h();
    if merged.iter().all(|&w| w <= 0.0) {
        return;
    }
    for ((w, a), b) in merged.iter_mut().zip(alphas).zip(betas) {
        *w *= a * b;
    }
    if profile.threshold.is_relative() && !profile.reference_quirks {
        entropy::normalise(merged);
    }
    settle(Category::ACTION, profile, word);
}

/// beta of eq. 10: how well the best fitting things in question meet an action's requirements.
fn beta<const F: usize, const E: usize>(
    action: &Action,
    scene: &Scene<E, F>,
    scope: BetaScope,
    judged: [Judgement; 2],
) -> f32 {
    let mut product = 1.0;
    for (judgement, category) in judged.iter().zip([Category::OBJECT, Category::STORAGE]) {
        if action.signature.compulsory.contains(category.index()) {
            let requirement = action.requirement(category);
            // When no option is clear nothing is ruled out, and anything there may be meant.
            let any = scope == BetaScope::Any || judgement.clear == 0;
            product *= scene
                .entities()
                .iter()
                .filter(|e| e.category == category && (any || judgement.is_clear(e.option)))
                .fold(0.0, |best, e| {
                    f32::max(best, alignment(requirement, &e.features))
                });
        }
    }
    product
}

/// Whether a word alone clearly says one option, with nothing else to draw on: used for `stop`,
/// which does not wait for other modalities.
#[must_use]
pub fn says_clearly<const C: usize, const N: usize>(
    word: &Word<C, N>,
    category: Category,
    option: u8,
    profile: &Profile,
) -> bool {
    if word.category() != Some(category) || !word.is_present() {
        return false;
    }
    let mut p = [0.0; N];
    let mut h = [0.0; N];
    let n = word.likelihoods().len().min(N);
    let (Some((p, _)), Some((h, _))) = (p.split_at_mut_checked(n), h.split_at_mut_checked(n))
    else {
        return false;
    };
    for (to, from) in p.iter_mut().zip(word.likelihoods()) {
        *to = *from;
    }
    entropy::normalise(p);
    let entropy = entropy::diagonal_cross_entropy(p, h);
    let (judgement, _) = judge(p, h, entropy, Threshold::Entropy);
    judgement.clear.count_ones() == 1 && judgement.decided(profile.lead) == Some(option)
}
