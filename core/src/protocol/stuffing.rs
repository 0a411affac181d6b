//! Bytes to frames and back: COBS stuffing with a CRC-32 inside, one byte at a time, without a
//! second buffer (Cheshire and Baker 1999).

use crc::{CRC_32_ISO_HDLC, Crc, Digest, Table};
use heapless::Vec;
use postcard::ser_flavors::Flavor;

use super::seal::Key;

static CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// Length of the CRC at a frame's end.
const CRC_BYTES: usize = 4;

/// Frames waiting to be written, at most `OUT` bytes of them.
#[derive(Debug)]
pub struct Outbox<const OUT: usize> {
    bytes: Vec<u8, OUT>,
    written: usize,
}

impl<const OUT: usize> Default for Outbox<OUT> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const OUT: usize> Outbox<OUT> {
    /// Nothing to be written.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            bytes: Vec::new(),
            written: 0,
        }
    }

    /// What is still to be written.
    #[must_use]
    pub fn waiting(&self) -> &[u8] {
        self.bytes.get(self.written..).unwrap_or(&[])
    }

    /// The first `n` waiting bytes have been written.
    pub fn written(&mut self, n: usize) {
        self.written = self.written.saturating_add(n);
        if self.written >= self.bytes.len() {
            self.clear();
        }
    }

    /// Forgets what is waiting.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.written = 0;
    }

    /// Forgets what is waiting. When that may cut a frame short, a zero ends it, so that the next one is not taken for
    /// its rest.
    pub fn abandon(&mut self) {
        let cut = !self.waiting().is_empty();
        self.clear();
        if cut {
            // There is room in an empty outbox.
            let _ = self.bytes.push(0);
        }
    }

    fn compact(&mut self) {
        if self.written > 0 {
            let length = self.bytes.len();
            // Byte by byte: the slices' own ways to move can panic, if only in a build that does not see that they do not.
            for from in self.written..length {
                let byte = self.bytes.get(from).copied().unwrap_or(0);
                if let Some(to) = self.bytes.get_mut(from.saturating_sub(self.written)) {
                    *to = byte;
                }
            }
            self.bytes.truncate(length.saturating_sub(self.written));
            self.written = 0;
        }
    }
}

/// Writes one frame into an [`Outbox`], as a postcard flavour.
pub struct FrameWriter<'a, const OUT: usize> {
    out: &'a mut Outbox<OUT>,
    start: usize,
    code_at: usize,
    code: u8,
    crc: Digest<'static, u32, Table<1>>,
    tagger: Option<&'a mut Key>,
}

impl<'a, const OUT: usize> FrameWriter<'a, OUT> {
    /// Starts a frame behind those that wait.
    ///
    /// # Errors
    /// When the outbox is full.
    pub fn new(out: &'a mut Outbox<OUT>) -> postcard::Result<Self> {
        Self::sealed(out, None)
    }

    /// Starts a frame that ends with a tag over its contents.
    ///
    /// # Errors
    /// When the outbox is full.
    pub fn sealed(out: &'a mut Outbox<OUT>, tagger: Option<&'a mut Key>) -> postcard::Result<Self> {
        out.compact();
        let start = out.bytes.len();
        let mut writer = Self {
            out,
            start,
            code_at: start,
            code: 1,
            crc: CRC.digest(),
            tagger,
        };
        writer.open_block()?;
        Ok(writer)
    }

    fn push(&mut self, byte: u8) -> postcard::Result<()> {
        self.out
            .bytes
            .push(byte)
            .map_err(|_| postcard::Error::SerializeBufferFull)
    }

    fn open_block(&mut self) -> postcard::Result<()> {
        self.code_at = self.out.bytes.len();
        self.code = 1;
        self.push(0)
    }

    fn close_block(&mut self) {
        if let Some(place) = self.out.bytes.get_mut(self.code_at) {
            *place = self.code;
        }
    }

    fn stuff(&mut self, byte: u8) -> postcard::Result<()> {
        if byte == 0 {
            self.close_block();
            return self.open_block();
        }
        self.push(byte)?;
        self.code = self.code.saturating_add(1);
        if self.code == u8::MAX {
            self.close_block();
            self.open_block()?;
        }
        Ok(())
    }

