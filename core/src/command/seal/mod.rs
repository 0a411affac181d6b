//! Who may command: with a key, every message carries a counter and a tag, in the manner of AUTOSAR's secure onboard
//! communication. docs/threat-model.md says against whom that helps, and what cutting the tag short costs.
//!
//! A sealed message has [`SEALED`] added to its identifier and, behind its bytes, the low half of the counter of what
//! its sender has said in this conversation (two bytes, little end first) and the first bytes of HMAC-SHA-256 over
//! way, both nonces, the whole counter (as in [`crate::protocol::seal`]), identifier and bytes. The tag has
//! [`ON_A_BUS`] or [`ON_A_STREAM`] bytes. Such messages are never short: over CAN they go in the sender's long frames.
//!
//! A host that beats in clear is answered with a [`Challenge`]; its first sealed message is [`Prove`], over both nonces.
//! Two messages mean the same in clear as ever: that beat, and a [`Halt`](super::message::Halt), which anybody may
//! say, in one frame that goes before all others.

mod conversation;

use heapless::Vec;

use super::Packet;
pub use super::SEALED;
use super::message::{Challenge, FromRobot, Prove, ToRobot};
use super::parcel::Sender;
use crate::protocol::seal::{Key, Nonces, TAG, Way};
use conversation::{Conversation, Why};

/// Bytes of a tag on a CAN bus: a guess is right once in 4.3e9.
pub const ON_A_BUS: usize = 4;

/// Bytes of a tag on a serial line or a TCP stream, as between unit and bridge.
pub const ON_A_STREAM: usize = TAG;

/// Bytes of the counter that are carried: up to 32,767 messages in a row may be lost.
const COUNTER: usize = 2;

/// Bytes that a seal adds at most.
pub const ROOM: usize = COUNTER + TAG;

/// After how many beats without a sealed answer a host beats in clear as well, to be challenged anew.
const UNANSWERED: u8 = 3;

/// Messages that were not taken. Every counter stops at its largest value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Refused {
    /// In clear, where a seal is asked for.
    pub unsealed: u32,
    /// With another tag than the key's, or one of another conversation.
    pub forged: u32,
    /// With the tag of a message that was there before.
    pub replayed: u32,
}

impl Refused {
    /// How many in all.
    #[must_use]
    pub fn all(&self) -> u32 {
        self.unsealed
            .saturating_add(self.forged)
            .saturating_add(self.replayed)
    }
}

/// What is to be done with what was heard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Heard {
    /// It is as good as said by the other side.
    Message(Packet),
    /// This is to be sent back as it is.
    Answer(Packet),
    /// Nothing.
    Nothing,
}

/// Stands at one side of a link, seals what is said and takes only what is sealed.
#[derive(Debug)]
pub struct Guard {
    side: Sender,
    key: Key,
    tag: usize,
    /// The next nonce of this side.
    fresh: u64,
    conversation: Option<Conversation>,
    /// Whether the other side has shown to have a key, and whether it is the same.
    challenged: bool,
    proven: bool,
    /// Beats of this side since a sealed message came.
    unanswered: u8,
    refused: Refused,
}

impl Guard {
    /// At this side of a link whose tags have `tag` bytes, at most [`TAG`]. `fresh` is random at every start, so that no
    /// nonce comes again.
    #[must_use]
    pub fn new(side: Sender, key: Key, tag: usize, fresh: u64) -> Self {
        Self {
            side,
            key,
            tag: tag.clamp(1, TAG),
            fresh,
            conversation: None,
            challenged: false,
            proven: false,
            unanswered: 0,
            refused: Refused::default(),
        }
    }

    /// What was not taken so far.
    #[must_use]
    pub fn refused(&self) -> Refused {
        self.refused
    }

    /// Whether the other side has ever asked for a proof: it has a key.
    #[must_use]
    pub fn is_challenged(&self) -> bool {
        self.challenged
    }

