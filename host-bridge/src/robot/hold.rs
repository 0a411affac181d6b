//! What an arm knows of the things it handles: which one it holds, what stands in or on what, how
//! tall things are; and what its motions make different on the table.

use std::collections::BTreeMap;

use super::World;
use super::liquid::Liquids;
use super::task::{Effect, Place};
use crate::scene::Change;

/// The features that motions change.
const FEATURES: [&str; 5] = [
    "full-container",
    "full-stack",
    "glued",
    "pickable",
    "full-liquid",
];

/// How near a thing must be to another, seen from above, to come to rest on it, in metres.
const ABOVE: f32 = 0.06;

/// How near it must be to be struck by it, in metres: things are thought of as this wide.
const WIDTH: f32 = 0.05;

/// What an arm knows of things.
#[derive(Clone, Debug, Default)]
pub struct Hold {
    held: Option<String>,
    /// What stands in or on what, as far as this arm put it there, with the feature that tells so.
    resting: BTreeMap<String, (String, &'static str)>,
    /// Half of how tall things are, in metres: how high their middle was when they were first seen.
    halves: BTreeMap<String, f32>,
    liquids: Liquids,
    /// The places of the features this arm changes, as the vocabulary has them.
    features: BTreeMap<&'static str, usize>,
}

impl Hold {
    /// What is in the hand.
    pub fn thing(&self) -> Option<&str> {
        self.held.as_deref()
    }

    /// Takes note of what is there.
    pub fn look(&mut self, world: World<'_>) {
        for name in FEATURES {
            if let Some(at) = world.lexicon.feature(name) {
                self.features.insert(name, at);
            }
        }
        for entity in world.table.scene().entities() {
            let name = world.lexicon.option_name(entity.category, entity.option);
            let [.., z] = entity.position;
            self.halves.entry(name).or_insert(z.max(0.0));
        }
        self.liquids.look(world);
    }

    /// Half of how tall a thing is, in metres; `otherwise` when it was never seen.
    pub fn half(&self, thing: &str, otherwise: f32) -> f32 {
        self.halves.get(thing).copied().unwrap_or(otherwise)
    }

    /// How high the middle of `thing` comes to rest when it is set down below `at`; and in or on what,
    /// with the feature that tells so, if not on the table.
    pub fn support(
        &self,
        thing: &str,
        [x, y, _]: Place,
        world: World<'_>,
    ) -> (f32, Option<(String, &'static str)>) {
        let half = self.half(thing, 0.03);
        let mut support = (half, None);
        let mut highest = 0.0;
        for entity in world.table.scene().entities() {
            let name = world.lexicon.option_name(entity.category, entity.option);
            let [its_x, its_y, its_z] = entity.position;
            let beside = (x - its_x) * (x - its_x) + (y - its_y) * (y - its_y) > ABOVE * ABOVE;
            let top = its_z + self.half(&name, its_z);
            if beside || name == thing || top <= highest {
                continue;
            }
            highest = top;
            let container = world.lexicon.feature("container");
            let is = |feature: Option<usize>| {
                let likelihood = feature.and_then(|f| entity.features.get(f));
                likelihood.is_some_and(|f| *f >= deictic_core::decide::FEASIBLE)
            };
            support = if is(container) && !is(world.lexicon.feature("full-container")) {
                (its_z, Some((name, "full-container")))
            } else {
                (top + half, Some((name, "full-stack")))
            };
        }
        support
    }

    /// What `thing` would run into on its way along the table.
    pub fn in_the_way(
        &self,
        thing: &str,
        [x, y, z]: Place,
        [to_x, to_y, _]: Place,
        world: World<'_>,
    ) -> Option<String> {
        let (way_x, way_y) = (to_x - x, to_y - y);
        let square = (way_x * way_x + way_y * way_y).max(1e-9);
        world.table.scene().entities().iter().find_map(|entity| {
            let name = world.lexicon.option_name(entity.category, entity.option);
            let [its_x, its_y, its_z] = entity.position;
            let along = ((its_x - x) * way_x + (its_y - y) * way_y) / square;
            let part = along.clamp(0.0, 1.0);
            let (off_x, off_y) = (its_x - x - part * way_x, its_y - y - part * way_y);
            let level = (its_z - z).abs() < self.half(&name, its_z) + self.half(thing, z);
            let struck = off_x * off_x + off_y * off_y < WIDTH * WIDTH;
            (along > 0.0 && struck && level && name != thing).then_some(name)
        })
    }

    fn set(&self, thing: &str, feature: &'static str, likelihood: f32) -> Option<Change> {
        Some(Change::Feature {
            thing: thing.to_owned(),
            feature: *self.features.get(feature)?,
            likelihood,
        })
    }

    /// What a motion that has just ended with the hand at `hand` made different.
    pub fn changes(&mut self, effect: Effect, hand: Place) -> Vec<Change> {
        let mut changes = Vec::new();
        match effect {
            Effect::None => {}
            Effect::Grasp(thing) => {
                if let Some((base, feature)) = self.resting.remove(&thing) {
                    changes.extend(self.set(&base, feature, 0.0));
                }
                self.held = Some(thing);
            }
            Effect::LetGo => changes.extend(self.leave(hand)),
            Effect::LeaveIn(base, feature) => {
                changes.extend(self.set(&base, feature, 1.0));
                if let Some(thing) = self.held.clone() {
                    self.resting.insert(thing, (base, feature));
                }
                changes.extend(self.leave(hand));
            }
            Effect::Push(thing, [x, y, z]) => {
                let [hand_x, hand_y, hand_z] = hand;
                if let Some((base, feature)) = self.resting.remove(&thing) {
                    changes.extend(self.set(&base, feature, 0.0));
                }
                let position = [hand_x + x, hand_y + y, hand_z + z];
                changes.push(Change::Moved { thing, position });
            }
            Effect::Loosen(thing) => {
                changes.extend(self.set(&thing, "glued", 0.0));
                changes.extend(self.set(&thing, "pickable", 1.0));
            }
            Effect::Pour(from, into, degrees) => {
                let poured = self.liquids.pour(&from, &into, degrees);
                if poured.empty {
                    changes.extend(self.set(&from, "full-liquid", 0.0));
                }
                if poured.full {
                    changes.extend(self.set(&into, "full-liquid", 1.0));
                }
            }
        }
        changes.extend(self.carried(hand));
        changes
    }

    /// Where the thing in the hand is, as the hand is at `hand`.
    pub fn carried(&self, hand: Place) -> Option<Change> {
        let thing = self.held.clone()?;
        let position = hand;
        Some(Change::Moved { thing, position })
    }

    fn leave(&mut self, hand: Place) -> Option<Change> {
        let left = self.carried(hand);
        self.held = None;
        left
    }
}
