//! A frame on its way into the outbox: checked, tagged and stuffed byte by byte.

use crc::{Digest, Table};
use postcard::ser_flavors::Flavor;

use super::{CRC, Outbox};
use crate::protocol::seal::Key;

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
