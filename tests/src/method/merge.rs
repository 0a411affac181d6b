//! METHOD, sections 1 to 3: merged words, alpha and beta.

use deictic_core::board::{Observations, Scene, Vocabulary, Word};
use deictic_core::category::Category;
use deictic_core::merge::Merge;
use deictic_core::profile::{Align, BetaScope, Missing, Model, Presence, Profile};
use deictic_core::sentence::{ANSWER, MODALITIES};
use deictic_core::vocabulary::Requirement;

use super::{Margin, Merged, cross_entropy, decide, is_faint, normalised};

/// What the penalties made of the action word.
pub struct Penalties {
    pub heard: Vec<f64>,
    pub alpha: Vec<f64>,
    pub beta: Vec<f64>,
}

/// What the words at one place of their sentences speak of: the category with the most probability
/// over all modalities but answers.
fn category_at(observations: &Observations, place: usize) -> Option<usize> {
    let sentences = observations.iter().filter(|s| s.modality() != ANSWER);
    let there: Vec<&Word> = sentences
        .filter_map(|s| s.words().get(place))
        .filter(|word| !word.likelihoods().is_empty())
        .collect();
    let sum = |q: usize| -> f32 {
        let p = there.iter().map(|word| word.categories().get(q));
        p.map(|p| p.copied().unwrap_or(0.0)).sum()
    };
    if there.is_empty() {
        return None;
    }
    // Of equals `max_by` takes the last that it sees: the first category.
    let all = (0..Category::LIMIT).rev();
    all.max_by(|&a, &b| sum(a).total_cmp(&sum(b)))
}

/// The words of a modality that say something where they stand.
fn words<'a>(
    observations: &'a Observations,
    profile: &Profile,
    modality: u8,
) -> impl Iterator<Item = &'a Word> {
    let by_place = profile.align == Align::Position && modality != ANSWER;
    let words = observations.get(modality).map_or(&[][..], |s| s.words());
    let words = words.iter().enumerate().filter(move |(place, word)| {
        let own = word.category().map(Category::index);
        word.is_present() && (!by_place || own == category_at(observations, *place))
    });
    words.map(|(_, word)| word)
}

/// The word of one modality that speaks of a category: of several the one likeliest to, the last among equals.
fn spoken<'a>(
    observations: &'a Observations,
    profile: &Profile,
    modality: u8,
    category: Category,
) -> Option<&'a Word> {
    let mut best: Option<(&Word, f32)> = None;
    let words = words(observations, profile, modality);
    for word in words.filter(|word| word.category() == Some(category)) {
        let p = word.categories()[category.index()];
        if best.is_none_or(|(_, least)| p >= least) {
            best = Some((word, p));
        }
    }
    best.map(|(word, _)| word)
}

/// How surely a category was expressed.
fn presence(observations: &Observations, profile: &Profile, category: Category) -> f64 {
    match profile.presence {
        Presence::Probability => (0..MODALITIES as u8)
            .flat_map(|modality| words(observations, profile, modality))
            .filter_map(|word| word.categories().get(category.index()))
            .fold(0.0, |most, &p| f64::max(most, f64::from(p))),
        Presence::Sum(least) => {
            let visible = (0..MODALITIES as u8).any(|modality| {
                spoken(observations, profile, modality, category)
                    .is_some_and(|word| word.likelihoods().iter().sum::<f32>() > least)
            });
            f64::from(u8::from(visible))
        }
    }
}

