//! How a set was made, by its name, so that more can be observed of its samples.

use rand::Rng;

use crate::catalogue::Catalogue;
use crate::free;
use crate::generate::{self, Kind};
use crate::noise::{Level, Noise};
use crate::record::{Record, Words};
use crate::situation::FeatureForm;

/// How a set was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Maker {
    /// As the paper's sets.
    Paper(Kind, Level),
    /// As [`free`].
    Free(Level),
}

impl Maker {
    /// Of a set with one of the usual names, such as `D_arity_n3`.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        let (kind, level) = name.rsplit_once("_n")?;
        let level = *Level::ALL.get(level.parse::<usize>().ok()?)?;
        if kind == "D_free" {
            return Some(Self::Free(level));
        }
        let kind = Kind::ALL.into_iter().find(|k| k.name() == kind)?;
        Some(Self::Paper(kind, level))
    }

    /// Its noise level.
    #[must_use]
    pub fn level(self) -> Level {
        match self {
            Self::Paper(_, level) | Self::Free(level) => level,
        }
    }

    /// Whether it is the fairer one's.
    #[must_use]
    pub fn is_free(self) -> bool {
        matches!(self, Self::Free(_))
    }

    /// The noise of a modality, of which [`free`] knows two.
    #[must_use]
    pub fn noise(self, modality: usize) -> Noise {
        match self {
            Self::Paper(_, level) => level.into(),
            Self::Free(level) => free::noise(level, modality),
        }
    }

    /// In which form the core sees its features.
    #[must_use]
    pub fn form(self) -> FeatureForm {
        match self {
            Self::Paper(..) => FeatureForm::Sure,
            Self::Free(_) => FeatureForm::Graded,
        }
    }

    /// What a modality observes of what is meant in a sample when all is said once more: the same
    /// rivals with fresh errors.
    #[must_use]
    pub fn words(
        self,
        catalogue: &Catalogue,
        record: &Record,
        modality: usize,
        rng: &mut impl Rng,
    ) -> Words {
        match self {
            Self::Paper(kind, level) => {
                let action = usize::from(record.truth.action);
                let raised = generate::raised(catalogue, kind, record, action);
                let noise = level.into();
                generate::words(catalogue, kind, modality, record.truth, &raised, noise, rng)
            }
            Self::Free(level) => free::words(catalogue, modality, record.truth, level, rng),
        }
    }
}
