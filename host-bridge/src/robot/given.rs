//! Which commands a robot has had.

use std::collections::BTreeMap;

use super::{CommandId, Refusal};

/// The newest command of every run of a bridge: whatever is not newer was given before.
#[derive(Clone, Debug, Default)]
pub struct Given(BTreeMap<u32, u32>);

impl Given {
    /// Whether this command is new.
    ///
    /// # Errors
    /// [`Refusal::Repeated`] when it, or a later one of the same run, was begun before.
    pub fn check(&self, id: CommandId) -> Result<(), Refusal> {
        match self.0.get(&id.run) {
            Some(newest) if id.number <= *newest => Err(Refusal::Repeated),
            _ => Ok(()),
        }
    }

    /// This command was begun.
    pub fn note(&mut self, id: CommandId) {
        self.0.insert(id.run, id.number);
    }
}