/// Merges the words of one category.
pub fn category(
    vocabulary: &Vocabulary,
    observations: &Observations,
    profile: &Profile,
    category: Category,
) -> Merged {
    let options = vocabulary.options_of(category);
    let mut merged: Option<Vec<f64>> = None;
    let modalities = || 0..MODALITIES as u8;
    let anyone = modalities().any(|m| spoken(observations, profile, m, category).is_some());
    for modality in modalities().filter(|_| anyone) {
        let word: Vec<f64> = match spoken(observations, profile, modality, category) {
            Some(word) => word.likelihoods().iter().map(|&w| f64::from(w)).collect(),
            None if profile.missing == Missing::Zero && observations.get(modality).is_some() => {
                vec![0.0; options]
            }
            None => continue,
        };
        let said = spoken(observations, profile, modality, category).is_some();
        let word = if profile.penalised && said {
            let epsilon = f64::from(deictic_core::entropy::EPSILON);
            let (_, h) = cross_entropy(&word);
            let least = f64::from(profile.least_h);
            word.iter()
                .zip(h)
                .map(|(w, h)| (w + epsilon) / h.max(least))
                .collect()
        } else {
            word
        };
        let weight = f64::from(profile.weights[usize::from(modality)]);
        let weighted = word.iter().map(|w| w * weight);
        merged = Some(match merged {
            None => weighted.collect(),
            Some(merged) => merged
                .into_iter()
                .zip(weighted)
                .map(|(m, w)| match profile.merge {
                    Merge::Max => m.max(w),
                    Merge::Mul => m * w,
                    Merge::Add => m + w,
                })
                .collect(),
        });
    }
    let mut word = merged.unwrap_or_default();
    let faint = is_faint(&word);
    if profile.threshold.is_relative() {
        word = normalised(&word);
    }
    let (entropy, h) = cross_entropy(&word);
    Merged {
        present: presence(observations, profile, category),
        word,
        h,
        entropy,
        faint,
    }
}

/// alpha and beta of every action, applied to the action word.
pub fn penalise_actions(
    vocabulary: &Vocabulary,
    scene: &Scene,
    profile: &Profile,
    categories: &mut [Merged],
    margin: &mut Margin,
) -> Penalties {
    let mut penalties = Penalties {
        heard: Vec::new(),
        alpha: Vec::new(),
        beta: Vec::new(),
    };
    for action in vocabulary.actions() {
        let mut alpha = 1.0;
        if matches!(profile.model, Model::M2 | Model::M3) {
            let mut mismatch = 0.0;
            for (q, merged) in categories.iter().enumerate().skip(1) {
                if action.signature.compulsory.contains(q) {
                    mismatch += 1.0 - merged.present;
                } else if !action.signature.voluntary.contains(q) {
                    mismatch += merged.present;
                }
            }
            alpha = f64::from(profile.signature_penalty).powf(mismatch);
        }
        let mut beta = 1.0;
        if profile.model == Model::M3 {
            for category in [Category::OBJECT, Category::STORAGE] {
                if action.signature.compulsory.contains(category.index()) {
                    let requirement = action.requirement(category);
                    beta *=
                        best_alignment(scene, profile, categories, category, requirement, margin);
                }
            }
        }
        penalties.alpha.push(alpha);
        penalties.beta.push(beta);
    }
    let actions = &mut categories[0];
    penalties.heard = actions.word.clone();
    for (w, (alpha, beta)) in actions
        .word
        .iter_mut()
        .zip(penalties.alpha.iter().zip(&penalties.beta))
    {
        *w *= alpha * beta;
    }
    actions.faint |= is_faint(&actions.word);
    if profile.threshold.is_relative() {
        actions.word = normalised(&actions.word);
    }
    (actions.entropy, actions.h) = cross_entropy(&actions.word);
    penalties
}

/// How well the best thing of a category that may be meant meets a requirement.
fn best_alignment(
    scene: &Scene,
    profile: &Profile,
    categories: &[Merged],
    category: Category,
    requirement: Requirement,
    margin: &mut Margin,
) -> f64 {
    let clear = match categories.get(category.index()) {
        Some(merged) if profile.beta == BetaScope::Clear => {
            decide::clear(merged, profile.threshold, margin)
        }
        _ => Vec::new(),
    };
    let meant = |option: u8| clear.is_empty() || clear.contains(&usize::from(option));
    scene
        .entities()
        .iter()
        .filter(|thing| thing.category == category && meant(thing.option))
        .map(|thing| alignment(requirement, &thing.features))
        .fold(0.0, f64::max)
}

/// 1 less the largest misalignment of a feature.
pub fn alignment(requirement: Requirement, features: &[f32]) -> f64 {
    let wanted = |k: usize, value: f64| match () {
        () if requirement.wanted.contains(k) => 1.0 - value,
        () if requirement.unwanted.contains(k) => value,
        () => 0.0,
    };
    let worst = (0..32)
        .map(|k| wanted(k, f64::from(features.get(k).copied().unwrap_or(0.0))))
        .fold(0.0, f64::max);
    1.0 - worst
}
