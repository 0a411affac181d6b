//! A Franka Emika Panda's control as far as the bridge speaks with it, FCI version 5, on loopback: an
//! arm that follows joint positions exactly and a hand that always finds something, with troubles that
//! a test asks for. It is built from the message types of `franka-rs`; that crate's own test server is
//! not part of what it publishes.
#![allow(dead_code)]

#[path = "requests.rs"]
mod requests;

use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

use franka::wire::HeaderLayout;
use franka::wire::gripper::{GripperCommand, GripperStatus};
use franka::wire::robot::v5;
use requests::{receive, respond};
use zerocopy::{FromBytes, IntoBytes};

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
    mode: v5::RobotMode,
    reflex: Option<usize>,
    client: Option<SocketAddr>,
    stream: Option<TcpStream>,
    hand: Option<TcpStream>,
    /// The request that started the motion that is under way.
    moving: Option<u32>,
}

/// The arm.
#[derive(Clone)]
pub struct Fer {
    pub arm: String,
    pub hand: String,
    state: Arc<Mutex<State>>,
}

/// The FCI's ready posture, which is within the limits of both arms.
const READY: [f64; 7] = deictic::robot::panda::READY;

impl Fer {
    pub fn start() -> Self {
        let arm = TcpListener::bind("127.0.0.1:0").unwrap();
        let hand = TcpListener::bind("127.0.0.1:0").unwrap();
        let fer = Self {
            arm: arm.local_addr().unwrap().to_string(),
            hand: hand.local_addr().unwrap().to_string(),
            state: Arc::new(Mutex::new(State {
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
            })),
        };
        let (a, b, c) = (fer.clone(), fer.clone(), fer.clone());
        std::thread::spawn(move || a.serve_arm(&arm));
        std::thread::spawn(move || b.serve_hand(&hand));
        std::thread::spawn(move || c.cycle());
        fer
    }

    pub fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap()
    }

    pub fn trouble(&self, trouble: Trouble) {
        let mut state = self.state();
        state.trouble = trouble;
        state.cycles = 0;
        state.mode = match trouble {
            Trouble::Pressed => v5::RobotMode::UserStopped,
            _ if state.mode == v5::RobotMode::UserStopped => v5::RobotMode::Idle,
            _ => state.mode,
        };
    }

    fn serve_arm(&self, listener: &TcpListener) {
        for mut stream in listener.incoming().flatten() {
            let layout = HeaderLayout::Robot;
            while let Some((command, id, payload)) = receive(&mut stream, layout) {
                self.arm_request(&mut stream, command, id, &payload);
            }
            let mut state = self.state();
            (state.client, state.stream, state.moving) = (None, None, None);
        }
    }

    fn arm_request(&self, stream: &mut TcpStream, command: u32, id: u32, payload: &[u8]) {
        let mut state = self.state();
        let answer = |stream: &mut TcpStream, payload: &[u8]| {
            respond(stream, HeaderLayout::Robot, command, id, payload);
        };
        match v5::Command::from_u32(command).unwrap() {
            v5::Command::Connect => {
                let version = u16::from_le_bytes([payload[0], payload[1]]);
                if version != v5::ROBOT_VERSION {
                    answer(stream, &[1, 5, 0]);
                    return;
                }
                let port = u16::from_le_bytes([payload[2], payload[3]]);
                state.connections += 1;
                state.client = Some(SocketAddr::from(([127, 0, 0, 1], port)));
                state.stream = Some(stream.try_clone().unwrap());
                answer(stream, &[0, 5, 0]);
            }
            v5::Command::Move => {
                state.moving = Some(id);
                state.mode = v5::RobotMode::Move;
                answer(stream, &[v5::MoveStatus::MotionStarted as u8]);
            }
            v5::Command::StopMove => {
                answer(stream, &[0]);
                if state.moving.is_some() {
                    state.end_move(v5::MoveStatus::Preempted, v5::RobotMode::Idle);
                }
            }
            v5::Command::AutomaticErrorRecovery => {
                (state.mode, state.reflex) = (v5::RobotMode::Idle, None);
                state.recovered += 1;
                answer(stream, &[0]);
            }
            v5::Command::SetCollisionBehavior => {
                state.collision_behaviour += 1;
                answer(stream, &[0]);
            }
            v5::Command::SetLoad => {
                let mass = payload.first_chunk().copied().unwrap_or_default();
                state.loads.push(f64::from_le_bytes(mass));
                answer(stream, &[0]);
            }
            _ => answer(stream, &[0]),
        }
    }

    fn serve_hand(&self, listener: &TcpListener) {
        for mut stream in listener.incoming().flatten() {
            self.state().hand = stream.try_clone().ok();
            let layout = HeaderLayout::Gripper;
            while let Some((command, id, _)) = receive(&mut stream, layout) {
                let empty = self.state().trouble == Trouble::EmptyHand;
                let kind = u16::try_from(command).ok();
                let payload = match kind.and_then(GripperCommand::from_u16).unwrap() {
                    GripperCommand::Connect => vec![0, 0, 3, 0],
                    GripperCommand::Grasp if empty => {
                        GripperStatus::Unsuccessful.to_u16().to_le_bytes().to_vec()
                    }
                    _ => GripperStatus::Success.to_u16().to_le_bytes().to_vec(),
                };
                respond(&mut stream, layout, command, id, &payload);
            }
        }
    }

    /// A thousand times a second the arm says how it stands and hears where to go.
    fn cycle(&self) {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        socket
            .set_read_timeout(Some(Duration::from_millis(5)))
            .unwrap();
        let mut number = 0_u64;
        let mut buffer = [0; size_of::<v5::RobotCommand>()];
        loop {
            number += 1;
            let told = self.state().tell(number);
            let Some((client, datagram, moving)) = told else {
                std::thread::sleep(Duration::from_millis(1));
                continue;
            };
            let _ = socket.send_to(&datagram, client);
            if !moving {
                std::thread::sleep(Duration::from_millis(1));
                continue;
            }
            if let Ok((n, _)) = socket.recv_from(&mut buffer)
                && let Ok(command) = v5::RobotCommand::read_from_bytes(&buffer[..n])
            {
                self.state().follow(&command);
            }
        }
    }
}

impl State {
    fn tell(&mut self, number: u64) -> Option<(SocketAddr, Vec<u8>, bool)> {
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

    fn follow(&mut self, command: &v5::RobotCommand) {
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

    fn end_move(&mut self, status: v5::MoveStatus, mode: v5::RobotMode) {
        self.mode = mode;
        (self.dq, self.ddq) = ([0.0; 7], [0.0; 7]);
        if let (Some(id), Some(stream)) = (self.moving.take(), &mut self.stream) {
            let command = v5::Command::Move.to_u32();
            respond(stream, HeaderLayout::Robot, command, id, &[status as u8]);
        }
    }
}
