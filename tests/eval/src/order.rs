//! In which order the core sees a catalogue's options. It decides nothing but exact ties, where the
//! first of the best stands.

use crate::catalogue::Catalogue;
use crate::record::CATEGORIES;

/// The reference keeps its names in sets, so ties follow the order in which those were iterated when
/// its answers were recorded.
const REFERENCE: [&[&str]; CATEGORIES] = [
    &[
        "release", "stack", "stop", "pour", "unglue", "put-into", "push", "pick", "move-up",
    ],
    &[
        "bowl",
        "tomato soup can",
        "paper",
        "potted meat can",
        "box",
        "alt box",
        "wrench",
    ],
    &[
        "paper box",
        "abstract marked zone",
        "out of table",
        "on the table",
    ],
];

/// A permutation per category.
#[derive(Clone, Debug)]
pub struct Order {
    /// `places[c][i]` is the catalogue's number of the option that the core calls `i`.
    places: [Vec<u8>; CATEGORIES],
    /// The other way round.
    at: [Vec<u8>; CATEGORIES],
}

impl Order {
    /// The catalogue's own order.
    #[must_use]
    pub fn own(catalogue: &Catalogue) -> Self {
        Self::new(std::array::from_fn(|c| {
            (0_u8..).take(catalogue.count(c)).collect()
        }))
    }

    /// The reference's; `None` when the catalogue's names are not those of its recorded answers.
    #[must_use]
    pub fn of_the_reference(catalogue: &Catalogue) -> Option<Self> {
        let mut places: [Vec<u8>; CATEGORIES] = Default::default();
        for ((places, names), known) in places.iter_mut().zip(REFERENCE).zip(&catalogue.names) {
            if names.len() != known.len() {
                return None;
            }
            for name in names {
                let at = known.iter().position(|k| k == name)?;
                places.push(u8::try_from(at).ok()?);
            }
        }
        Some(Self::new(places))
    }

    fn new(places: [Vec<u8>; CATEGORIES]) -> Self {
        let at = std::array::from_fn(|c| {
            let mut at = vec![0; places[c].len()];
            for (i, &place) in (0_u8..).zip(&places[c]) {
                at[usize::from(place)] = i;
            }
            at
        });
        Self { places, at }
    }

    /// The catalogue's numbers in the core's order.
    #[must_use]
    pub fn places(&self, category: usize) -> &[u8] {
        &self.places[category]
    }

    /// The catalogue's number of the core's option.
    #[must_use]
    pub fn outside(&self, category: usize, option: u8) -> u8 {
        self.places[category][usize::from(option)]
    }

    /// The core's option for the catalogue's number.
    #[must_use]
    pub fn inside(&self, category: usize, option: u8) -> u8 {
        self.at[category][usize::from(option)]
    }
}
