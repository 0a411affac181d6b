//! The host link as a node on a CAN bus: the bytes of the serial link in frames of
//! [`TO_UNIT`] and [`FROM_UNIT`]. A lost frame shows in the CRC of the stream's own frames.

use core::convert::Infallible;

use deictic_core::can::{FROM_UNIT, Frame, STREAM_BYTES, TO_UNIT};
use embedded_can::nb::Can;
use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};
use heapless::Deque;

/// Frames that are sent in one go, so that a line that waits cannot keep the loop from what arrives.
const BATCH: usize = 8;

/// The stream that a controller carries.
pub struct CanLink<C> {
    can: C,
    /// What has arrived and was not read.
    arrived: Deque<u8, STREAM_BYTES>,
}

impl<C: Can<Frame = Frame>> CanLink<C> {
    /// Over this controller.
    #[must_use]
    pub const fn new(can: C) -> Self {
        Self {
            can,
            arrived: Deque::new(),
        }
    }

    /// Takes frames until one brings bytes or no more are there. An error is one of the bus, which the controller
    /// sees to; what it cost shows in the stream.
    fn look(&mut self) {
        while self.arrived.is_empty() {
            match self.can.receive() {
                Ok(frame) if frame.id() == TO_UNIT => {
                    for byte in frame.stream() {
                        // A frame's bytes fit exactly.
                        let _ = self.arrived.push_back(*byte);
                    }
                }
                Ok(_) => {}
                Err(_) => return,
            }
        }
    }
}

impl<C> ErrorType for CanLink<C> {
    type Error = Infallible;
}

impl<C: Can<Frame = Frame>> ReadReady for CanLink<C> {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        self.look();
        Ok(!self.arrived.is_empty())
    }
}

impl<C: Can<Frame = Frame>> Read for CanLink<C> {
    /// What has arrived; nothing when nothing has.
    fn read(&mut self, into: &mut [u8]) -> Result<usize, Infallible> {
        let mut read = 0_usize;
        for slot in into {
            self.look();
            let Some(byte) = self.arrived.pop_front() else {
                break;
            };
            *slot = byte;
            read = read.saturating_add(1);
        }
        Ok(read)
    }
}

impl<C: Can<Frame = Frame>> WriteReady for CanLink<C> {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        Ok(true)
    }
}

impl<C: Can<Frame = Frame>> Write for CanLink<C> {
    /// As much as the controller takes at once; nothing when it is busy.
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        let mut written = 0_usize;
        for _ in 0..BATCH {
            let rest = bytes.get(written..).unwrap_or(&[]);
            let Some((frame, carried)) = Frame::of_stream(FROM_UNIT, rest) else {
                break;
            };
            if self.can.transmit(&frame).is_err() {
                break;
            }
            written = written.saturating_add(carried);
        }
        Ok(written)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_can::ErrorKind;
    use nb::Error::WouldBlock;
    use std::vec::Vec;

    /// A controller with room for so many frames.
    struct Bus {
        room: usize,
        sent: Vec<Frame>,
        arriving: Vec<Frame>,
    }

    impl Can for Bus {
        type Frame = Frame;
        type Error = ErrorKind;

        fn transmit(&mut self, frame: &Frame) -> nb::Result<Option<Frame>, ErrorKind> {
            if self.sent.len() >= self.room {
                return Err(WouldBlock);
            }
            self.sent.push(frame.clone());
            Ok(None)
        }

        fn receive(&mut self) -> nb::Result<Frame, ErrorKind> {
            if self.arriving.is_empty() {
                return Err(WouldBlock);
            }
            Ok(self.arriving.remove(0))
        }
    }

    #[test]
    fn a_stream_arrives_past_the_frames_of_others() {
        let bytes: Vec<u8> = (0..100).collect();
        let mut arriving = Vec::new();
        let mut rest = bytes.as_slice();
        while let Some((frame, carried)) = Frame::of_stream(TO_UNIT, rest) {
            arriving.push(frame);
            arriving.push(Frame::new(0x010, &[9; 8]).unwrap());
            rest = &rest[carried..];
        }
        let mut link = CanLink::new(Bus {
            room: 0,
            sent: Vec::new(),
            arriving,
        });
        let mut got = Vec::new();
        let mut chunk = [0; 10];
        while link.read_ready().unwrap() {
            let read = link.read(&mut chunk).unwrap();
            got.extend_from_slice(&chunk[..read]);
        }
        assert_eq!(got, bytes);
    }

    #[test]
    fn a_busy_controller_takes_what_it_can() {
        let mut link = CanLink::new(Bus {
            room: 2,
            sent: Vec::new(),
            arriving: Vec::new(),
        });
        assert_eq!(link.write(&[7; 30]), Ok(14));
        assert_eq!(link.write(&[7; 16]), Ok(0));
        let sent: Vec<u8> = link
            .can
            .sent
            .iter()
            .flat_map(|f| f.stream().to_vec())
            .collect();
        assert_eq!(sent, [7; 14]);
    }
}
