//! What is reported by whom: the table of one sensor, and where it is among all tables.

use crate::category::Category;

/// What a sensor without a table reports of every option but the one that is meant: the middle of
/// the paper's similarity tables, 0.2 to 0.5.
pub const ELSEWHERE: f32 = 0.3;

/// Of what a table is. Where it begins follows from those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    /// Of which modality and category.
    pub key: u8,
    /// How many it has; 0 when there is no table.
    pub options: u8,
    /// Whether it reports likelihoods as they are; a table that it had is kept, unused.
    pub likelihoods: bool,
    /// What is reported of every option but the one that is meant, when that is the same of all.
    pub elsewhere: Option<u8>,
}

impl Place {
    /// Of a table that nothing is known of yet.
    #[inline(always)]
    pub const fn new(modality: u8, category: Category, options: u8) -> Self {
        Self {
            // There are no more than eight modalities and 32 categories.
            key: modality.wrapping_shl(5) | category.index() as u8,
            options,
            likelihoods: false,
            elsewhere: None,
        }
    }
}

/// What the figures of a word are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensor<'a> {
    /// Scores, to be explained by what is reported when an option is meant, and by noise.
    Scores(Rows<'a>),
    /// How likely what was seen is under each option.
    Likelihoods,
}

/// The tables of some [`super::sensors::Sensors`].
#[derive(Clone, Copy, Debug)]
pub struct Tables<'a> {
    places: &'a [Place],
    bytes: &'a [u8],
}

impl<'a> Tables<'a> {
    /// No tables at all.
    pub const NONE: Self = Self {
        places: &[],
        bytes: &[],
    };

    /// Those of these places, one after the other.
    pub(super) fn new(places: &'a [Place], bytes: &'a [u8]) -> Self {
        Self { places, bytes }
    }

    /// The place of a modality's table for a category, and where the table begins.
    #[inline(always)]
    pub(super) fn place(&self, modality: u8, category: Category) -> Option<(&'a Place, usize)> {
        let key = Place::new(modality, category, 0).key;
        let mut start = 0_usize;
        for place in self.places {
            if place.key == key {
                return Some((place, start));
            }
            let options = usize::from(place.options);
            start = start.wrapping_add(options.wrapping_mul(options));
        }
        None
    }

    /// What a modality reports of a category of `options` options.
    #[must_use]
    #[inline(never)]
    pub fn sensor(&self, modality: u8, category: Category, options: usize) -> Sensor<'a> {
        match self.place(modality, category) {
            Some((place, _)) if place.likelihoods => Sensor::Likelihoods,
            place => Sensor::Scores(self.rows_at(place, options)),
        }
    }

    /// The table of a modality for a category of `options` options; that of a plain sensor when there
    /// is none that fits.
    #[must_use]
    pub fn rows(&self, modality: u8, category: Category, options: usize) -> Rows<'a> {
        self.rows_at(self.place(modality, category), options)
    }

    fn rows_at(&self, place: Option<(&Place, usize)>, options: usize) -> Rows<'a> {
        let known = place.filter(|(place, _)| usize::from(place.options) == options);
        let table = known.and_then(|(place, start)| {
            let bytes = self.bytes.get(start..)?;
            let bytes = bytes.get(..options.wrapping_mul(options))?;
            Some((bytes, place.elsewhere))
        });
        let unknown = (&[][..], Some(const { quantise(ELSEWHERE) }));
        let (bytes, elsewhere) = table.unwrap_or(unknown);
        Rows {
            bytes,
            options,
            elsewhere,
        }
    }
}

/// One table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rows<'a> {
    /// Row after row, in 255ths; empty of a sensor that is not known, which reports 255 of what is
    /// meant.
    pub bytes: &'a [u8],
    /// How many options it has.
    pub options: usize,
    /// What is reported of every option but the one that is meant, when that is the same of all.
    pub elsewhere: Option<u8>,
}

impl<'a> Rows<'a> {
    /// What is reported when option `k` is meant; empty of a sensor that is not known.
    #[inline(always)]
    pub(super) fn of(&self, k: usize) -> &'a [u8] {
        let start = k.wrapping_mul(self.options);
        let rest = self.bytes.get(start..).unwrap_or(&[]);
        rest.get(..self.options).unwrap_or(rest)
    }

    /// What stands everywhere but on the diagonal, if that is one value.
    pub(super) fn flat(&self) -> Option<u8> {
        let mut value = None;
        for k in 0..self.options {
            for (_, &byte) in self.of(k).iter().enumerate().filter(|(j, _)| *j != k) {
                if *value.get_or_insert(byte) != byte {
                    return None;
                }
            }
        }
        value
    }
}

/// A likelihood in 255ths.
#[must_use]
#[inline(always)]
pub const fn quantise(likelihood: f32) -> u8 {
    (likelihood * 255.0 + 0.5) as u8
}
