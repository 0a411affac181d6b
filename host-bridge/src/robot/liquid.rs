//! How much liquid is in things. A thing that is poured from counts as full as long as there is something in it; one that
//! is poured into counts as full when nothing more goes in.

use std::collections::BTreeMap;

use deictic_core::category::Category;

use super::World;

/// What a thing holds of which nothing is said, in litres: a can's worth.
const HOLDS: f32 = 0.33;

/// What counts as nothing, in litres: a teaspoon.
const NOTHING: f32 = 0.005;

/// What is tilted by a right angle runs empty.
const EMPTIES: f32 = 90.0;

/// A thing that takes liquid.
#[derive(Clone, Copy, Debug)]
struct Vessel {
    /// What it holds, in litres.
    holds: f32,
    /// What is in it, in litres.
    level: f32,
}

/// What has become of two things that were poured between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Poured {
    /// Whether nothing is left in the first.
    pub empty: bool,
    /// Whether nothing more goes into the second.
    pub full: bool,
}

/// How much is in what, as far as an arm has seen and done.
#[derive(Clone, Debug, Default)]
pub struct Liquids(BTreeMap<String, Vessel>);

impl Liquids {
    /// Takes note of what is there. Where a thing counts as fuller or emptier than was known, somebody has filled or
    /// emptied it.
    pub fn look(&mut self, world: World<'_>) {
        let Some(feature) = world.lexicon.feature("full-liquid") else {
            return;
        };
        for entity in world.table.scene().entities() {
            let likelihood = entity.features.get(feature);
            let full = likelihood.is_some_and(|f| *f >= deictic_core::decide::FEASIBLE);
            let name = world.lexicon.option_name(entity.category, entity.option);
            let measures = world.table.measures().get(&name).copied();
            let measures = measures.unwrap_or_default();
            let holds = measures.holds.unwrap_or(HOLDS);
            let all = if full { holds } else { 0.0 };
            let vessel = self.0.entry(name).or_insert(Vessel {
                holds,
                level: measures.liquid.unwrap_or(all),
            });
            let known = if entity.category == Category::STORAGE {
                vessel.is_full()
            } else {
                !vessel.is_empty()
            };
            if known != full {
                vessel.level = all;
            }
        }
    }

    /// Pours from one thing into another by tilting the first: by a part of a right angle, that part of what is in it
    /// runs out, but no more than the second takes.
    pub fn pour(&mut self, from: &str, into: &str, degrees: f32) -> Poured {
        let vessel = |name: &str| self.0.get(name).copied();
        let empty = Vessel {
            holds: HOLDS,
            level: 0.0,
        };
        let mut source = vessel(from).unwrap_or(Vessel {
            level: HOLDS,
            ..empty
        });
        let mut sink = vessel(into).unwrap_or(empty);
        let share = (degrees / EMPTIES).clamp(0.0, 1.0);
        let runs = (source.level * share).min(sink.holds - sink.level).max(0.0);
        source.level -= runs;
        sink.level += runs;
        self.0.insert(from.to_owned(), source);
        self.0.insert(into.to_owned(), sink);
        Poured {
            empty: source.is_empty(),
            full: sink.is_full(),
        }
    }
}

impl Vessel {
    fn is_empty(self) -> bool {
        self.level <= NOTHING
    }

    fn is_full(self) -> bool {
        self.level >= self.holds - NOTHING
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn liquids(of: &[(&str, f32, f32)]) -> Liquids {
        let vessels = of
            .iter()
            .map(|&(name, holds, level)| (name.to_owned(), Vessel { holds, level }));
        Liquids(vessels.collect())
    }

    fn level(liquids: &Liquids, name: &str) -> f32 {
        liquids.0.get(name).unwrap().level
    }

    #[test]
    fn nothing_is_lost_and_nothing_runs_over() {
        let mut all = liquids(&[("can", 0.33, 0.33), ("bowl", 0.5, 0.0), ("jug", 1.0, 1.0)]);
        let poured = all.pour("can", "bowl", 45.0);
        assert_eq!((poured.empty, poured.full), (false, false));
        assert!((level(&all, "bowl") - 0.165).abs() < 1e-6);
        let poured = all.pour("can", "bowl", 120.0);
        assert_eq!((poured.empty, poured.full), (true, false));
        let poured = all.pour("jug", "bowl", 90.0);
        assert_eq!((poured.empty, poured.full), (false, true));
        assert!((level(&all, "jug") - 0.83).abs() < 1e-6);
        let sum: f32 = ["can", "bowl", "jug"].iter().map(|n| level(&all, n)).sum();
        assert!((sum - 1.33).abs() < 1e-6);
    }
}
