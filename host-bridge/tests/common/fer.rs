//! A Franka Emika Panda's control as far as the bridge speaks with it, FCI version 5, on loopback: an
//! arm that follows joint positions exactly and a hand that always finds something, with troubles that
//! a test asks for. It is built from the message types of `franka-rs`; that crate's own test server is
//! not part of what it publishes.
#![allow(dead_code)]

#[path = "fer_state.rs"]
mod fer_state;
#[path = "requests.rs"]
mod requests;

use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

use franka::wire::HeaderLayout;
use franka::wire::gripper::{GripperCommand, GripperStatus};
use franka::wire::robot::v5;
use requests::{receive, respond};
use zerocopy::FromBytes;

pub use fer_state::{State, Trouble};

/// The arm.
#[derive(Clone)]
pub struct Fer {
    pub arm: String,
    pub hand: String,
    state: Arc<Mutex<State>>,
}

impl Fer {
    pub fn start() -> Self {
        let arm = TcpListener::bind("127.0.0.1:0").unwrap();
        let hand = TcpListener::bind("127.0.0.1:0").unwrap();
        let fer = Self {
            arm: arm.local_addr().unwrap().to_string(),
            hand: hand.local_addr().unwrap().to_string(),
            state: Arc::new(Mutex::new(State::new())),
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