    /// Whether the other side has ever shown to have the same key.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        self.proven
    }

    /// What is to be sent for this message, in this order; nothing while no conversation is open.
    pub fn say(&mut self, packet: &Packet) -> Vec<Packet, 2> {
        let mut out = Vec::new();
        if self.side == Sender::Host {
            match ToRobot::read(packet) {
                // Everybody may stop the arm, and nothing may delay it.
                Ok(ToRobot::Halt(_)) => {
                    let _ = out.push(packet.clone());
                    return out;
                }
                Ok(ToRobot::HostBeat(_)) => {
                    self.unanswered = self.unanswered.saturating_add(1);
                    if self.is_unanswered() {
                        let _ = out.push(packet.clone());
                    }
                }
                _ => {}
            }
        }
        let tag = self.tag;
        let sealed = self.conversation.as_mut().and_then(|c| c.seal(packet, tag));
        // There is room for two.
        out.extend(sealed);
        out
    }

    fn is_unanswered(&self) -> bool {
        self.conversation.is_none() || self.unanswered > UNANSWERED
    }

    /// What to make of what came over the link.
    pub fn hear(&mut self, packet: &Packet) -> Heard {
        if packet.id & SEALED == 0 {
            return self.hear_in_clear(packet);
        }
        if self.side == Sender::Robot && self.is_proof(packet) {
            return Heard::Nothing;
        }
        let tag = self.tag;
        let opened = match &mut self.conversation {
            Some(conversation) => conversation.open(packet, tag),
            None => Err(Why::Forged),
        };
        match opened {
            Ok(message) => {
                self.unanswered = 0;
                self.proven = true;
                Heard::Message(message)
            }
            Err(why) => self.refuse(why),
        }
    }

    fn hear_in_clear(&mut self, packet: &Packet) -> Heard {
        match self.side {
            Sender::Robot => match ToRobot::read(packet) {
                Ok(ToRobot::Halt(_)) => Heard::Message(packet.clone()),
                Ok(ToRobot::HostBeat(_)) => {
                    let nonce = self.fresh;
                    Heard::Answer(FromRobot::from(Challenge { nonce }).packet())
                }
                _ => self.refuse(Why::Unsealed),
            },
            Sender::Host => match FromRobot::read(packet) {
                Ok(FromRobot::Challenge(of)) if self.is_unanswered() => self.prove(of.nonce),
                // An answer to a beat that was answered otherwise meanwhile.
                Ok(FromRobot::Challenge(_)) => Heard::Nothing,
                _ => self.refuse(Why::Unsealed),
            },
        }
    }

    /// Opens a conversation at the host's side: the robot takes it up when the keys are the same.
    fn prove(&mut self, robot: u64) -> Heard {
        let nonce = self.next_nonce();
        self.challenged = true;
        self.unanswered = 0;
        let nonces = Nonces {
            unit: robot,
            host: nonce,
        };
        let mut conversation = Conversation::new(self.key.clone(), nonces, Way::ToRobot);
        let proof = conversation.seal(&ToRobot::from(Prove { nonce }).packet(), self.tag);
        self.conversation = Some(conversation);
        proof.map_or(Heard::Nothing, Heard::Answer)
    }

    /// Whether this opens a conversation at the robot's side, which it then does.
    fn is_proof(&mut self, packet: &Packet) -> bool {
        let Some((nonce, _)) = packet.bytes.split_first_chunk() else {
            return false;
        };
        let nonces = Nonces {
            unit: self.fresh,
            host: u64::from_le_bytes(*nonce),
        };
        // Only this message carries its nonce in front; of any other the identifier is another one.
        let proves = |of: &Packet| matches!(ToRobot::read(of), Ok(ToRobot::Prove(_)));
        let shape = Packet {
            id: packet.id & !SEALED,
            bytes: Vec::from_slice(nonce).unwrap_or_default(),
        };
        if !proves(&shape) {
            return false;
        }
        let mut conversation = Conversation::new(self.key.clone(), nonces, Way::FromRobot);
        let proven = conversation
            .open(packet, self.tag)
            .is_ok_and(|of| proves(&of));
        if proven {
            self.next_nonce();
            self.proven = true;
            self.conversation = Some(conversation);
        }
        proven
    }

    fn next_nonce(&mut self) -> u64 {
        let nonce = self.fresh;
        self.fresh = nonce.wrapping_add(1);
        nonce
    }

    fn refuse(&mut self, why: Why) -> Heard {
        let counter = match why {
            Why::Unsealed => &mut self.refused.unsealed,
            Why::Forged => &mut self.refused.forged,
            Why::Replayed => &mut self.refused.replayed,
        };
        *counter = counter.saturating_add(1);
        Heard::Nothing
    }
}