    /// Takes back what was written of an unfinished frame.
    fn abandon(&mut self) {
        self.out.bytes.truncate(self.start);
    }
}

impl<const OUT: usize> Flavor for FrameWriter<'_, OUT> {
    type Output = ();

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        if let Some(tagger) = &mut self.tagger {
            tagger.push(byte);
        }
        self.crc.update(&[byte]);
        self.stuff(byte).inspect_err(|_| self.abandon())
    }

    fn finalize(mut self) -> postcard::Result<()> {
        let tag = self.tagger.take().map(|tagger| tagger.finish());
        if let Some(tag) = tag {
            for byte in tag {
                self.try_push(byte)?;
            }
        }
        let crc = self.crc.clone().finalize().to_le_bytes();
        let mut end = || {
            for byte in crc {
                self.stuff(byte)?;
            }
            self.close_block();
            self.push(0)
        };
        end().inspect_err(|_| self.abandon())
    }
}

/// Why a frame was dropped before anybody looked into it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// The stuffing does not end where the frame does, or there is nothing besides a CRC.
    Malformed,
    /// The CRC does not match.
    Corrupt,
    /// Longer than the buffer.
    Oversized,
}

/// Takes bytes one at a time and unstuffs them into frames of at most `FRAME` bytes.
#[derive(Debug)]
pub struct FrameReader<const FRAME: usize> {
    bytes: Vec<u8, FRAME>,
    /// How many bytes the current block still has.
    left: u8,
    /// Whether a zero belongs between the current block and the next.
    zero_follows: bool,
    oversized: bool,
    /// Whether a frame that was finished is still in `bytes`.
    finished: bool,
}

