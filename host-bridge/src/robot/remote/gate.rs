//! Where messages pass between a side of the command set and its link: sealed and checked where there is a key, as they
//! are where there is none.

use std::io;

use deictic_core::command::Packet;
use deictic_core::command::parcel::Sender;
use deictic_core::command::seal::{Guard, Heard, Refused};
use deictic_core::protocol::seal::Key;

/// A guard, or nobody.
#[derive(Debug, Default)]
pub struct Gate(Option<Guard>);

impl Gate {
    /// Guarded by a key, where there is one, at this side of a link whose tags have so many bytes.
    ///
    /// # Errors
    /// When this machine has no random numbers.
    pub fn new(side: Sender, key: Option<&Key>, tag: usize) -> io::Result<Self> {
        let guard = |key: &Key| {
            let fresh = getrandom::u64()
                .map_err(|error| io::Error::other(format!("no random numbers: {error}")))?;
            Ok(Guard::new(side, key.clone(), tag, fresh))
        };
        key.map(guard).transpose().map(Self)
    }

    /// The guard, where there is a key.
    #[must_use]
    pub fn guard(&self) -> Option<&Guard> {
        self.0.as_ref()
    }

    /// What was not taken.
    #[must_use]
    pub fn refused(&self) -> Refused {
        self.0.as_ref().map(Guard::refused).unwrap_or_default()
    }

    /// What goes over the link for this message.
    #[must_use]
    pub fn say(&mut self, packet: &Packet) -> Vec<Packet> {
        match &mut self.0 {
            None => vec![packet.clone()],
            Some(guard) => guard.say(packet).into_iter().collect(),
        }
    }

    /// What to make of what came over the link.
    #[must_use]
    pub fn hear(&mut self, packet: Packet) -> Heard {
        match &mut self.0 {
            None => Heard::Message(packet),
            Some(guard) => guard.hear(&packet),
        }
    }
}
