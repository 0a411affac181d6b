//! A Linux CAN interface, through SocketCAN.

use std::io::{self, ErrorKind};
use std::time::{Duration, Instant};

use deictic_core::can::{FlexibleFrame, Frame};
use socketcan::frame::AsPtr;
use socketcan::{
    CanAnyFrame, CanDataFrame, CanError, CanFdFrame, CanFdSocket, EmbeddedFrame, ErrorCause, Id,
    Socket as _, SocketOptions, StandardId,
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
    socket: CanFdSocket,
    arbitration_lost: u64,
}

impl Socket {
    /// Opens the interface of this name.
    ///
    /// # Errors
    /// When there is no such interface, or no CAN in the kernel.
    pub fn open(interface: &str) -> io::Result<Self> {
        let socket = CanFdSocket::open(interface)?;
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

impl Socket {
    fn write(&self, frame: &(impl Into<CanAnyFrame> + AsPtr)) -> io::Result<()> {
        let until = Instant::now() + FULL;
        loop {
            match self.socket.write_frame(frame) {
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

    /// The next frame that carries data of which `wanted` makes something.
    fn read<F>(
        &mut self,
        patience: Duration,
        wanted: impl Fn(CanAnyFrame) -> Option<F>,
    ) -> io::Result<Option<F>> {
        let until = Instant::now() + patience;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            let read = if left.is_zero() {
                self.socket.read_frame()
            } else {
                self.socket.read_frame_timeout(left)
            };
            match read {
                Ok(CanAnyFrame::Error(error)) => self.report(error.into())?,
                Ok(frame) => {
                    if let Some(frame) = wanted(frame) {
                        return Ok(Some(frame));
                    }
                }
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

fn classic(id: u16, data: &[u8]) -> io::Result<CanDataFrame> {
    let id = StandardId::new(id).ok_or(ErrorKind::InvalidInput)?;
    Ok(CanDataFrame::new(id, data).ok_or(ErrorKind::InvalidInput)?)
}

/// What a frame carries under an identifier of 11 bits.
fn carried<F>(frame: &impl EmbeddedFrame, made: fn(u16, &[u8]) -> Option<F>) -> Option<F> {
    match frame.id() {
        Id::Standard(id) => made(id.as_raw(), frame.data()),
        Id::Extended(_) => None,
    }
}

impl Bus for Socket {
    fn send(&mut self, frame: &Frame) -> io::Result<()> {
        self.write(&classic(frame.id(), frame.data())?)
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Frame>> {
        self.read(patience, |frame| match frame {
            CanAnyFrame::Normal(frame) => carried(&frame, Frame::new),
            _ => None,
        })
    }
}

impl Bus<FlexibleFrame> for Socket {
    /// What fits a classic frame goes in one, which every node understands; the others at the bus's second bit rate.
    fn send(&mut self, frame: &FlexibleFrame) -> io::Result<()> {
        if frame.data().len() <= 8 {
            return self.write(&classic(frame.id(), frame.data())?);
        }
        let id = StandardId::new(frame.id()).ok_or(ErrorKind::InvalidInput)?;
        let mut frame = CanFdFrame::new(id, frame.data()).ok_or(ErrorKind::InvalidInput)?;
        frame.set_brs(true);
        self.write(&frame).map_err(|error| match error.kind() {
            ErrorKind::InvalidInput => BusFault::Classic.into(),
            _ => error,
        })
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<FlexibleFrame>> {
        self.read(patience, |frame| match frame {
            CanAnyFrame::Normal(frame) => carried(&frame, FlexibleFrame::new),
            CanAnyFrame::Fd(frame) => carried(&frame, FlexibleFrame::new),
            _ => None,
        })
    }
}
