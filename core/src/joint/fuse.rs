//! Gathers what was said, weighs it, and decides.

use super::belief::Belief;
use super::factors::Marginal;
use super::outcome::outcome;
use crate::align::corresponds;
use crate::category::{Category, CategorySet};
use crate::decision::Decision;
use crate::math::larger;
use crate::profile::{Profile, ProfileError};
use crate::sentence::{ANSWER, MODALITIES, Word};
use crate::situation::Situation;
use crate::trace::{CategoryTrace, Trace};

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
    trace.belief = Belief::NONE;
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
    let mut said = [[None; MODALITIES]; C];
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
        let mut present = [0.0; C];
        let Some(present) = present.get_mut(..used) else {
            continue;
        };
        let modality = usize::from(sentence.modality());
        let words = sentence.words().iter().enumerate();
        let words = words.filter(|(place, word)| {
            let align = profile.align;
            !word.likelihoods().is_empty() && corresponds(observations, align, modality, *place)
        });
        let words = words.map(|(_, word)| word);
        let Some(spoken) = gather(words, modality, vocabulary.options(), &mut said, present) else {
            continue;
        };
        for ((word, p), said) in categories.iter_mut().zip(&*present).zip(&said) {
            word.present = larger(word.present, *p);
            if let Some(said) = said.get(modality).copied().flatten() {
                word.quantity = said.quantity().or(word.quantity);
            }
        }
        evidence.note(present, spoken);
    }
    evidence.survey(vocabulary, scene, alpha, beta);
    for (q, said) in said.iter().enumerate().take(used) {
        let Some(category) = Category::from_index(q) else {
            continue;
        };
        for (modality, said) in (0_u8..).zip(said) {
            if let Some(said) = said {
                let weight = profile.weight(modality);
                evidence.hear(vocabulary, sensors, modality, category, said, weight);
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
    let found = match &mut categories[..] {
        [action, object, storage, others @ ..] => evidence.solve(
            vocabulary,
            sensors,
            observations.confirmations(),
            [marginal(action), marginal(object), marginal(storage)],
            others.iter_mut().map(marginal),
        ),
        _ => None,
    };
    Ok(outcome(situation, profile, found, trace))
}

/// Where a category's marginal goes.
fn marginal<const N: usize>(word: &mut CategoryTrace<N>) -> Marginal<'_> {
    let (of, weights) = word.merged_and_h();
    Marginal { of, weights }
}

/// The words of one modality by category, and how likely each category is present; the categories
/// that there are words of, `None` when there is no word at all. A word whose likelihoods are all 0
/// counts here: noise may have clipped it.
fn gather<'a, const C: usize, const N: usize>(
    words: impl Iterator<Item = &'a Word<C, N>>,
    modality: usize,
    options: &[u8],
    said: &mut [[Option<&'a Word<C, N>>; MODALITIES]; C],
    present: &mut [f32],
) -> Option<CategorySet> {
    let mut spoken = None;
    for word in words {
        let spoken = spoken.get_or_insert(CategorySet::EMPTY);
        let (q, p) = likeliest(word.categories(), present);
        let place = said.get_mut(q).and_then(|said| said.get_mut(modality));
        if let (Some(said), Some(&options)) = (place, options.get(q))
            && usize::from(options) == word.likelihoods().len()
            && said.is_none_or(|before| p >= of(before, q))
        {
            *said = Some(word);
            *spoken = spoken.with(q);
        }
    }
    spoken
}

/// How likely a word is of a category.
fn of<const C: usize, const N: usize>(word: &Word<C, N>, q: usize) -> f32 {
    word.categories().get(q).copied().unwrap_or(0.0)
}

/// The likeliest of a word's categories, which is noted as far as it makes each likely to be present.
#[inline(never)]
fn likeliest(categories: &[f32], present: &mut [f32]) -> (usize, f32) {
    let mut likeliest = (0, 0.0);
    for (q, (present, &p)) in present.iter_mut().zip(categories).enumerate() {
        if p > 0.0 {
            *present = larger(*present, p);
            if p > likeliest.1 {
                likeliest = (q, p);
            }
        }
    }
    likeliest
}
