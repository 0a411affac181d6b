//! A tally for readers.

use serde::Serialize;

use super::Tally;
use crate::interval::wilson;
use crate::variant::Variant;

/// A tally: percentages with 95 % intervals.
#[derive(Clone, Debug, Serialize)]
pub struct Score {
    /// The set.
    pub file: String,
    /// The model, merge, threshold and profile.
    pub model: String,
    /// See [`Variant::merge`].
    pub merge: String,
    /// See [`Variant::threshold`].
    pub threshold: String,
    /// See [`Variant::profile`].
    pub profile: String,
    /// Samples.
    pub n: usize,
    /// The shares, in percent.
    #[serde(flatten)]
    pub shares: Shares<f64>,
    /// Their 95 % intervals (Wilson), in percent.
    pub interval_95: Shares<[f64; 2]>,
}

/// One value per count of a [`Tally`].
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Shares<T> {
    /// See [`Tally::triple_argmax`].
    pub triple_argmax: T,
    /// See [`Tally::action_argmax`].
    pub action_argmax: T,
    /// See [`Tally::triple_decided`].
    pub triple_decided: T,
    /// See [`Tally::action_decided`].
    pub action_decided: T,
    /// See [`Tally::triple_wrong_executed`].
    pub triple_wrong_executed: T,
    /// See [`Tally::action_wrong_executed`].
    pub action_wrong_executed: T,
    /// See [`Tally::undecided`].
    pub undecided: T,
}

impl<T> Shares<T> {
    fn of(tally: &Tally, value: impl Fn(usize) -> T) -> Self {
        Self {
            triple_argmax: value(tally.triple_argmax),
            action_argmax: value(tally.action_argmax),
            triple_decided: value(tally.triple_decided),
            action_decided: value(tally.action_decided),
            triple_wrong_executed: value(tally.triple_wrong_executed),
            action_wrong_executed: value(tally.action_wrong_executed),
            undecided: value(tally.undecided),
        }
    }
}

impl Score {
    /// Of a tally.
    #[must_use]
    pub fn new(file: &str, variant: &Variant, tally: &Tally) -> Self {
        Self {
            file: file.to_owned(),
            model: variant.model.to_string(),
            merge: variant.merge.to_string(),
            threshold: variant.threshold.to_string(),
            profile: variant.profile.to_string(),
            n: tally.n,
            shares: Shares::of(tally, |k| tally.percent(k)),
            interval_95: Shares::of(tally, |k| wilson(k, tally.n)),
        }
    }
}
