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
pub struct Emulated {
    host: Box<dyn link::Wire>,
    sensor: Option<Box<dyn link::Wire>>,
}

impl Emulated {
    /// Boots the image and connects to its host link.
    ///
    /// # Panics
    /// When QEMU does not start or does not listen in time.
    #[must_use]
    pub fn boot() -> Self {
        Self {
            host: link::open(&Address::Qemu { sensor: None }).expect("the board boots"),
            sensor: None,
        }
    }

    /// Boots the image and connects to its host link and its hand sensor's.
    ///
    /// # Panics
    /// When QEMU does not start or does not listen in time.
    #[must_use]
    pub fn boot_with_sensor() -> Self {
        let [host, sensor] = link::open_with_sensor().expect("the board boots");
        Self {
            host,
            sensor: Some(sensor),
        }
    }

    /// Gives bytes to the unit's sensor line.
    ///
    /// # Panics
    /// When the board was booted without, or is gone.
    pub fn sense(&mut self, bytes: &[u8]) {
        let sensor = self.sensor.as_mut().expect("a board with a sensor line");
        sensor
            .write(bytes)
            .expect("the board's sensor line takes bytes");
    }
}

impl Wire for Emulated {
    fn write(&mut self, bytes: &[u8]) {
        self.host
            .write(bytes)
            .expect("the board's link takes bytes");
    }

    fn read(&mut self, patience: Duration) -> Vec<u8> {
        let mut bytes = vec![0; 4096];
        let read = self.host.read(&mut bytes, patience);
        bytes.truncate(read.expect("the board's link is open"));
        bytes
    }
}
