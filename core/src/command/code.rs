//! Numbered choices.

use heapless::Vec;

use super::LONGEST;
use super::field::{Field, Part};

macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$each:meta])* $choice:ident = $number:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        pub enum $name {
            $($(#[$each])* $choice = $number,)*
        }

        impl $name {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$choice),*];
        }

        impl Field for $name {
            const PARTS: &'static [Part] =
                &[Part::choice(&[$((stringify!($choice), $number)),*])];

            fn put(&self, to: &mut Vec<u8, LONGEST>) {
                (*self as u8).put(to);
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                match u8::take(from)? {
                    $($number => Some(Self::$choice),)*
                    _ => None,
                }
            }
        }
    };
}

choice! {
    /// What the arm is to do.
    Motion {
        /// Raise the hand by the distance.
        MoveUp = 1,
        /// Set down what the hand holds and let go.
        Release = 2,
        /// Stand still.
        Stop = 3,
        /// Grasp the object and lift it.
        Pick = 4,
        /// Push the object along the table, by the distance into the direction.
        Push = 5,
        /// Twist a glued object loose.
        Unglue = 6,
        /// Tilt the object over the storage, by the angle.
        Pour = 7,
        /// Put the object into the storage.
        PutInto = 8,
        /// Put the object onto the storage.
        Stack = 9,
    }
}

choice! {
    /// A direction in the robot's base frame.
    Direction {
        /// Not given.
        None = 0,
        /// +y.
        Left = 1,
        /// -y.
        Right = 2,
        /// +z.
        Up = 3,
        /// -z.
        Down = 4,
        /// +x.
        Forward = 5,
        /// -x.
        Back = 6,
    }
}

choice! {
    /// Why a robot does not begin a command. Nothing has moved.
    Reason {
        /// It is doing another one.
        Busy = 1,
        /// It has had this one, or a later one of the same run, before.
        Repeated = 2,
        /// It knows another scene; the value is its version.
        StaleScene = 3,
        /// It does not know such a motion.
        UnknownMotion = 4,
        /// Something that the motion takes is not given.
        Missing = 5,
        /// The thing is not in the scene.
        NotHere = 6,
        /// The thing is glued.
        Glued = 7,
        /// The thing is not glued.
        NotGlued = 8,
        /// The thing, or where it is to go, is out of reach.
        OutOfReach = 9,
        /// Something stands on the thing.
        Covered = 10,
        /// The thing takes nothing more.
        Full = 11,
        /// There is nothing in the thing.
        Empty = 12,
        /// The thing is not as the motion needs it.
        Unfit = 13,
        /// The hand holds something else.
        Holding = 14,
        /// The hand holds nothing.
        NothingHeld = 15,
        /// A distance or an angle is beyond what the arm does in one motion.
        TooFar = 16,
        /// The robot is held; it is to be resumed or stopped first.
        Held = 17,
        /// The robot has a fault that is to be cleared first.
        Faulted = 18,
        /// Its vocabulary is another one.
        OtherVocabulary = 19,
        /// For another reason, which the text says.
        Other = 20,
        /// Another thing is in the way.
        InTheWay = 21,
    }
}

choice! {
    /// What went wrong on the way.
    Fault {
        /// The arm has met something.
        Collision = 1,
        /// A joint has reached its limit.
        JointLimit = 2,
        /// The arm is too fast, or was asked to be.
        SpeedLimit = 3,
        /// The thing slipped out of the hand, or was not there.
        GraspLost = 4,
        /// The host was not heard for too long.
        HostLost = 5,
        /// The robot was not heard for too long.
        RobotLost = 6,
        /// The robot has started anew in the middle.
        Restarted = 7,
        /// What the robot has told of the table is not complete.
        ReportLost = 8,
        /// For another reason, which the text says.
        Other = 9,
    }
}

choice! {
    /// How a robot is.
    State {
        /// It stands still and takes a command.
        Ready = 1,
        /// It is doing a command.
        Moving = 2,
        /// It is held in the middle of a command.
        Held = 3,
        /// It has a fault that is to be cleared.
        Faulted = 4,
        /// It does not hear its host, and stands still.
        Alone = 5,
    }
}

choice! {
    /// How the command of a name has ended, or that it has not.
    Outcome {
        /// The robot has not had any command of this run.
        Nothing = 0,
        /// It is being done.
        Running = 1,
        /// It is done.
        Done = 2,
        /// It was refused.
        Refused = 3,
        /// It was stopped.
        Stopped = 4,
        /// It failed.
        Failed = 5,
        /// The number was passed over, so it will never be done.
        Void = 6,
    }
}
