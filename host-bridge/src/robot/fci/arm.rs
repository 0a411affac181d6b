//! One connection to an arm and its hand: it reads how the arm stands and follows one motion.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use franka::{
    ControllerMode, FciVersion, Gripper, JointPositions, MAX_CUTOFF_FREQUENCY, RealtimeConfig,
    RobotMode, RobotOptions, RobotState,
};

use super::FciFault;
use super::brakes::{Brakes, Braking};
use crate::robot::panda::{FR3, Joints, Limits, OPEN, PANDA, Trajectory, apart, hand};

/// External torques at which the arm stops, in Nm, and forces, in N and Nm: those of the maker's
/// examples, about what a person's hand takes without harm (ISO/TS 15066, table A.2).
const TORQUES: Joints = [20.0, 20.0, 18.0, 18.0, 16.0, 14.0, 12.0];
const FORCES: [f64; 6] = [20.0, 20.0, 20.0, 25.0, 25.0, 25.0];

/// How fast the fingers go, in m/s, and how hard they grip, in N.
const FINGER_SPEED: f64 = 0.1;
const GRIP: f64 = 20.0;

/// How far the arm may stand from where a motion begins, in radians.
const ELSEWHERE: f64 = 0.05;

/// How far the hand may be from where a motion ends, in metres.
const OFF: f64 = 5e-3;

/// How near it has to come before the arm is let go of, in metres: as soon as a motion is finished,
/// the arm holds what it measures, and no longer what was commanded.
const NEAR: f64 = 1e-3;

/// How long it may take to come that near, in seconds.
const PATIENCE: f64 = 1.0;

/// The longest step in time that one command makes, in seconds: after lost cycles the arm goes on from
/// where it waits, instead of leaping to where it would have been.
const STRIDE: f64 = 5e-3;

/// How many states the hand may take to come to rest: one a millisecond.
const SETTLING: usize = 500;

/// How far the finger tips are from the flange, in metres (Franka Hand, data sheet).
const TIPS: f64 = 0.1034;

/// How large a thing in the hand is thought to be: a ball's radius, in metres.
const BALL: f64 = 0.03;

/// Where an arm is.
#[derive(Clone, Debug)]
pub(super) struct Host {
    pub arm: String,
    pub hand: String,
    /// Whether this machine must do real time.
    pub realtime: bool,
}

/// A connected arm.
pub(super) struct Arm {
    robot: franka::Robot,
    /// The hand; another thread may stop its fingers.
    pub hand: Arc<Gripper>,
}

impl Arm {
    /// Connects to the arm and makes it yield to what it touches.
    pub fn connect(host: &Host) -> Result<Self, FciFault> {
        let realtime = if host.realtime {
            RealtimeConfig::Enforce
        } else {
            RealtimeConfig::Ignore
        };
        let robot = franka::Robot::with_options(&host.arm, RobotOptions::new(realtime))?;
        let hand = Arc::new(Gripper::new(&host.hand)?);
        let state = robot.read_once()?;
        if state.robot_mode == RobotMode::Reflex {
            robot.automatic_error_recovery()?;
        }
        robot.set_collision_behavior_simple(TORQUES, TORQUES, FORCES, FORCES)?;
        Ok(Self { robot, hand })
    }

    /// What its joints can do: a Panda speaks version 5, a Research 3 version 10.
    pub fn limits(&self) -> Limits {
        match self.robot.fci_version() {
            FciVersion::V5 => PANDA,
            FciVersion::V10 => FR3,
        }
    }

    /// How it stands.
    pub fn joints(&self) -> Result<Joints, FciFault> {
        Ok(self.robot.read_once()?.q)
    }

    /// Recovers from a reflex, or says why it cannot move.
    pub fn ready(&self) -> Result<(), FciFault> {
        match self.robot.read_once()?.robot_mode {
            RobotMode::Idle | RobotMode::Move => Ok(()),
            RobotMode::Reflex => Ok(self.robot.automatic_error_recovery()?),
            RobotMode::UserStopped => Err(FciFault::EmergencyStop),
            mode => Err(FciFault::NotReady(mode)),
        }
    }

