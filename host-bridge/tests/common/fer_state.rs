//! How the arm of a Franka Emika Panda stands and moves, as its interface tells it.

use std::net::{SocketAddr, TcpStream};

use franka::wire::HeaderLayout;
use franka::wire::robot::v5;
use zerocopy::IntoBytes;

use super::requests::respond;

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// Nothing.
    None,
    /// A reflex with this place among the errors, after so many cycles of motion.
    Reflex(usize, u32),
    /// The connection is cut after so many cycles of motion.
    Cut(u32),
    /// No state comes any more after so many cycles of motion.
    Silent(u32),
    /// Commands are lost after so many cycles of motion, up to the end of that motion.
    Short(u32),
    /// The hand finds nothing to grasp.
    EmptyHand,
    /// The user stop is pressed.
    Pressed,
}

/// The arm's side.
pub struct State {
    pub trouble: Trouble,
    pub q: [f64; 7],
    /// How fast it goes and how much faster it gets, as commanded: what the next command is limited by.
    dq: [f64; 7],
    ddq: [f64; 7],
    /// Cycles in which the arm was commanded.
    pub cycles: u32,
    /// The fastest any joint went, in rad per cycle.
    pub fastest: f64,
    /// The number of the last state that was told.
    pub told: u64,
    /// Which state a command answered, and how far it took the fastest joint, in rad.
    pub strides: Vec<(u64, f64)>,
    pub recovered: u32,
    pub collision_behaviour: u32,
    pub connections: u32,
    /// What it was told that it carries, in kilograms, one after the other.
    pub loads: Vec<f64>,
    pub mode: v5::RobotMode,
    pub reflex: Option<usize>,
    pub client: Option<SocketAddr>,
    pub stream: Option<TcpStream>,
    pub hand: Option<TcpStream>,
    /// The request that started the motion that is under way.
    pub moving: Option<u32>,
}

/// The FCI's ready posture, which is within the limits of both arms.
const READY: [f64; 7] = deictic::robot::panda::READY;

impl State {
    /// At rest, in the ready posture.
    pub fn new() -> Self {
        Self {
            trouble: Trouble::None,
            q: READY,
            dq: [0.0; 7],
            ddq: [0.0; 7],
            cycles: 0,
            fastest: 0.0,
            told: 0,
            strides: Vec::new(),
            recovered: 0,
            collision_behaviour: 0,
            connections: 0,
            loads: Vec::new(),
            mode: v5::RobotMode::Idle,
            reflex: None,
            client: None,
            stream: None,
            hand: None,
            moving: None,
        }
    }

    pub fn tell(&mut self, number: u64) -> Option<(SocketAddr, Vec<u8>, bool)> {
        let client = self.client?;
        self.told = number;
        match self.trouble {
            Trouble::Reflex(error, after) if self.cycles > after && self.moving.is_some() => {
                self.reflex = Some(error);
                self.end_move(v5::MoveStatus::ReflexAborted, v5::RobotMode::Reflex);
                self.trouble = Trouble::None;
            }
            Trouble::Cut(after) if self.cycles > after => {
                for stream in [self.stream.take(), self.hand.take()].into_iter().flatten() {
                    let _ = stream.shutdown(std::net::Shutdown::Both);
                }
                self.trouble = Trouble::None;
                return None;
            }
            Trouble::Silent(after) if self.cycles > after => return None,
            _ => {}
        }
        let moving = self.moving.is_some();
        let mut state = v5::RobotState {
            message_id: number.into(),
            robot_mode: self.mode.to_u8(),
            motion_generator_mode: if moving {
                v5::MotionGeneratorMode::JointPosition.to_u8()
            } else {
                v5::MotionGeneratorMode::Idle.to_u8()
            },
            controller_mode: v5::ControllerMode::JointImpedance.to_u8(),
            q: self.q.map(Into::into),
            q_d: self.q.map(Into::into),
            dq_d: self.dq.map(Into::into),
            ddq_d: self.ddq.map(Into::into),
            ..v5::RobotState::default()
        };
        if let Some(error) = self.reflex {
            state.reflex_reason[error] = 1;
            state.errors[error] = 1;
        }
        Some((client, state.as_bytes().to_vec(), moving))
    }

    pub fn follow(&mut self, command: &v5::RobotCommand) {
        if self.moving.is_none() {
            return;
        }
        self.cycles += 1;
        let short = matches!(self.trouble, Trouble::Short(after) if self.cycles > after);
        let to = if short {
            self.q
        } else {
            command.motion.q_c.map(f64::from)
        };
        let apart = self.q.iter().zip(&to).map(|(a, b)| (a - b).abs());
        let stride = apart.fold(0.0, f64::max);
        self.fastest = self.fastest.max(stride);
        self.strides.push((command.message_id.into(), stride));
        for (i, to) in to.into_iter().enumerate() {
            let speed = (to - self.q[i]) * 1e3;
            self.ddq[i] = (speed - self.dq[i]) * 1e3;
            (self.q[i], self.dq[i]) = (to, speed);
        }
        if command.motion.motion_generation_finished != 0 {
            if short {
                self.trouble = Trouble::None;
            }
            self.end_move(v5::MoveStatus::Success, v5::RobotMode::Idle);
        }
    }

    pub fn end_move(&mut self, status: v5::MoveStatus, mode: v5::RobotMode) {
        self.mode = mode;
        (self.dq, self.ddq) = ([0.0; 7], [0.0; 7]);
        if let (Some(id), Some(stream)) = (self.moving.take(), &mut self.stream) {
            let command = v5::Command::Move.to_u32();
            respond(stream, HeaderLayout::Robot, command, id, &[status as u8]);
        }
    }
}
