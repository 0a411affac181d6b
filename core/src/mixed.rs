//! The paper's models: words are merged by category, an action is settled first (the paper, Proposed
//! solution).

use heapless::Vec;

use crate::align::{Alignment, Slot};
use crate::category::Category;
use crate::decide::decide;
use crate::decision::Decision;
use crate::entropy;
use crate::feasibility::{apply_penalties, weigh_requirements, weigh_signatures};
use crate::joint::belief::Belief;
use crate::judgement::{Judgement, has, judge};
use crate::math;
use crate::merge::{Mix, penalise, weigh};
use crate::profile::{BetaScope, Missing, Model, Presence, Profile, ProfileError};
use crate::reference;
use crate::scene::Scene;
use crate::sentence::{GESTURE, LANGUAGE, Word};
use crate::situation::Situation;
use crate::trace::{CategoryTrace, Trace};
use crate::vocabulary::Vocabulary;

/// The paper's models. Apart, so that the joint model's stack does not hold what they need.
#[inline(never)]
pub(crate) fn mixed<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    mix: &impl Mix,
    trace: &mut Trace<C, N>,
) -> Result<Decision<C>, ProfileError> {
    profile.check().inspect_err(|_| trace.clear())?;
    trace.belief = Belief::NONE;
    let Situation {
        vocabulary,
        scene,
        observations,
        ..
    } = situation;
    let mut aligned = Alignment::NONE;
    aligned.fill(observations, profile.align);
    let mut scratch = [0.0; N];
    trace.restart(vocabulary.options());
    for (q, &options) in vocabulary.options().iter().enumerate() {
        let (Some(category), Some(word)) =
            (Category::from_index(q), trace.categories_mut().get_mut(q))
        else {
            break;
        };
        let slot = aligned.slot(category);
        let spoken = slot.iter().any(Option::is_some);
        let whole = |word: &&Word<C, N>| word.likelihoods().len() == usize::from(options);
        if !(spoken && slot.iter().flatten().all(whole)) {
            // Only whole words write over all that the last decision left.
            *word = CategoryTrace::NONE;
        }
        word.options = options;
        word.quantity = None;
        word.present = match profile.presence {
            Presence::Probability => aligned.presence(category),
            Presence::Sum(least) => f32::from(u8::from(visible(&slot, least))),
        };
        if !spoken {
            continue;
        }
        merge(situation, category, &slot, profile, mix, word, &mut scratch);
        if profile.threshold.is_relative() {
            entropy::normalise(word.merged_and_h().0);
        }
        if category != Category::ACTION {
            settle(category, profile, word);
        }
    }
    weigh_actions(vocabulary, scene, profile, trace);
    Ok(decide(vocabulary, scene, profile, trace))
}

/// Mixes the words of one category, of which there is at least one, into `word.merged`.
fn merge<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    category: Category,
    slot: &Slot<'_, C, N>,
    profile: &Profile,
    mix: &impl Mix,
    word: &mut CategoryTrace<N>,
    scratch: &mut [f32; N],
) {
    let mut first = true;
    for (modality, &said) in (0_u8..).zip(slot) {
        let silent =
            || profile.missing == Missing::Skip || situation.observations.get(modality).is_none();
        if said.is_none() && silent() {
            continue;
        }
        let (merged, h) = word.merged_and_h();
        let Some((scratch, _)) = scratch.split_at_mut_checked(merged.len()) else {
            return;
        };
        let ready = if first { &mut *merged } else { &mut *scratch };
        match said {
            None => ready.fill(0.0),
            Some(said) => {
                let mut room;
                let mut likelihoods = said.likelihoods();
                if profile.reference_quirks {
                    room = [0.0; N];
                    likelihoods =
                        soften_one_hot(situation.scene, slot, category, modality, said, &mut room);
                }
                if profile.penalised {
                    penalise(likelihoods, h, profile.least_h, ready);
                } else {
                    for (to, from) in ready.iter_mut().zip(likelihoods) {
                        *to = *from;
                    }
                }
            }
        }
        let weight = profile.weight(modality);
        if first {
            weigh(merged, weight);
            first = false;
        } else {
            mix.mix_in(merged, scratch, weight);
        }
        word.quantity = said.and_then(Word::quantity).or(word.quantity);
    }
}

