//! What one end of a link asks of frames for a key's sake.

use super::seal::{Key, Nonces, Seal, TAG, Way};

/// What a link asks of frames.
#[derive(Debug)]
pub(super) enum Lock {
    /// Nothing: there is no key.
    None,
    /// Nobody has shown to have the key yet.
    Shut(Key, Way),
    /// Both have, and every frame is sealed.
    Sealed(Seal),
}

impl Lock {
    /// The key, where there is one.
    pub fn key(&mut self) -> Option<&mut Key> {
        match self {
            Self::None => None,
            Self::Shut(key, _) => Some(key),
            Self::Sealed(seal) => Some(seal.key()),
        }
    }

    /// Ends the conversation with these seals; both ends are to prove anew.
    pub fn shut(&mut self) {
        if let Self::Sealed(seal) = self {
            let way = seal.way();
            *self = Self::Shut(seal.key().clone(), way);
        }
    }

    /// Both have shown to have the key: every frame is sealed from now on.
    pub fn seal(&mut self, nonces: Nonces) {
        let (key, way) = match self {
            Self::None => return,
            Self::Shut(key, way) => (key.clone(), *way),
            Self::Sealed(seal) => (seal.key().clone(), seal.way()),
        };
        *self = Self::Sealed(Seal::new(key, nonces, way));
    }

    /// The body of a frame, and whether it is sealed, when the frame of number `expected` is the next.
    pub fn open<'a>(&mut self, expected: u64, contents: &'a [u8]) -> (&'a [u8], bool) {
        match self {
            Self::Sealed(seal) => opened(seal, expected, contents),
            Self::None | Self::Shut(..) => (contents, false),
        }
    }
}

/// The body of a sealed frame, and that it is one; or all of the contents when its tag is not that of its number.
#[inline(never)]
fn opened<'a>(seal: &mut Seal, expected: u64, contents: &'a [u8]) -> (&'a [u8], bool) {
    let Some((body, tag)) = contents.split_last_chunk::<TAG>() else {
        return (contents, false);
    };
    let Ok((sequence, _)) = postcard::take_from_bytes::<u16>(body) else {
        return (contents, false);
    };
    // The number that is nearest to the expected one, as a duplicate is behind it.
    let ahead = sequence.wrapping_sub(expected as u16) as i16;
    let counter = expected.wrapping_add_signed(i64::from(ahead));
    if seal.is_sound(counter, body, tag) {
        (body, true)
    } else {
        (contents, false)
    }
}
