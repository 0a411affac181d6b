//! What a host says to a robot.

use heapless::Vec;

use super::{FieldLayout, Layout, bytes_of};
use crate::command::code::{Direction, Motion};
use crate::command::field::{Features, Field, Id, Quantity, Thing};
use crate::command::{Packet, PacketError};

messages! {
    /// What a host says to a robot.
    ToRobot {
        /// Stand still at once. No command of this run up to this number is begun any more.
        0x010 Halt {
            /// The newest command that was given.
            id: Id,
        }
        /// The host lives.
        0x020 HostBeat {
            /// The newest command that was given; 0 before the first.
            id: Id,
        }
        /// The host answers a challenge, sealed as the first message of a conversation.
        0x021 Prove {
            /// What the host has never said before.
            nonce: u64,
        }
        /// Pause in the middle of the command, ready to go on.
        0x031 Hold {
            /// The command that is being done.
            id: Id,
        }
        /// Go on with the command.
        0x032 Resume {
            /// The command that is held.
            id: Id,
        }
        /// Go to the ready posture: a command of its own.
        0x033 Home {
            /// Its name.
            id: Id,
        }
        /// What went wrong has been seen to: a command of its own.
        0x034 ClearFault {
            /// Its name.
            id: Id,
        }
        /// Say again how this command ended, and all that it changed.
        0x035 Ask {
            /// The command.
            id: Id,
        }
        /// Do this, once.
        0x040 Execute {
            /// Its name.
            id: Id,
            /// The version of the scene that it was decided on.
            scene: u32,
            /// What the arm is to do.
            motion: Motion,
            /// What it is to be done to.
            object: Thing,
            /// Where the object is to go.
            storage: Thing,
            /// How far.
            distance: Quantity,
            /// Which way.
            direction: Direction,
            /// By how much to turn.
            angle: Quantity,
            /// How many or how much.
            amount: u8,
        }
        /// What is on the table is told anew, thing by thing.
        0x050 Scene {
            /// Its version.
            version: u32,
            /// The vocabulary that its options and features are those of.
            vocabulary: u32,
            /// How many things there are.
            things: u8,
        }
        /// A thing of the scene that is being told.
        0x051 Item {
            /// The scene's version.
            version: u32,
            /// Which of its things, from 0.
            place: u8,
            /// The thing and where it is.
            thing: Thing,
            /// The likelihoods of its features.
            features: Features,
        }
    }
}
