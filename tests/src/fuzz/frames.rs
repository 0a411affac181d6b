//! The frame accumulator: any bytes against an independent COBS, frames cut at every byte, frames damaged anywhere.

use deictic_core::protocol::stuffing::{FrameReader, FrameWriter, Outbox};
use postcard::ser_flavors::Flavor;

use super::source::Source;

/// What the reader holds: contents and CRC.
const FRAME: usize = 96;

/// Checks one input, the first byte of which chooses how the others are used.
pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let kind = source.small(3);
    let rest = source.bytes(usize::MAX);
    match kind {
        0 => any(rest),
        1 if !rest.is_empty() => cut(&rest[..rest.len().min(FRAME - 4)]),
        _ => damaged(rest),
    }
}

/// The frames that a reader accepts, each behind the place of its end.
fn accepted(bytes: &[u8]) -> Vec<(usize, Vec<u8>)> {
    let mut reader = FrameReader::<FRAME>::new();
    let each = bytes.iter().enumerate();
    each.filter_map(|(at, &byte)| match reader.push(byte)? {
        Ok(contents) => Some((at, contents.to_vec())),
        Err(_) => None,
    })
    .collect()
}

/// The same by a crate of somebody else's, whole frames at a time.
fn expected(bytes: &[u8]) -> Vec<(usize, Vec<u8>)> {
    let mut frames = Vec::new();
    let mut start = 0;
    for (at, _) in bytes.iter().enumerate().filter(|(_, b)| **b == 0) {
        let stuffed = &bytes[start..at];
        start = at + 1;
        let Ok(contents) = cobs::decode_vec(stuffed) else {
            continue;
        };
        if contents.len() > FRAME {
            continue;
        }
        if let Some((contents, crc)) = contents.split_last_chunk::<4>()
            && !contents.is_empty()
            && crc32(contents) == u32::from_le_bytes(*crc)
        {
            frames.push((at, contents.to_vec()));
        }
    }
    frames
}

/// CRC-32/ISO-HDLC as its parameters read, of all bytes that there are.
const REMAINDERS: [u32; 256] = {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut crc, mut bit) = (byte as u32, 0);
        while bit < 8 {
            crc = (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
};

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (crc >> 8) ^ REMAINDERS[(crc as u8 ^ byte) as usize]
    })
}

fn framed(contents: &[u8]) -> Vec<u8> {
    let mut out = Outbox::<1024>::new();
    let mut writer = FrameWriter::new(&mut out).expect("there is room");
    for &byte in contents {
        writer.try_push(byte).expect("there is room");
    }
    writer.finalize().expect("there is room");
    out.waiting().to_vec()
}

fn any(bytes: &[u8]) {
    assert_eq!(accepted(bytes), expected(bytes));
}

/// A frame is what another implementation makes of it; cut anywhere, the next one is whole all the same.
fn cut(contents: &[u8]) {
    let frame = framed(contents);
    let mut plain = contents.to_vec();
    plain.extend(crc32(contents).to_le_bytes());
    let mut stuffed = cobs::encode_vec(&plain);
    stuffed.push(0);
    assert_eq!(frame, stuffed);
    for at in 0..frame.len() - 1 {
        let mut line = frame[..at].to_vec();
        line.push(0);
        let end = line.len() + frame.len() - 1;
        line.extend(&frame);
        let accepted = accepted(&line);
        assert_eq!(
            accepted.last(),
            Some(&(end, contents.to_vec())),
            "cut at {at}"
        );
        // Contents may hold the CRC of their own beginning, and a fuzzer finds out how.
        assert_eq!(accepted, expected(&line), "cut at {at}");
    }
}

/// A line with up to eight flipped bits holds the same frames for both implementations.
fn damaged(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let flips: Vec<(usize, u8)> = (0..1 + source.small(8))
        .map(|_| (usize::from(source.byte()), source.small(8)))
        .collect();
    let contents = source.bytes(FRAME - 4);
    if contents.is_empty() {
        return;
    }
    let mut line = framed(contents);
    for (at, bit) in flips {
        if let Some(byte) = line.get_mut(at) {
            *byte ^= 1 << bit;
        }
    }
    assert_eq!(accepted(&line), expected(&line));
}