    /// Follows a trajectory to its end, or as far as the brakes let it; `seen` gets every posture on the
    /// way. `true` when it reached the end.
    pub fn follow(
        &self,
        trajectory: &Trajectory,
        brakes: &Brakes<'_>,
        mut seen: impl FnMut(Joints),
    ) -> Result<bool, FciFault> {
        if trajectory.duration() <= 0.0 {
            return Ok(!brakes.stop.load(Ordering::Relaxed));
        }
        if apart(&self.joints()?, &trajectory.at(0.0)) > ELSEWHERE {
            return Err(FciFault::Elsewhere);
        }
        let version = self.robot.fci_version();
        let mut start: Option<Joints> = None;
        let (mut time, mut braking) = (0.0, Braking::default());
        let mut reached = false;
        let end = hand(&trajectory.path().end()).translation.vector;
        let step = |state: &RobotState, period: franka::Duration| {
            // The reference that the arm holds the first command against differs (libfranka 0.9 and
            // 0.21: `convertMotion`).
            let stands = match version {
                FciVersion::V5 => state.q_d,
                FciVersion::V10 => state.q,
            };
            let start = *start.get_or_insert(stands);
            let period = period.as_secs_f64().min(STRIDE);
            time += braking.passed(brakes, period);
            let fading = 1.0 - trajectory.part(time);
            let mut q = trajectory.at(time);
            let begin = trajectory.at(0.0);
            for ((q, start), begin) in q.iter_mut().zip(&start).zip(&begin) {
                *q += fading * (start - begin);
            }
            seen(state.q);
            let late = time - trajectory.duration();
            reached = late >= PATIENCE || (late >= 0.0 && off(&state.q, &end) < NEAR);
            let mut command = JointPositions::new(q);
            command.motion_finished = reached || braking.stopped(brakes);
            command
        };
        let mode = ControllerMode::JointImpedance;
        self.robot
            .control_joint_positions(step, mode, true, MAX_CUTOFF_FREQUENCY)?;
        Ok(reached)
    }

    /// Waits until the hand is where a motion was to end; gives how the arm stands then.
    pub fn settle(&self, end: &Joints) -> Result<Joints, FciFault> {
        let wanted = hand(end).translation.vector;
        let mut last = f64::INFINITY;
        for _ in 0..SETTLING {
            let joints = self.joints()?;
            last = off(&joints, &wanted);
            if last < OFF {
                return Ok(joints);
            }
        }
        Err(FciFault::Missed(last * 1e3))
    }

    /// The hand carries so much from now on, in kilograms: the arm's controller makes up for its weight, and does not take
    /// it for a collision. Thought of as a ball between the finger tips.
    pub fn carries(&self, kilograms: f32) -> Result<(), FciFault> {
        let mass = f64::from(kilograms);
        let inertia = 0.4 * mass * BALL * BALL;
        let mut about = [0.0; 9];
        for axis in about.iter_mut().step_by(4) {
            *axis = inertia;
        }
        Ok(self.robot.set_load(mass, [0.0, 0.0, TIPS], about)?)
    }

    /// Opens or shuts the fingers, or closes them on a thing about so wide.
    pub fn fingers(&self, apart: f64) -> Result<(), FciFault> {
        let done = if apart > 0.0 && apart < OPEN {
            let grasped = self.hand.grasp(apart, FINGER_SPEED, GRIP, apart, OPEN)?;
            if !grasped {
                return Err(FciFault::EmptyGrasp);
            }
            true
        } else {
            self.hand.move_gripper(apart, FINGER_SPEED)?
        };
        if done {
            Ok(())
        } else {
            Err(FciFault::Other("the hand did not finish".into()))
        }
    }
}

/// How far the hand is from a place, in metres.
fn off(joints: &Joints, place: &nalgebra::Vector3<f64>) -> f64 {
    (hand(joints).translation.vector - place).norm()
}
