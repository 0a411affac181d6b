//! The core's errors in words. The core knows numbers only, so what it names by number is named by
//! number here as well, counted from 1 as people count.

use deictic_core::joint::calibration::RISKS;
use deictic_core::profile::ProfileError;
use deictic_core::scene::SceneError;
use deictic_core::sentence::SentenceError;
use deictic_core::vocabulary::VocabularyError;

use super::Advice;

fn nth(place: u8) -> u16 {
    u16::from(place) + 1
}

/// Why a vocabulary was refused.
#[must_use]
pub fn vocabulary_error(error: &VocabularyError) -> Advice {
    match error {
        VocabularyError::NoActions => Advice::new(
            "the vocabulary has no action",
            "add at least one [[action]] table",
        ),
        VocabularyError::TooManyActions { capacity } => Advice::new(
            format!("there are more than {capacity} actions"),
            "leave some out, or use a unit built with larger capacities",
        ),
        VocabularyError::TooManyCategories { capacity } => Advice::new(
            format!("there are more than {capacity} categories"),
            "leave out a [[parameter]], or use a unit built with larger capacities",
        ),
        VocabularyError::TooManyOptions { category, capacity } => Advice::new(
            format!(
                "category {} has more than {capacity} options",
                category.index()
            ),
            "leave some out, or use a unit built with larger capacities",
        ),
        VocabularyError::TooManyFeatures { capacity } => Advice::new(
            format!("there are more than {capacity} features"),
            "leave out features that no action requires, or use a unit built with larger \
             capacities",
        ),
        VocabularyError::UnknownCategory { action } => Advice::new(
            format!(
                "action {} takes a category that does not exist",
                nth(*action)
            ),
            "add the category, or take it out of the action's signature",
        ),
        VocabularyError::Contradiction { action } => Advice::new(
            format!("action {} contradicts itself", nth(*action)),
            "a category is either compulsory or voluntary, a feature either wanted or unwanted",
        ),
        VocabularyError::UnknownFeature { action } => Advice::new(
            format!(
                "action {} requires a feature that does not exist",
                nth(*action)
            ),
            "add the feature to `features`, or take it out of the requirement",
        ),
        VocabularyError::BadStop => Advice::new(
            "the stop action does not exist or needs parameters",
            "name an action without compulsory categories as `stop`",
        ),
    }
}

/// Why a scene was refused.
#[must_use]
pub fn scene_error(error: &SceneError) -> Advice {
    match error {
        SceneError::TooManyEntities { capacity } => Advice::new(
            format!("there are more than {capacity} things in the scene"),
            "leave out what nobody speaks of, or use a unit built with larger capacities",
        ),
        SceneError::UnknownOption { entity } => Advice::new(
            format!(
                "thing {} of the scene is not in the vocabulary",
                nth(*entity)
            ),
            "add it to the vocabulary; scene and vocabulary may not belong together",
        ),
        SceneError::WrongFeatureCount { entity } => Advice::new(
            format!("thing {} has not one value per feature", nth(*entity)),
            "scene and vocabulary do not belong together: send both again",
        ),
        SceneError::BadLikelihood { entity } => Advice::new(
            format!("a feature of thing {} is not in 0..=1", nth(*entity)),
            "likelihoods are numbers from 0 to 1, or true and false",
        ),
        SceneError::BadPosition { entity } => Advice::new(
            format!("the position of thing {} is not finite", nth(*entity)),
            "a position is three numbers in metres in the robot's base frame",
        ),
        SceneError::Duplicate { entity } => Advice::new(
            format!("thing {} is in the scene twice", nth(*entity)),
            "give each of the two a name of its own in the vocabulary",
        ),
    }
}

/// Why a sentence was refused.
#[must_use]
pub fn sentence_error(error: &SentenceError) -> Advice {
    match error {
        SentenceError::TooManyWords { capacity } => Advice::new(
            format!("a sentence has more than {capacity} words"),
            "say less at once",
        ),
        SentenceError::TooLong { capacity } => Advice::new(
            format!("a word has more than {capacity} options or categories"),
            "use a unit built with larger capacities",
        ),
        SentenceError::BadLikelihood { word } => Advice::new(
            format!("a likelihood of word {} is not in 0..=1", nth(*word)),
            "the recogniser must give numbers from 0 to 1",
        ),
        SentenceError::BadCategories { word } => Advice::new(
            format!("the categories of word {} sum to more than 1", nth(*word)),
            "category probabilities sum to at most 1",
        ),
        SentenceError::UnknownCategory { word } => Advice::new(
            format!("word {} is of a category that does not exist", nth(*word)),
            "the recogniser and the unit use different vocabularies: send the vocabulary again",
        ),
        SentenceError::WrongOptionCount { word, options } => Advice::new(
            format!("word {} has not {options} likelihoods", nth(*word)),
            "the recogniser and the unit use different vocabularies: send the vocabulary again",
        ),
        SentenceError::BadQuantity { word } => Advice::new(
            format!("the quantity of word {} is not finite", nth(*word)),
            "give a number, for example 5 cm",
        ),
        SentenceError::UnknownModality { capacity } => Advice::new(
            format!("there are only {capacity} modalities"),
            "number modalities from 0: gesture 0, language 1",
        ),
    }
}

/// Why a profile was refused.
#[must_use]
pub fn profile_error(error: &ProfileError) -> Advice {
    match error {
        ProfileError::Weights => Advice::new(
            "a modality's weight is not in 0..=1000",
            "weights are above 0 and at most 1000; most are 1",
        ),
        ProfileError::SignaturePenalty => Advice::new(
            "the signature penalty is not in 0..=1",
            "take a number above 0 and at most 1; the paper's is 0.2",
        ),
        ProfileError::Lead => Advice::new(
            "the lead is not in 0..1",
            "take a number from 0 to below 1; the paper's is 0.01",
        ),
        ProfileError::LeastH => Advice::new(
            "the least cross-entropy is below 1e-14",
            "take a small number, for example 0.01",
        ),
        ProfileError::FixedThresholds => Advice::new(
            "the fixed thresholds are not in order",
            "clear must be at least unclear, and unclear at least 0; the paper's are 0.25 and 0.11",
        ),
        ProfileError::ModelAndThreshold => Advice::new(
            "the model and the threshold do not go together",
            "the risk threshold is for the joint model, which takes no other but none",
        ),
        ProfileError::Risk => Advice::new(
            format!(
                "a risk is a share of all commands, from {} to below 1",
                RISKS[0]
            ),
            "0.01 is 1 %, one command in a hundred; `deictic-eval calibrate` makes the cuts",
        ),
        ProfileError::Questions => Advice::new(
            "more questions than can be asked",
            "at most 4 questions can be asked about a command; 2 are usual",
        ),
    }
}
