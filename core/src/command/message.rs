//! What host and robot say to each other, each with its layout.

use heapless::Vec;

use super::code::{Direction, Fault, Motion, Outcome, Reason, State};
use super::field::{Angle, Features, Field, Id, Name, Number, Part, Place, Quantity, Text, Thing};
use super::{Packet, PacketError};

/// How a message lies in its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Its CAN identifier; a smaller one goes first on a busy bus.
    pub id: u16,
    /// Its name.
    pub name: &'static str,
    /// What it says.
    pub meaning: &'static str,
    /// Its fields, one behind the other.
    pub fields: &'static [FieldLayout],
}

/// One field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldLayout {
    /// Its name.
    pub name: &'static str,
    /// What it says.
    pub meaning: &'static str,
    /// The integers it is made of.
    pub parts: &'static [Part],
}

impl Layout {
    /// How many bytes it takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let parts = self.fields.iter().flat_map(|f| f.parts);
        parts.fold(0, |sum, part| sum.saturating_add(usize::from(part.bytes)))
    }
}

macro_rules! messages {
    ($(#[$set_doc:meta])* $set:ident {
        $(
            $(#[doc = $doc:literal])*
            $id:literal $name:ident {
                $($(#[doc = $field_doc:literal])* $field:ident: $kind:ty,)*
            }
        )*
    }) => {
        $(
            $(#[doc = $doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $name {
                $($(#[doc = $field_doc])* pub $field: $kind,)*
            }
        )*

        $(#[$set_doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(clippy::large_enum_variant)]
        pub enum $set {
            $($(#[doc = $doc])* $name($name),)*
        }

        impl $set {
            /// How every one of them lies in its bytes.
            pub const LAYOUTS: &'static [Layout] = &[$(Layout {
                id: $id,
                name: stringify!($name),
                meaning: concat!($($doc),*),
                fields: &[$(FieldLayout {
                    name: stringify!($field),
                    meaning: concat!($($field_doc),*),
                    parts: <$kind as Field>::PARTS,
                },)*],
            },)*];

            /// Puts it into bytes.
            #[must_use]
            pub fn packet(&self) -> Packet {
                let mut bytes = Vec::new();
                let id = match self {
                    $(Self::$name(message) => {
                        $(message.$field.put(&mut bytes);)*
                        $id
                    })*
                };
                Packet { id, bytes }
            }

            /// Takes it from bytes.
            ///
            /// # Errors
            /// [`PacketError`]
            pub fn read(packet: &Packet) -> Result<Self, PacketError> {
                let id = packet.id;
                let mut rest = packet.bytes.as_slice();
                let got = rest.len();
                let message = match id {
                    $($id => {
                        let wanted =
                            0_usize $(.saturating_add(bytes_of(<$kind as Field>::PARTS)))*;
                        if got != wanted {
                            return Err(PacketError::Length { id, got });
                        }
                        Self::$name($name {
                            $($field: Field::take(&mut rest).ok_or(PacketError::Value(id))?,)*
                        })
                    })*
                    _ => return Err(PacketError::UnknownMessage(id)),
                };
                Ok(message)
            }
        }

        $(
            impl From<$name> for $set {
                fn from(message: $name) -> Self {
                    Self::$name(message)
                }
            }
        )*
    };
}

const fn bytes_of(parts: &[Part]) -> usize {
    let mut sum = 0_usize;
    let mut rest = parts;
    while let Some((first, others)) = rest.split_first() {
        sum = sum.saturating_add(first.bytes as usize);
        rest = others;
    }
    sum
}

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

messages! {
    /// What a robot says to its host.
    FromRobot {
        /// The robot lives.
        0x110 RobotBeat {
            /// The low half of the run that it hears.
            run_low: u16,
            /// The newest command it has taken of that run.
            number: Number,
            /// How it is.
            state: State,
            /// How that command has ended, or that it has not.
            outcome: Outcome,
        }
        /// The robot hears this run from now on, and has nothing of it yet.
        0x111 Welcome {
            /// The run.
            run: u32,
            /// Different after every start of the robot.
            boot: u16,
        }
        /// The command is begun.
        0x112 Accepted {
            /// Its name.
            id: Id,
        }
        /// The command is not begun.
        0x113 Refused {
            /// Its name.
            id: Id,
            /// Why.
            reason: Reason,
            /// A number that belongs to the reason.
            value: u32,
            /// The thing or measure that the reason speaks of.
            text: Text,
        }
        /// A motion of the command begins.
        0x114 Step {
            /// The command's name.
            id: Id,
            /// The motion's number, from 1.
            step: u8,
            /// How many the command has.
            steps: u8,
            /// What the arm does now.
            text: Text,
        }
        /// How far the command is.
        0x115 Progress {
            /// Its number.
            number: Number,
            /// The motion that is being done, from 1.
            step: u8,
            /// How many the command has.
            steps: u8,
            /// How much of the whole is done.
            percent: u8,
        }
        /// The command is done.
        0x116 Done {
            /// Its number.
            number: Number,
            /// The low half of its run.
            run_low: u16,
            /// How many of its motions have changed something.
            groups: u8,
        }
        /// The command was stopped on the way.
        0x117 Stopped {
            /// Its name.
            id: Id,
            /// How many of its motions have changed something.
            groups: u8,
            /// In which motion.
            text: Text,
        }
        /// The command failed on the way.
        0x119 Failed {
            /// Its name.
            id: Id,
            /// How many of its motions have changed something.
            groups: u8,
            /// What went wrong.
            fault: Fault,
            /// In words.
            text: Text,
        }
        /// The robot has a key, and the host that beats in clear is to show that it has the same.
        0x11a Challenge {
            /// What the robot has never said before.
            nonce: u64,
        }
        /// By the command, a thing is elsewhere now.
        0x120 Moved {
            /// Which.
            thing: Name,
            /// Where.
            place: Place,
        }
        /// By the command, a thing is different now.
        0x121 Became {
            /// Which.
            thing: Name,
            /// In which feature.
            feature: u8,
            /// The feature's likelihood in 255ths.
            likelihood: u8,
        }
        /// All that one motion of the command changed has been told.
        0x122 Changed {
            /// The command's number.
            number: Number,
            /// The low half of its run.
            run_low: u16,
            /// How many motions of the command have changed something, this one included.
            group: u8,
            /// How many things it has told.
            changes: u8,
        }
        /// How the arm stands: joints 1 to 3, counted from the base.
        0x130 Joints123 {
            /// Angle of joint 1.
            joint1: Angle,
            /// Angle of joint 2.
            joint2: Angle,
            /// Angle of joint 3.
            joint3: Angle,
        }
        /// How the arm stands: joints 4 to 6.
        0x131 Joints456 {
            /// Angle of joint 4.
            joint4: Angle,
            /// Angle of joint 5.
            joint5: Angle,
            /// Angle of joint 6.
            joint6: Angle,
        }
        /// How the arm stands: joint 7 and the gripper.
        0x132 Joint7Gripper {
            /// Angle of joint 7.
            joint7: Angle,
            /// How far the fingers are apart.
            width: Quantity,
            /// What is between them.
            held: Name,
        }
    }
}
