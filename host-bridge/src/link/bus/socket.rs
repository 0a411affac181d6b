//! A Linux CAN interface, through SocketCAN.

use std::io::{self, ErrorKind};
use std::time::{Duration, Instant};

use deictic_core::can::Frame;
use socketcan::{
    CanError, CanFrame, CanSocket, EmbeddedFrame, ErrorCause, Id, Socket as _, SocketOptions,
    StandardId,
};

use super::{Bus, BusFault};

/// For how long a full queue may refuse a frame: at 125 kbit/s the ten frames that an interface
/// queues by default take 10 ms, through an adapter at 115,200 baud 20 ms and its waits; the robot's
/// patience with its host is longer.
const FULL: Duration = Duration::from_millis(250);

/// How long to wait before a full queue is tried again: a frame at 1 Mbit/s takes 0.13 ms.
const AGAIN: Duration = Duration::from_micros(200);

/// `ENOBUFS`, which the standard library has no name for.
const NO_BUFFERS: i32 = 105;
/// `ENETDOWN`: the interface is switched off. `ENODEV` and `ENXIO`: it is gone.
const DOWN: [i32; 3] = [100, 19, 6];

/// An open interface.
pub struct Socket {
    socket: CanSocket,
    arbitration_lost: u64,
}

impl Socket {
    /// Opens the interface of this name.
    ///
    /// # Errors
    /// When there is no such interface, or no CAN in the kernel.
    pub fn open(interface: &str) -> io::Result<Self> {
        let socket = CanSocket::open(interface)?;
        socket.set_nonblocking(true)?;
        socket.set_error_filter_accept_all()?;
        Ok(Self {
            socket,
            arbitration_lost: 0,
        })
    }

    /// How often another node went first, as far as the controller tells. It sends again by itself.
    #[must_use]
    pub fn arbitration_lost(&self) -> u64 {
        self.arbitration_lost
    }

    /// What the controller reports; most of it mends itself.
    fn report(&mut self, error: CanError) -> io::Result<()> {
        for cause in error {
            match cause {
                ErrorCause::BusOff => return Err(BusFault::Off.into()),
                ErrorCause::LostArbitration(_) => {
                    self.arbitration_lost = self.arbitration_lost.saturating_add(1);
                }
                _ => {}
            }
        }
        Ok(())
    }
}

fn named(error: io::Error) -> io::Error {
    match error.raw_os_error() {
        Some(code) if DOWN.contains(&code) => BusFault::Down.into(),
        _ => error,
    }
}

impl Bus for Socket {
    fn send(&mut self, frame: &Frame) -> io::Result<()> {
        let id = StandardId::new(frame.id()).ok_or(ErrorKind::InvalidInput)?;
        let frame = CanFrame::new(id, frame.data()).ok_or(ErrorKind::InvalidInput)?;
        let until = Instant::now() + FULL;
        loop {
            match self.socket.write_frame(&frame) {
                Ok(()) => return Ok(()),
                Err(error)
                    if error.raw_os_error() == Some(NO_BUFFERS)
                        || error.kind() == ErrorKind::WouldBlock =>
                {
                    if Instant::now() >= until {
                        return Err(BusFault::Full.into());
                    }
                    std::thread::sleep(AGAIN);
                }
                Err(error) => return Err(named(error)),
            }
        }
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Frame>> {
        let until = Instant::now() + patience;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            let read = if left.is_zero() {
                self.socket.read_frame()
            } else {
                self.socket.read_frame_timeout(left)
            };
            match read {
                Ok(CanFrame::Data(frame)) => {
                    if let Id::Standard(id) = frame.id() {
                        return Ok(Frame::new(id.as_raw(), frame.data()));
                    }
                }
                Ok(CanFrame::Remote(_)) => {}
                Ok(CanFrame::Error(error)) => self.report(error.into())?,
                Err(error)
                    if matches!(
                        error.kind(),
                        ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted
                    ) =>
                {
                    if Instant::now() >= until {
                        return Ok(None);
                    }
                }
                Err(error) => return Err(named(error)),
            }
        }
    }
}
