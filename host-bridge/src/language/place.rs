//! Where a thing that was named belongs in a command: target or storage, told by the preposition
//! before it, by what its name can be, and by what was named before.

use deictic_core::category::Category;

use super::draft::{Heard, Slot};
use super::drafter::{Between, Drafter};
use super::error::LanguageError;
use super::pack::Role;
use super::read::Piece;

impl Drafter<'_> {
    pub(super) fn thing(&mut self, piece: &Piece) -> Result<(), LanguageError> {
        let preposition = self.preposition.take();
        let between = std::mem::replace(&mut self.between, Between::Nothing);
        if preposition == Some(Role::Aside) {
            return Ok(());
        }
        let objects: Vec<_> = piece.names(Category::OBJECT).collect();
        let storages: Vec<_> = piece.names(Category::STORAGE).collect();
        let heard = |options: &[u8]| Heard {
            words: piece.words.clone(),
            options: options.to_vec(),
        };
        let (has_target, has_storage) = self.list.last().map_or((false, false), |d| {
            (d.target.is_some(), d.storage.is_some())
        });
        let listed = between != Between::Nothing && preposition.is_none();
        if listed && self.join(between, &objects, &storages, piece) {
            return Ok(());
        }
        let wants_storage = preposition == Some(Role::Storage) || has_target;
        let slot = match (wants_storage, objects.is_empty(), storages.is_empty()) {
            // "put it into the bowl", "stack the cup box" with a box that is both
            (true, only, false) if !has_storage || only => Slot {
                belief: if only { 1.0 } else { 0.9 },
                instead: (!only).then_some(Category::OBJECT),
                ..Slot::new(Category::STORAGE, vec![heard(&storages)])
            },
            // "push to the cup": a slip of the tongue, as nothing else is there to push
            (true, false, _) if !has_target => Slot {
                belief: 0.6,
                instead: Some(Category::STORAGE),
                ..Slot::new(Category::OBJECT, vec![heard(&objects)])
            },
            (false, false, none) => Slot {
                belief: if none { 1.0 } else { 0.9 },
                instead: (!none).then_some(Category::STORAGE),
                ..Slot::new(Category::OBJECT, vec![heard(&objects)])
            },
            // "push the drawer": only a storage by its name
            (false, true, _) => Slot {
                belief: 0.6,
                instead: Some(Category::OBJECT),
                ..Slot::new(Category::STORAGE, vec![heard(&storages)])
            },
            _ => return Err(self.wrong_place(piece, has_storage)),
        };
        self.last = Some(slot.category);
        let draft = self.now();
        if slot.category == Category::STORAGE {
            draft.storage = Some(slot);
        } else {
            draft.target = Some(slot);
        }
        Ok(())
    }

    /// Takes a thing of a list: "the cup and the box", "the cup or the box", "the cup into the bowl
    /// and the box into the drawer".
    fn join(&mut self, between: Between, objects: &[u8], storages: &[u8], piece: &Piece) -> bool {
        let heard = |options: &[u8]| Heard {
            words: piece.words.clone(),
            options: options.to_vec(),
        };
        let Some(draft) = self.list.last_mut() else {
            return false;
        };
        let (options, slot) = match self.last {
            Some(Category::STORAGE) if objects.is_empty() => (storages, draft.storage.as_mut()),
            Some(Category::OBJECT) => (objects, draft.target.as_mut()),
            Some(Category::STORAGE) if draft.target.is_some() => (objects, draft.target.as_mut()),
            _ => return false,
        };
        let Some(slot) = slot.filter(|_| !options.is_empty()) else {
            return false;
        };
        if between == Between::And {
            let mut next = draft.clone();
            let slot = Slot::new(
                if self.last == Some(Category::STORAGE) && objects.is_empty() {
                    Category::STORAGE
                } else {
                    Category::OBJECT
                },
                vec![heard(options)],
            );
            if slot.category == Category::STORAGE {
                next.storage = Some(slot);
            } else {
                if self.last == Some(Category::STORAGE) {
                    next.storage = None;
                }
                next.target = Some(slot);
                self.last = Some(Category::OBJECT);
            }
            self.list.push(next);
        } else {
            slot.heard.push(heard(options));
        }
        true
    }

    fn wrong_place(&self, piece: &Piece, has_storage: bool) -> LanguageError {
        let category = if has_storage {
            Category::OBJECT
        } else {
            Category::STORAGE
        };
        LanguageError::WrongPlace {
            word: piece.words.clone(),
            category: self.lexicon.category_name(category),
            known: self
                .lexicon
                .entries(category)
                .iter()
                .map(|e| e.name.clone())
                .collect(),
        }
    }
}
