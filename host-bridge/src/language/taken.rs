//! What an action takes: nothing that was said of it is lost, be it said twice, be it nothing that the
//! action has a use for, be it an option that the vocabulary does not have.

use deictic_core::category::Category;

use super::draft::{Heard, Slot};
use super::drafter::{Between, Drafter};
use super::error::LanguageError;
use super::pack::Role;
use super::read::Piece;

impl Drafter<'_> {
    /// Takes a parameter, which a command has one of: "left or right" leaves it open.
    pub(super) fn parameter_slot(
        &mut self,
        slot: Slot,
        piece: &Piece,
    ) -> Result<(), LanguageError> {
        let category = slot.category;
        let said = self.said.get(self.fresh..).unwrap_or_default();
        let again = said.iter().any(|(c, _)| *c == category);
        let choice = self.between == Between::Or;
        let others = &mut self.now().others;
        if let Some(before) = others.iter_mut().find(|s| again && s.category == category) {
            let options =
                |s: &Slot| -> Vec<u8> { s.heard.iter().flat_map(|h| h.options.clone()).collect() };
            if options(before) == options(&slot) && before.quantity == slot.quantity {
                return Ok(());
            }
            if !choice || slot.quantity.is_some() || before.quantity.is_some() {
                return Err(self.twice(&piece.words, category));
            }
            before.heard.extend(slot.heard);
        } else {
            others.retain(|s| s.category != category);
            others.push(slot);
        }
        self.said.push((category, piece.words.clone()));
        Ok(())
    }

    pub(super) fn twice(&self, word: &str, category: Category) -> LanguageError {
        LanguageError::Twice {
            word: word.to_owned(),
            category: self.lexicon.category_name(category),
        }
    }

    /// Whether a word for several things has only one name behind it: "both cups", but not "both the cup
    /// and the can".
    pub(super) fn is_several(&self, piece: &Piece, rest: &[Piece]) -> bool {
        let next = rest.iter().find(|p| !p.is(Role::Filler));
        let thing = |p: &Piece| p.is_thing() || p.is(Role::Again) || p.is(Role::Pointed);
        let listed = piece.is(Role::And) && rest.iter().any(|p| p.is(Role::And));
        next.is_some_and(thing) && !listed
    }

    /// The category that a piece names no option of, where the action takes one.
    pub(super) fn lacking(&self, piece: &Piece) -> Option<Category> {
        let silent = [
            Role::Particle,
            Role::Filler,
            Role::Place,
            Role::Storage,
            Role::Aside,
        ];
        let silent = silent.iter().any(|&role| piece.is(role));
        piece
            .lacks()
            .filter(|&category| !silent || self.has_signature(category))
    }

    pub(super) fn no_such_option(&self, piece: &Piece, category: Category) -> LanguageError {
        let entries = self.lexicon.entries(category).iter();
        LanguageError::NoSuchOption {
            word: piece.words.clone(),
            category: self.lexicon.category_name(category),
            known: entries.map(|e| e.name.clone()).collect(),
        }
    }

    /// Whether the action, if one was named, takes all that was said. How often is for any action, and a
    /// stop stops whatever else is said.
    pub(super) fn suits(&self, verb: Option<(&Piece, Heard)>) -> Result<(), LanguageError> {
        let Some((piece, heard)) = verb else {
            return Ok(());
        };
        if heard.options.iter().copied().eq(self.table.stop) {
            return Ok(());
        }
        let takes_things =
            self.has_signature(Category::OBJECT) || self.has_signature(Category::STORAGE);
        // By its own name an action is none of another's: "release the can to the bowl" lets go of it.
        let own = |&o: &u8| {
            let name = self.lexicon.option_name(Category::ACTION, o);
            name.replace('-', " ") == heard.words
        };
        let own = heard.options.iter().any(own);
        let not_taken = |category: Category, word: &str| {
            Err(LanguageError::NotTaken {
                word: word.to_owned(),
                category: self.lexicon.category_name(category),
                action: heard.words.clone(),
            })
        };
        for (category, word) in &self.said {
            let idle = match *category {
                Category::AMOUNT => false,
                // "Drop the cup" lets go of what is held, "drop it in the bowl" would drop it here.
                Category::OBJECT => piece.is(Role::Alone) && !takes_things,
                Category::STORAGE => !own && !takes_things,
                other => !self.has_signature(other),
            };
            if idle {
                return not_taken(*category, word);
            }
        }
        Ok(())
    }
}