impl<const FRAME: usize> Default for FrameReader<FRAME> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const FRAME: usize> FrameReader<FRAME> {
    /// At the beginning of a frame.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            bytes: Vec::new(),
            left: 0,
            zero_follows: false,
            oversized: false,
            finished: false,
        }
    }

    /// Takes one byte; when it ends a frame, gives the frame's contents without the CRC, which are
    /// valid until the next byte. Zeros between frames give nothing.
    pub fn push(&mut self, byte: u8) -> Option<Result<&[u8], FrameError>> {
        if self.finished {
            self.bytes.clear();
            self.finished = false;
        }
        if byte == 0 {
            return self.end();
        }
        if self.left == 0 {
            if self.zero_follows {
                self.keep(0);
            }
            self.left = byte.saturating_sub(1);
            self.zero_follows = byte != u8::MAX;
        } else {
            self.left = self.left.saturating_sub(1);
            self.keep(byte);
        }
        None
    }

    fn keep(&mut self, byte: u8) {
        if self.bytes.push(byte).is_err() {
            self.oversized = true;
        }
    }

    fn end(&mut self) -> Option<Result<&[u8], FrameError>> {
        let (left, oversized) = (self.left, self.oversized);
        let empty = self.bytes.is_empty() && !self.zero_follows && left == 0;
        self.left = 0;
        self.zero_follows = false;
        self.oversized = false;
        self.finished = true;
        if empty {
            return None;
        }
        if oversized {
            return Some(Err(FrameError::Oversized));
        }
        if left != 0 {
            return Some(Err(FrameError::Malformed));
        }
        // A frame without contents says nothing, and would be sound by chance: the CRC of nothing is 0, as are the four
        // bytes of the beginning of many a frame that was cut short.
        let Some((contents, crc)) = self
            .bytes
            .split_last_chunk::<CRC_BYTES>()
            .filter(|(contents, _)| !contents.is_empty())
        else {
            return Some(Err(FrameError::Malformed));
        };
        if CRC.checksum(contents) != u32::from_le_bytes(*crc) {
            return Some(Err(FrameError::Corrupt));
        }
        Some(Ok(contents))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_is_abandoned_halfway_does_not_swallow_the_next_frame() {
        let write = |out: &mut Outbox<64>, byte| {
            let mut writer = FrameWriter::new(out).unwrap();
            writer.try_push(byte).unwrap();
            writer.finalize().unwrap();
        };
        let mut out = Outbox::<64>::new();
        let mut reader = FrameReader::<16>::new();
        write(&mut out, 7);
        let mut line = out.waiting()[..3].to_vec();
        out.written(3);
        out.abandon();
        write(&mut out, 8);
        line.extend(out.waiting());
        let frames = line
            .iter()
            .filter_map(|b| reader.push(*b)?.ok().map(<[u8]>::to_vec));
        assert_eq!(frames.collect::<std::vec::Vec<_>>(), [[8]]);
        // Nothing waits, nothing is cut.
        let mut out = Outbox::<64>::new();
        out.abandon();
        assert!(out.waiting().is_empty());
    }

    fn framed(contents: &[u8]) -> std::vec::Vec<u8> {
        let mut out = Outbox::<4096>::new();
        let mut writer = FrameWriter::new(&mut out).unwrap();
        for &byte in contents {
            writer.try_push(byte).unwrap();
        }
        writer.finalize().unwrap();
        out.waiting().to_vec()
    }

    fn read(bytes: &[u8]) -> std::vec::Vec<Result<std::vec::Vec<u8>, FrameError>> {
        let mut reader = FrameReader::<1024>::new();
        let mut frames = std::vec::Vec::new();
        for &byte in bytes {
            frames.extend(reader.push(byte).map(|f| f.map(<[u8]>::to_vec)));
        }
        frames
    }

    proptest! {
        #[test]
        fn what_goes_in_comes_out(contents in proptest::collection::vec(any::<u8>(), 1..900)) {
            let frame = framed(&contents);
            prop_assert_eq!(frame.iter().filter(|b| **b == 0).count(), 1);
            prop_assert_eq!(read(&frame), [Ok(contents)]);
        }

        #[test]
        fn runs_without_zeros_agree_with_another_implementation(n in 250_usize..520) {
            let contents = std::vec![7_u8; n];
            let mut stuffed = contents.clone();
            stuffed.extend(CRC.checksum(&contents).to_le_bytes());
            let mut expected = cobs::encode_vec(&stuffed);
            expected.push(0);
            // A block of 254 at the very end may be followed by an empty one; both decode alike.
            let ours = framed(&contents);
            prop_assert!(ours == expected || ours.len() == expected.len() + 1);
            prop_assert_eq!(cobs::decode_vec(&ours[..ours.len() - 1]).unwrap(), stuffed);
            prop_assert_eq!(read(&expected), [Ok(contents)]);
        }

        #[test]
        fn any_bytes_are_survived(bytes in proptest::collection::vec(any::<u8>(), 0..3000)) {
            let mut all = bytes;
            all.push(0);
            all.extend(framed(b"after"));
            prop_assert_eq!(read(&all).last().cloned(), Some(Ok(b"after".to_vec())));
        }
    }

    #[test]
    fn every_kind_of_damage_has_its_name() {
        let good = framed(b"hello");
        let mut corrupt = good.clone();
        corrupt[2] ^= 4;
        assert_eq!(read(&corrupt), [Err(FrameError::Corrupt)]);
        let mut cut = good[..4].to_vec();
        cut.push(0);
        assert_eq!(read(&cut), [Err(FrameError::Malformed)]);
        assert_eq!(read(&framed(&[1; 1100])), [Err(FrameError::Oversized)]);
        assert_eq!(read(&[0, 0, 0]), []);
        assert_eq!(read(&[1, 0]), [Err(FrameError::Malformed)]);
    }

    #[test]
    fn a_full_outbox_refuses_a_frame_whole() {
        let mut out = Outbox::<16>::new();
        let mut writer = FrameWriter::new(&mut out).unwrap();
        let result = (0..40).try_for_each(|_| writer.try_push(3));
        assert!(result.is_err());
        assert!(out.waiting().is_empty());
        let writer = FrameWriter::new(&mut out).unwrap();
        writer.finalize().unwrap();
        let waiting = out.waiting().len();
        out.written(2);
        assert_eq!(out.waiting().len(), waiting - 2);
        out.written(waiting);
        assert!(out.waiting().is_empty());
    }
}
