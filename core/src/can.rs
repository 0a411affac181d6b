//! CAN frames with 11-bit identifiers, classic ones and those of CAN FD, and a stream of bytes in classic ones.
//!
//! The unit and its host are two nodes on a bus that others may share: what they would say over a
//! serial line goes in frames of [`TO_UNIT`] and [`FROM_UNIT`], up to seven bytes in each behind a
//! byte that counts them. Lost or damaged frames show in the CRC of the stream's own frames
//! ([`crate::protocol`]).

use heapless::Vec;

/// Identifier of the frames that carry what a host says to the unit.
pub const TO_UNIT: u16 = 0x200;

/// Identifier of the frames that carry what the unit says to its host.
pub const FROM_UNIT: u16 = 0x201;

/// Stream bytes in a frame at most.
pub const STREAM_BYTES: usize = 7;

/// Bytes in a classic frame at most.
pub const CLASSIC: usize = 8;

/// Bytes in a frame of CAN FD at most.
pub const FLEXIBLE: usize = 64;

/// A frame with an identifier of 11 bits and `ROOM` bytes at most.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BusFrame<const ROOM: usize> {
    id: u16,
    data: Vec<u8, ROOM>,
}

/// A classic frame.
pub type Frame = BusFrame<CLASSIC>;

/// A frame of CAN FD (ISO 11898-1:2015).
pub type FlexibleFrame = BusFrame<FLEXIBLE>;

impl<const ROOM: usize> BusFrame<ROOM> {
    /// A frame with this identifier and these bytes, with zeros up to the next length that a frame can have: 0 to 8, and
    /// with CAN FD 12, 16, 20, 24, 32, 48, 64. `None` when the identifier has more than 11 bits or there are too many
    /// bytes.
    #[must_use]
    pub fn new(id: u16, data: &[u8]) -> Option<Self> {
        if id > 0x7ff {
            return None;
        }
        let mut data: Vec<u8, ROOM> = Vec::from_slice(data).ok()?;
        let length = match data.len() {
            length @ 0..=CLASSIC => length,
            length @ 9..=24 => length.next_multiple_of(4),
            25..=32 => 32,
            33..=48 => 48,
            _ => FLEXIBLE,
        };
        data.resize(length, 0).ok()?;
        Some(Self { id, data })
    }

    /// Its identifier.
    #[must_use]
    pub fn id(&self) -> u16 {
        self.id
    }

    /// Its bytes.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        &self.data
    }
}

impl Frame {
    /// A frame of `id` with the first of `bytes`, and how many it carries; `None` for no bytes.
    #[must_use]
    pub fn of_stream(id: u16, bytes: &[u8]) -> Option<(Self, usize)> {
        let carried = bytes.len().min(STREAM_BYTES);
        let bytes = bytes.get(..carried).filter(|b| !b.is_empty())?;
        let mut data = [0; CLASSIC];
        let (count, room) = data.split_first_mut()?;
        *count = u8::try_from(carried).ok()?;
        for (to, from) in room.iter_mut().zip(bytes) {
            *to = *from;
        }
        Some((Self::new(id, &data)?, carried))
    }

    /// The bytes of a stream that it carries; none when it is not such a frame.
    #[must_use]
    pub fn stream(&self) -> &[u8] {
        match self.data.split_first() {
            Some((count, bytes)) => bytes.get(..usize::from(*count)).unwrap_or(&[]),
            None => &[],
        }
    }
}

impl embedded_can::Frame for Frame {
    /// `None` also for an extended identifier, which nothing here uses.
    fn new(id: impl Into<embedded_can::Id>, data: &[u8]) -> Option<Self> {
        match id.into() {
            embedded_can::Id::Standard(id) => Self::new(id.as_raw(), data),
            embedded_can::Id::Extended(_) => None,
        }
    }

    /// `None`: nothing here asks for frames.
    fn new_remote(_id: impl Into<embedded_can::Id>, _dlc: usize) -> Option<Self> {
        None
    }

    fn is_extended(&self) -> bool {
        false
    }

    fn is_remote_frame(&self) -> bool {
        false
    }

    fn id(&self) -> embedded_can::Id {
        let id = embedded_can::StandardId::new(self.id);
        id.unwrap_or(embedded_can::StandardId::MAX).into()
    }

    fn dlc(&self) -> usize {
        self.data.len()
    }

    fn data(&self) -> &[u8] {
        &self.data
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_survives_in_frames_of_any_length() {
        let bytes: std::vec::Vec<u8> = (0..=255).collect();
        let mut rest = bytes.as_slice();
        let mut arrived = std::vec::Vec::new();
        while let Some((frame, carried)) = Frame::of_stream(TO_UNIT, rest) {
            assert_eq!(frame.data().len(), 8);
            arrived.extend_from_slice(frame.stream());
            rest = &rest[carried..];
        }
        assert_eq!(arrived, bytes);
    }

    #[test]
    fn a_flexible_frame_has_a_length_that_its_code_can_say() {
        let lengths = [0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64];
        for given in 0..=FLEXIBLE {
            let frame = FlexibleFrame::new(5, &[7; FLEXIBLE][..given]).unwrap();
            let wanted = lengths.iter().find(|l| **l >= given).unwrap();
            assert_eq!(frame.data().len(), *wanted);
            let (sevens, zeros) = frame.data().split_at(given);
            assert!(sevens.iter().all(|b| *b == 7) && zeros.iter().all(|b| *b == 0));
        }
        assert!(FlexibleFrame::new(5, &[0; FLEXIBLE + 1]).is_none());
        assert!(FlexibleFrame::new(0x800, &[]).is_none());
    }

    #[test]
    fn frames_that_carry_no_stream_give_nothing() {
        for data in [&[][..], &[0, 1, 2], &[8, 1, 2, 3, 4, 5, 6, 7], &[3, 1, 2]] {
            assert!(Frame::new(TO_UNIT, data).unwrap().stream().is_empty());
        }
        assert!(Frame::new(0x800, &[]).is_none());
        assert!(Frame::new(1, &[0; 9]).is_none());
    }
}
