//! A command as far as words tell it: its action and parameters with what was heard for each.

use deictic_core::category::Category;
use deictic_core::vocabulary::Action;

use crate::vocabulary::Lexicon;

/// One parameter of a command, or its action.
#[derive(Clone, Debug, PartialEq)]
pub struct Slot {
    /// Its most probable category.
    pub category: Category,
    /// How probable that is, 0..=1; the rest goes to `instead`.
    pub belief: f32,
    /// The other category it may belong to.
    pub instead: Option<Category>,
    /// What was heard; several when one or the other was said. Empty for what the hand shows.
    pub heard: Vec<Heard>,
    /// Metres, radians or pieces.
    pub quantity: Option<f32>,
}

/// What was heard for a slot.
#[derive(Clone, Debug, PartialEq)]
pub struct Heard {
    /// The words, folded.
    pub words: String,
    /// The options they name.
    pub options: Vec<u8>,
}

impl Slot {
    /// A certain slot of what was heard.
    #[must_use]
    pub fn new(category: Category, heard: Vec<Heard>) -> Self {
        Self {
            category,
            belief: 1.0,
            instead: None,
            heard,
            quantity: None,
        }
    }

    /// Whether the hand must show it.
    #[must_use]
    pub fn is_pointed(&self) -> bool {
        self.heard.is_empty() && self.quantity.is_none()
    }
}

/// A command as far as a clause tells it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Draft {
    /// What to do.
    pub action: Option<Slot>,
    /// With what.
    pub target: Option<Slot>,
    /// Into or onto what.
    pub storage: Option<Slot>,
    /// How.
    pub others: Vec<Slot>,
    /// Whether the target is the thing spoken of last.
    pub again: bool,
}

impl Draft {
    /// Whether it says nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.action.is_none() && self.is_bare()
    }

    /// A target that the hand must show.
    #[must_use]
    pub fn shown() -> Slot {
        Slot::new(Category::OBJECT, Vec::new())
    }

    /// Whether it says nothing but an action.
    #[must_use]
    pub fn is_bare(&self) -> bool {
        self.target.is_none() && self.storage.is_none() && self.others.is_empty()
    }
}

impl Draft {
    /// What a correction leaves of this and brings of `new`: a new action with its own things
    /// replaces all, otherwise only what is said anew changes.
    pub fn amend(&mut self, new: &Self) {
        if new.action.is_some() && !new.is_bare() {
            *self = new.clone();
            return;
        }
        if new.action.is_some() {
            self.action.clone_from(&new.action);
        }
        if new.target.is_some() {
            self.target.clone_from(&new.target);
        }
        if new.storage.is_some() {
            self.storage.clone_from(&new.storage);
        }
        for slot in &new.others {
            self.others.retain(|s| s.category != slot.category);
            self.others.push(slot.clone());
        }
    }

    /// Leaves out what an action that took another's place has no use for: "push the cup, no, stop".
    pub fn prune(&mut self, lexicon: &Lexicon) {
        let actions = lexicon.vocabulary().actions();
        let heard = self
            .action
            .iter()
            .flat_map(|a| &a.heard)
            .flat_map(|h| &h.options);
        let named: Vec<_> = heard.filter_map(|&o| actions.get(usize::from(o))).collect();
        let takes = |category: Category| {
            let takes = |a: &&Action| {
                let all = a.signature.compulsory.union(a.signature.voluntary);
                all.contains(category.index())
            };
            named.is_empty() || named.iter().any(takes)
        };
        self.target.take_if(|_| !takes(Category::OBJECT));
        self.storage.take_if(|_| !takes(Category::STORAGE));
        self.others.retain(|s| takes(s.category));
    }

    /// This or another command, which one is left open.
    pub fn or(&mut self, other: &Self) {
        let join = |mine: &mut Option<Slot>, its: &Option<Slot>| match (mine, its) {
            (Some(mine), Some(its)) => mine.heard.extend(its.heard.iter().cloned()),
            (mine, Some(_)) => mine.clone_from(its),
            _ => {}
        };
        join(&mut self.action, &other.action);
        join(&mut self.target, &other.target);
        join(&mut self.storage, &other.storage);
    }
}
