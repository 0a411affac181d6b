//! Bytes to frames and back: COBS stuffing with a CRC-32 inside, one byte at a time, without a
//! second buffer (Cheshire and Baker 1999).

mod outbox;
mod reader;
mod writer;

use crc::{CRC_32_ISO_HDLC, Crc, Table};

pub use outbox::Outbox;
pub use reader::{FrameError, FrameReader};
pub use writer::FrameWriter;

static CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// Length of the CRC at a frame's end.
const CRC_BYTES: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;
    use postcard::ser_flavors::Flavor;
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
