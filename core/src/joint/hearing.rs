//! Adding a word to what was heard.

use super::cost::{Costs, MOST};
use super::evidence::{Evidence, Work};
use super::likelihoods::Likely;
use super::sensors::{Sensor, Tables};
use super::word::{self, DEAREST, Reading, Room};
use crate::category::Category;
use crate::sentence::Word;
use crate::vocabulary::Vocabulary;

/// Words of a category that can be added before costs are cut off: [`MOST`] / [`DEAREST`].
const MANY: u8 = 7;

/// All options of a category whose options all are weighed.
const ALL: [u8; 64] = {
    let mut all = [0; 64];
    let mut rest = all.as_mut_slice();
    let mut option = 0_u8;
    while let [place, others @ ..] = rest {
        *place = option;
        option = option.wrapping_add(1);
        rest = others;
    }
    all
};

impl<const C: usize, const N: usize> Evidence<C, N> {
    /// Adds a word of `category`, which a modality of this weight reported.
    pub fn hear<const F: usize>(
        &mut self,
        vocabulary: &Vocabulary<N, C, F>,
        sensors: Tables<'_>,
        modality: u8,
        category: Category,
        said: &Word<C, N>,
        weight: f32,
    ) {
        let q = category.index();
        let p = said.categories().get(q).copied().unwrap_or(0.0);
        let (Some(words), Some(count)) = (self.words.get_mut(q), self.count.get_mut(q)) else {
            return;
        };
        self.spoken = self.spoken.with(q);
        let Work {
            elements,
            sums,
            raised,
            ..
        } = &mut self.work;
        let live = match self.live.get(q) {
            Some(live) => live.options(),
            None => &ALL,
        };
        // What the elements of other categories cost, nobody wants to know: room that only actions need.
        let (named, raised) = match self.named.get_mut(q) {
            Some(named) => (named, &mut raised[..]),
            None => (raised, &mut [][..]),
        };
        let first = *count == 0;
        if *count >= MANY {
            for costs in [&mut *words, named, &mut self.raised] {
                bound(costs);
            }
        }
        *count = count.saturating_add(1);
        let likelihoods = said.likelihoods();
        let weight = word::in_256ths(weight * p);
        let Sensor::Scores(rows) = sensors.sensor(modality, category, likelihoods.len()) else {
            let likely = Likely::new(likelihoods, weight, first);
            likely.add(live, words);
            likely.add(&ALL, named);
            if category == Category::ACTION {
                likely.add(live, &mut self.raised);
            }
            return;
        };
        let reading = Reading {
            likelihoods,
            rows,
            live: live.get(..likelihoods.len()).unwrap_or(live),
            weight,
            first,
        };
        let mut room = Room {
            elements: elements.get_mut(..likelihoods.len()).unwrap_or_default(),
            sums,
            raised,
            named,
        };
        if category == Category::ACTION {
            let actions = vocabulary.actions();
            word::action(&reading, actions, &mut room, words, &mut self.raised);
        } else {
            word::parameter(&reading, &mut room, words);
        }
    }
}

/// Makes room for one more word.
#[inline(never)]
fn bound(costs: &mut [Costs]) {
    for costs in costs {
        *costs = costs.least(Costs::all(MOST.wrapping_sub(DEAREST)));
    }
}