/// The reference's preprocessing of one-hot language words, in `room`; rare in data, as they arise
/// by clipping only.
#[inline(never)]
fn soften_one_hot<'a, const N: usize, const C: usize, const F: usize, const E: usize>(
    scene: &Scene<E, F>,
    slot: &Slot<'_, C, N>,
    category: Category,
    modality: u8,
    word: &'a Word<C, N>,
    room: &'a mut [f32; N],
) -> &'a [f32] {
    let likelihoods = word.likelihoods();
    let said = slot.get(usize::from(LANGUAGE)).copied().flatten();
    if !said.is_some_and(|said| reference::is_one_hot(said.likelihoods())) {
        return likelihoods;
    }
    let Some((softened, _)) = room.split_at_mut_checked(likelihoods.len()) else {
        return likelihoods;
    };
    for (to, from) in softened.iter_mut().zip(likelihoods) {
        *to = *from;
    }
    let there = |i: usize| u8::try_from(i).is_ok_and(|i| scene.find(category, i).is_some());
    match (category, modality) {
        (Category::ACTION, LANGUAGE) => reference::lift(softened, |_| true),
        (Category::OBJECT, LANGUAGE) => reference::lift(softened, there),
        (Category::OBJECT, GESTURE) => reference::stretch(softened, there),
        _ => {}
    }
    softened
}

/// Whether one modality's likelihoods sum to more than `least`.
fn visible<const C: usize, const N: usize>(slot: &Slot<'_, C, N>, least: f32) -> bool {
    let mut words = slot.iter().flatten();
    words.any(|word| word.likelihoods().iter().sum::<f32>() > least)
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
    let used = vocabulary.options().len();
    let present = present.get(..used).unwrap_or(&present);
    // When no option is clear nothing is ruled out, and anything there may be meant.
    let meant = |category| match trace.category(category) {
        Some(word) if profile.beta == BetaScope::Clear && word.judgement.clear != 0 => {
            word.judgement.clear
        }
        _ => u64::MAX,
    };
    let (meant_objects, meant_storages) = (meant(Category::OBJECT), meant(Category::STORAGE));
    let (word, heard, alphas, betas) = trace.actions_mut();
    let Some(word) = word else { return };
    let (merged, _) = word.merged_and_h();
    let actions = vocabulary.actions();
    betas.iter_mut().take(actions.len()).for_each(|b| *b = 1.0);
    if matches!(profile.model, Model::M2 | Model::M3) {
        let ln_penalty = math::ln(profile.signature_penalty);
        weigh_signatures(actions, present, ln_penalty, alphas);
    } else {
        alphas.iter_mut().take(actions.len()).for_each(|a| *a = 1.0);
    }
    if profile.model == Model::M3 {
        let mut objects = Vec::<&[f32], E>::new();
        let mut storages = Vec::<&[f32], E>::new();
        for entity in scene.entities() {
            let (meant, things) = match entity.category {
                Category::OBJECT => (meant_objects, &mut objects),
                _ => (meant_storages, &mut storages),
            };
            if has(meant, entity.option) {
                // There is a place for every thing of a scene.
                let _ = things.push(&entity.features);
            }
        }
        weigh_requirements(actions, Category::OBJECT, &objects, betas);
        weigh_requirements(actions, Category::STORAGE, &storages, betas);
    }
    apply_penalties(merged, heard, alphas, betas);
    if heard.iter().all(|&h| h <= 0.0) {
        word.entropy = 0.0;
        word.threshold = 0.0;
        word.judgement = Judgement::NOTHING;
        if !profile.penalised {
            word.merged_and_h().1.fill(0.0);
        }
        return;
    }
    if profile.threshold.is_relative() && !profile.reference_quirks {
        entropy::normalise(merged);
    }
    settle(Category::ACTION, profile, word);
}
