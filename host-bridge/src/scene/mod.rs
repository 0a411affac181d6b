//! What is on the table: a scene file in words, and the table as it is now.

mod error;
pub mod feed;
mod file;
pub mod line;
mod measures;
mod sensor;
pub mod watch;

use std::collections::BTreeMap;

use deictic_core::category::Category;
use deictic_core::large;
use deictic_core::protocol::hand::HandSettings;
use deictic_core::scene::SceneError;

use crate::vocabulary::Lexicon;

pub use error::SceneProblem;
pub use file::{Likelihood, SceneFile, SceneFileError};
pub use line::SceneLine;
pub use measures::Measures;

/// The scene that comes with the program, for the tabletop vocabulary.
pub const TABLE: &str = include_str!("../../data/scenes/table.toml");

/// Something about the table that became different.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// A feature of a thing has this likelihood now, in 0..=1.
    Feature {
        /// The thing's name; one that is object and storage alike changes as both.
        thing: String,
        /// The feature's place in the vocabulary.
        feature: usize,
        /// Its likelihood.
        likelihood: f32,
    },
    /// A thing is here now: metres in the robot's base frame.
    Moved {
        /// The thing's name.
        thing: String,
        /// Its place.
        position: [f32; 3],
    },
}

/// The table as it is now. Every change makes a new version, so that a decision made on an older
/// one is recognised.
#[derive(Clone, Debug, PartialEq)]
pub struct Tabletop {
    scene: large::Scene,
    hand: HandSettings,
    measures: BTreeMap<String, Measures>,
}

impl Tabletop {
    /// A table with these things, as version 1.
    ///
    /// # Errors
    /// [`SceneError`] for the first thing that does not fit the vocabulary.
    pub fn new(
        things: impl IntoIterator<Item = large::Entity>,
        lexicon: &Lexicon,
    ) -> Result<Self, SceneError> {
        Ok(Self {
            scene: scene(1, things, lexicon)?,
            hand: HandSettings::DEFAULT,
            measures: BTreeMap::new(),
        })
    }

    /// The same table, with the hand sensor standing so.
    #[must_use]
    pub fn with_hand(mut self, hand: HandSettings) -> Self {
        self.hand = hand;
        self
    }

    /// Where the hand sensor stands and how well the person aims.
    #[must_use]
    pub fn hand(&self) -> HandSettings {
        self.hand
    }

    /// The same table, with what things of these names weigh and hold.
    #[must_use]
    pub fn with_measures(mut self, measures: BTreeMap<String, Measures>) -> Self {
        self.measures = measures;
        self
    }

    /// What things weigh and hold, by their names, as it was when the table was first laid.
    #[must_use]
    pub fn measures(&self) -> &BTreeMap<String, Measures> {
        &self.measures
    }

    /// A table with these things under a version that somebody else counts.
    ///
    /// # Errors
    /// [`SceneError`] for the first thing that does not fit the vocabulary.
    pub fn numbered(
        version: u32,
        things: impl IntoIterator<Item = large::Entity>,
        lexicon: &Lexicon,
    ) -> Result<Self, SceneError> {
        Ok(Self {
            scene: scene(version, things, lexicon)?,
            hand: HandSettings::DEFAULT,
            measures: BTreeMap::new(),
        })
    }

    /// What the core makes of it.
    #[must_use]
    pub fn scene(&self) -> &large::Scene {
        &self.scene
    }

    /// Its number; larger after every change, never 0.
    #[must_use]
    pub fn version(&self) -> u32 {
        self.scene.version()
    }

    /// The thing that is this option of this category.
    #[must_use]
    pub fn find(&self, category: Category, option: u8) -> Option<&large::Entity> {
        self.scene.find(category, option)
    }

    /// Takes changes over and counts the version up; without changes nothing happens.
    ///
    /// # Errors
    /// [`SceneError`] when a likelihood or position cannot be; the table is then as it was.
    pub fn apply(&mut self, changes: &[Change], lexicon: &Lexicon) -> Result<(), SceneError> {
        if changes.is_empty() {
            return Ok(());
        }
        let mut things = self.scene.entities().to_vec();
        for change in changes {
            let name = match change {
                Change::Feature { thing, .. } | Change::Moved { thing, .. } => thing,
            };
            let same = |e: &&mut large::Entity| lexicon.option_name(e.category, e.option) == *name;
            for entity in things.iter_mut().filter(same) {
                match change {
                    Change::Feature {
                        feature,
                        likelihood,
                        ..
                    } => {
                        if let Some(f) = entity.features.get_mut(*feature) {
                            *f = *likelihood;
                        }
                    }
                    Change::Moved { position, .. } => entity.position = *position,
                }
            }
        }
        self.scene = scene(self.version().wrapping_add(1).max(1), things, lexicon)?;
        Ok(())
    }

    /// Replaces everything on the table, for example after its file was edited.
    ///
    /// # Errors
    /// [`SceneError`] for the first thing that does not fit; the table is then as it was.
    pub fn replace(
        &mut self,
        things: impl IntoIterator<Item = large::Entity>,
        lexicon: &Lexicon,
    ) -> Result<(), SceneError> {
        self.scene = scene(self.version().wrapping_add(1).max(1), things, lexicon)?;
        Ok(())
    }
}

fn scene(
    version: u32,
    things: impl IntoIterator<Item = large::Entity>,
    lexicon: &Lexicon,
) -> Result<large::Scene, SceneError> {
    let mut scene = large::Scene::new(version);
    for thing in things {
        scene.push(thing, lexicon.vocabulary())?;
    }
    Ok(scene)
}
