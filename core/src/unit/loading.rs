//! Taking over a vocabulary or a scene that comes in parts: the old one stays in force until the
//! new one is complete and sound.

use heapless::Vec;

use crate::protocol::message::{Fault, Loaded, ScenePart, VocabularyPart};
use crate::scene::Scene;
use crate::vocabulary::{Action, Vocabulary};

/// What is in force and what is arriving.
#[derive(Debug)]
pub struct Loading<const N: usize, const C: usize, const F: usize, const E: usize> {
    /// Without actions: there is none.
    vocabulary: Vocabulary<N, C, F>,
    /// Of version 0: there is none.
    scene: Scene<E, F>,
    actions: Vec<Action, N>,
    arriving: Scene<E, F>,
}

impl<const N: usize, const C: usize, const F: usize, const E: usize> Default
    for Loading<N, C, F, E>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const C: usize, const F: usize, const E: usize> Loading<N, C, F, E> {
    /// Nothing in force, nothing arriving.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            vocabulary: Vocabulary::EMPTY,
            scene: Scene::new(0),
            actions: Vec::new(),
            arriving: Scene::new(0),
        }
    }

    /// Nothing in force, nothing arriving, in place.
    pub fn clear(&mut self) {
        self.vocabulary.clear();
        self.scene.restart(0);
        self.actions.clear();
        self.arriving.restart(0);
    }

    /// The vocabulary in force.
    #[must_use]
    pub fn vocabulary(&self) -> Option<&Vocabulary<N, C, F>> {
        Some(&self.vocabulary).filter(|vocabulary| !vocabulary.actions().is_empty())
    }

    /// The scene in force.
    #[must_use]
    pub fn scene(&self) -> Option<&Scene<E, F>> {
        Some(&self.scene).filter(|scene| scene.version() > 0)
    }

    /// Takes a part of a vocabulary; the last one puts it in force and the scene, which spoke the
    /// old one, out of force.
    ///
    /// # Errors
    /// A [`Fault`]: the part is out of order, or the whole cannot be. The old one stays in force.
    pub fn take_vocabulary(&mut self, part: &VocabularyPart<C>) -> Result<Option<Loaded>, Fault> {
        if part.first == 0 {
            self.actions.clear();
        }
        in_order(self.actions.len(), part.first)?;
        for &action in &part.actions {
            self.actions.push(action).map_err(|_| {
                Fault::Vocabulary(crate::vocabulary::VocabularyError::TooManyActions {
                    capacity: u8::try_from(N).unwrap_or(u8::MAX),
                })
            })?;
        }
        if self.actions.len() < usize::from(part.total) {
            return Ok(None);
        }
        let set = self.vocabulary.set(
            &self.actions,
            &part.parameters,
            part.features,
            part.stop,
            part.fingerprint,
        );
        self.actions.clear();
        set.map_err(Fault::Vocabulary)?;
        self.scene.restart(0);
        // Its things were held against the vocabulary before.
        self.arriving.restart(0);
        Ok(Some(Loaded::Vocabulary(part.fingerprint)))
    }

    /// Takes a part of a scene; the last one puts it in force.
    ///
    /// # Errors
    /// A [`Fault`]: there is no vocabulary, the scene is not newer, the part is out of order, or a
    /// thing cannot be. The old scene stays in force.
    pub fn take_scene(&mut self, part: &ScenePart<F>) -> Result<Option<Loaded>, Fault> {
        self.vocabulary().ok_or(Fault::NoVocabulary)?;
        let held = self.scene.version();
        if part.version <= held {
            return Err(Fault::OldScene {
                held,
                got: part.version,
            });
        }
        if part.first == 0 {
            self.arriving.restart(part.version);
        }
        if part.version != self.arriving.version() {
            return Err(Fault::PartOutOfOrder {
                expected: 0,
                got: part.first,
            });
        }
        in_order(self.arriving.entities().len(), part.first)?;
        for entity in &part.entities {
            self.arriving
                .push(entity.clone(), &self.vocabulary)
                .map_err(Fault::Scene)?;
        }
        if self.arriving.entities().len() < usize::from(part.total) {
            return Ok(None);
        }
        core::mem::swap(&mut self.scene, &mut self.arriving);
        self.arriving.restart(0);
        Ok(Some(Loaded::Scene(part.version)))
    }
}

pub(super) fn in_order(held: usize, first: u8) -> Result<(), Fault> {
    if held == usize::from(first) {
        Ok(())
    } else {
        let expected = u8::try_from(held).unwrap_or(u8::MAX);
        Err(Fault::PartOutOfOrder {
            expected,
            got: first,
        })
    }
}
