//! The release image of the unit on QEMU's mps2-an386, a Cortex-M4F, reached as the bridge reaches it.

use std::time::Duration;

use deictic::link::{self, Address, IMAGE_VARIABLE};

use crate::host::Wire;

/// Whether there is an image to test; says why not when there is none.
#[must_use]
pub fn has_image() -> bool {
    let named = std::env::var_os(IMAGE_VARIABLE).is_some();
    if !named {
        eprintln!(
            "skipped: no board image; `cargo xtask test` builds one and names it in {IMAGE_VARIABLE}"
        );
    }
    named
}

/// A running board and its host link. Dropping it pulls the plug.
pub struct Emulated(Box<dyn link::Wire>);

impl Emulated {
    /// Boots the image and connects to its host link.
    ///
    /// # Panics
    /// When QEMU does not start or does not listen in time.
    #[must_use]
    pub fn boot() -> Self {
        Self(link::open(&Address::Qemu).expect("the board boots"))
    }
}

impl Wire for Emulated {
    fn write(&mut self, bytes: &[u8]) {
        self.0.write(bytes).expect("the board's link takes bytes");
    }

    fn read(&mut self, patience: Duration) -> Vec<u8> {
        let mut bytes = vec![0; 4096];
        let read = self.0.read(&mut bytes, patience);
        bytes.truncate(read.expect("the board's link is open"));
        bytes
    }
}
