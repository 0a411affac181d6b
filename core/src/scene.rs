//! What is on the table: the things of the current scene with their features and positions (the
//! paper, Problem formulation: object features).

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::category::Category;
use crate::vocabulary::Vocabulary;

/// A thing of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entity<const F: usize> {
    /// [`Category::OBJECT`] or [`Category::STORAGE`]; what can be both is listed as both.
    pub category: Category,
    /// Which of the category's options it is.
    pub option: u8,
    /// Position in the robot's base frame, in metres.
    pub position: [f32; 3],
    /// Likelihood of every feature of the vocabulary, each in 0..=1.
    pub features: Vec<f32, F>,
}

/// Why a scene was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SceneError {
    /// More things than this build holds.
    TooManyEntities {
        /// How many it holds.
        capacity: u8,
    },
    /// Neither an object nor a storage, or an option that the vocabulary does not have.
    UnknownOption {
        /// Its place in the scene.
        entity: u8,
    },
    /// Not one likelihood per feature.
    WrongFeatureCount {
        /// Its place in the scene.
        entity: u8,
    },
    /// A likelihood outside 0..=1, or not a number.
    BadLikelihood {
        /// Its place in the scene.
        entity: u8,
    },
    /// A coordinate that is not finite.
    BadPosition {
        /// Its place in the scene.
        entity: u8,
    },
    /// The same option stands twice; a decision could not say which is meant.
    Duplicate {
        /// The place of the second.
        entity: u8,
    },
}

/// The things of the scene, at most `E`, each with at most `F` features, under a version number that
/// a decision carries, so that one made on an older scene is recognised.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene<const E: usize, const F: usize> {
    version: u32,
    entities: Vec<Entity<F>, E>,
}

impl<const E: usize, const F: usize> Scene<E, F> {
    /// An empty table.
    #[must_use]
    pub const fn new(version: u32) -> Self {
        Self {
            version,
            entities: Vec::new(),
        }
    }

    /// Empties the table, to be laid anew under another version, in place.
    pub fn restart(&mut self, version: u32) {
        self.version = version;
        self.entities.clear();
    }

    /// Puts one more thing on the table.
    ///
    /// # Errors
    /// [`SceneError`]; the scene is then as it was.
    pub fn push<const N: usize, const C: usize>(
        &mut self,
        entity: Entity<F>,
        vocabulary: &Vocabulary<N, C, F>,
    ) -> Result<(), SceneError> {
        let at = u8::try_from(self.entities.len()).unwrap_or(u8::MAX);
        if !entity.category.is_entity()
            || usize::from(entity.option) >= vocabulary.options_of(entity.category)
        {
            return Err(SceneError::UnknownOption { entity: at });
        }
        if entity.features.len() != vocabulary.features() {
            return Err(SceneError::WrongFeatureCount { entity: at });
        }
        if !entity.features.iter().all(|f| (0.0..=1.0).contains(f)) {
            return Err(SceneError::BadLikelihood { entity: at });
        }
        if !entity.position.iter().all(|x| x.is_finite()) {
            return Err(SceneError::BadPosition { entity: at });
        }
        if self.find(entity.category, entity.option).is_some() {
            return Err(SceneError::Duplicate { entity: at });
        }
        self.entities
            .push(entity)
            .map_err(|_| SceneError::TooManyEntities {
                capacity: u8::try_from(E).unwrap_or(u8::MAX),
            })
    }

    /// The number under which the host sent it.
    #[must_use]
    pub fn version(&self) -> u32 {
        self.version
    }

    /// The things, in the order in which they were put.
    #[must_use]
    pub fn entities(&self) -> &[Entity<F>] {
        &self.entities
    }

    /// The thing that is this option of this category, if it is on the table.
    #[must_use]
    pub fn find(&self, category: Category, option: u8) -> Option<&Entity<F>> {
        self.entities
            .iter()
            .find(|e| e.category == category && e.option == option)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vocabulary::Action;

    fn vocabulary() -> Vocabulary<4, 4, 4> {
        Vocabulary::new(&[Action::default()], &[2, 1], 2, None, 0).unwrap()
    }

    fn cup() -> Entity<4> {
        Entity {
            category: Category::OBJECT,
            option: 1,
            position: [0.4, 0.0, 0.1],
            features: Vec::from_slice(&[0.0, 1.0]).unwrap(),
        }
    }

    #[test]
    fn a_refused_thing_leaves_the_scene_as_it_was() {
        let v = vocabulary();
        let mut scene = Scene::<1, 4>::new(3);
        let mut bad = cup();
        bad.option = 2;
        assert_eq!(
            scene.push(bad, &v),
            Err(SceneError::UnknownOption { entity: 0 })
        );
        let mut bad = cup();
        bad.category = Category::ACTION;
        assert_eq!(
            scene.push(bad, &v),
            Err(SceneError::UnknownOption { entity: 0 })
        );
        let mut bad = cup();
        bad.features.pop();
        assert_eq!(
            scene.push(bad, &v),
            Err(SceneError::WrongFeatureCount { entity: 0 })
        );
        for f in [f32::NAN, -0.1, 1.1, f32::INFINITY] {
            let mut bad = cup();
            bad.features[0] = f;
            assert_eq!(
                scene.push(bad, &v),
                Err(SceneError::BadLikelihood { entity: 0 })
            );
        }
        let mut bad = cup();
        bad.position[2] = f32::NAN;
        assert_eq!(
            scene.push(bad, &v),
            Err(SceneError::BadPosition { entity: 0 })
        );
        assert!(scene.entities().is_empty());

        scene.push(cup(), &v).unwrap();
        assert_eq!(
            scene.push(cup(), &v),
            Err(SceneError::Duplicate { entity: 1 })
        );
        let mut other = cup();
        other.option = 0;
        assert_eq!(
            scene.push(other, &v),
            Err(SceneError::TooManyEntities { capacity: 1 })
        );
        assert_eq!(scene.entities().len(), 1);
    }
}
