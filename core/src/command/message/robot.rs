//! What a robot says to its host.

use heapless::Vec;

use super::{FieldLayout, Layout, bytes_of};
use crate::command::code::{Fault, Outcome, Reason, State};
use crate::command::field::{Angle, Field, Id, Name, Number, Place, Quantity, Text};
use crate::command::{Packet, PacketError};

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
