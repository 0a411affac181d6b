//! What can go wrong with an arm on its own network interface.

use franka::{FrankaError, MoveStatus, RobotMode};
use thiserror::Error;

use crate::robot::Fault;

/// The arm's reflexes to touching something.
const COLLISIONS: [&str; 3] = [
    "joint_reflex",
    "cartesian_reflex",
    "force_control_safety_violation",
];

/// The arm's complaint about commands that came too late or not at all.
const LATE: &str = "communication_constraints_violation";

/// Why the arm did not do, or did not finish, what it was told.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FciFault {
    /// It cannot be reached, or the connection broke.
    #[error("the arm cannot be reached: {0}")]
    Unreachable(String),
    /// It speaks another version of the interface.
    #[error("the arm speaks version {robot} of its interface, and 5 and 10 are known here")]
    Version {
        /// The version it speaks.
        robot: u16,
    },
    /// The machine cannot keep up with a thousand commands a second.
    #[error("this machine does not do real time: {0}")]
    Realtime(String),
    /// It touched something and stopped.
    #[error("the arm ran into something ({})", .0.join(", "))]
    Collision(Vec<&'static str>),
    /// It was to leave its limits and stopped.
    #[error("the arm stopped at a limit ({})", .0.join(", "))]
    Limit(Vec<&'static str>),
    /// Commands came too late, and it stopped.
    #[error("the arm missed too many commands and stopped")]
    Late,
    /// Somebody pressed the stop, or a safety function stopped it.
    #[error("the arm's stop was pressed")]
    EmergencyStop,
    /// It is not ready to move.
    #[error("the arm is not ready to move: it is in mode {0:?}")]
    NotReady(RobotMode),
    /// It stands elsewhere than it was left.
    #[error("the arm was moved meanwhile")]
    Elsewhere,
    /// The hand is not where the motion was to end.
    #[error("the hand is {0:.0} mm from where it should be")]
    Missed(f64),
    /// The hand closed and there is nothing in it.
    #[error("the hand closed on nothing")]
    EmptyGrasp,
    /// Anything else, in the interface's own words.
    #[error("{0}")]
    Other(String),
}

impl FciFault {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Unreachable(_) => {
                "check the cable to the arm's control, its address, and that the interface (FCI) \
                 is activated in Desk; the bridge keeps trying"
            }
            Self::Version { .. } => "update the arm's system image, or the bridge",
            Self::Realtime(_) => {
                "run a PREEMPT_RT kernel with real-time rights, or write fci:HOST,no-realtime and \
                 accept that the arm may stop for late commands"
            }
            Self::Collision(_) => "clear its way; the next command makes the arm recover",
            Self::Limit(_) => "move the thing nearer to the arm's middle, and say it again",
            Self::Late => {
                "keep other load off this machine and off the network to the arm, and say it again"
            }
            Self::EmergencyStop => "release the stop when it is safe, and say it again",
            Self::NotReady(_) => "close the brakes' locks and leave guiding mode in Desk",
            Self::Elsewhere => "say it again",
            Self::Missed(_) => "see whether something holds the arm, and say it again",
            Self::EmptyGrasp => "put the thing where the scene says it is, and say it again",
            Self::Other(_) => "look into Desk for what the arm reports",
        }
    }

    /// Its kind, as a robot reports it.
    #[must_use]
    pub fn code(&self) -> Fault {
        match self {
            Self::Collision(_) => Fault::Collision,
            Self::Limit(names) if names.iter().any(|name| name.contains("velocity")) => {
                Fault::SpeedLimit
            }
            Self::Limit(_) => Fault::JointLimit,
            Self::EmptyGrasp => Fault::GraspLost,
            Self::Late => Fault::HostLost,
            Self::Unreachable(_) => Fault::RobotLost,
            _ => Fault::Other,
        }
    }

    /// Whether the connection is gone with it.
    pub(super) fn cuts(&self) -> bool {
        matches!(self, Self::Unreachable(_))
    }
}

impl From<FrankaError> for FciFault {
    fn from(error: FrankaError) -> Self {
        match error {
            FrankaError::Network(why) | FrankaError::Protocol(why) => Self::Unreachable(why),
            FrankaError::IncompatibleVersion { server_version, .. } => Self::Version {
                robot: server_version,
            },
            FrankaError::Realtime(why) => Self::Realtime(why),
            FrankaError::Control(exception) => {
                let names = exception.last_motion_errors.names();
                let is = |status| exception.move_status == Some(status);
                let of = |kinds: &[&str]| names.iter().any(|name| kinds.contains(name));
                if is(MoveStatus::EmergencyAborted)
                    || is(MoveStatus::PreemptedDueToActivatedSafetyFunctions)
                    || is(MoveStatus::CommandRejectedDueToActivatedSafetyFunctions)
                {
                    Self::EmergencyStop
                } else if of(&COLLISIONS) {
                    Self::Collision(names)
                } else if of(&[LATE]) {
                    Self::Late
                } else if !names.is_empty() {
                    Self::Limit(names)
                } else {
                    Self::Other(exception.message)
                }
            }
            FrankaError::Command(why)
            | FrankaError::InvalidOperation(why)
            | FrankaError::InvalidArgument(why)
            | FrankaError::Model(why) => Self::Other(why),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use franka::{ControlException, ERROR_NAMES, Errors};

    fn reflex(name: &str, status: MoveStatus) -> FciFault {
        let mut exception = ControlException::new("aborted");
        exception.move_status = Some(status);
        let mut flags = [false; ERROR_NAMES.len()];
        if let Some(at) = Errors::index_of(name) {
            flags[at] = true;
        }
        exception.last_motion_errors = Errors::from(flags);
        FrankaError::Control(exception).into()
    }

    #[test]
    fn every_reflex_of_the_arm_becomes_a_fault_of_its_kind() {
        for name in ERROR_NAMES {
            let fault = reflex(name, MoveStatus::ReflexAborted);
            let known = match fault {
                FciFault::Collision(_) => COLLISIONS.contains(&name),
                FciFault::Late => name == LATE,
                FciFault::Limit(_) => !COLLISIONS.contains(&name) && name != LATE,
                _ => false,
            };
            assert!(known, "{name}: {fault}");
            assert!(!fault.remedy().is_empty());
        }
    }

    #[test]
    fn a_pressed_stop_is_told_from_a_reflex() {
        let fault = reflex("joint_reflex", MoveStatus::EmergencyAborted);
        assert_eq!(fault, FciFault::EmergencyStop);
        let quiet = reflex("", MoveStatus::Aborted);
        assert_eq!(quiet, FciFault::Other("aborted".into()));
        let gone = FciFault::from(FrankaError::Network("reset".into()));
        assert!(gone.cuts() && !FciFault::Late.cuts());
    }
}
