//! The release image of the unit on QEMU's mps2-an386, a Cortex-M4F.

use std::ffi::OsString;
use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::host::Wire;

/// Where `cargo xtask test` says the image is.
const IMAGE: &str = "DEICTIC_IMAGE_MPS2_AN386";

/// The image to test, or `None` with a word about why when there is none.
#[must_use]
pub fn image() -> Option<OsString> {
    let image = std::env::var_os(IMAGE);
    if image.is_none() {
        eprintln!("skipped: no board image; `cargo xtask test` builds one and names it in {IMAGE}");
    }
    image
}

/// A running board and its host link. Dropping it pulls the plug.
pub struct Emulated {
    qemu: Child,
    link: TcpStream,
}

impl Emulated {
    /// Boots the image and connects to its host link.
    ///
    /// # Panics
    /// When QEMU does not start or does not listen within ten seconds.
    #[must_use]
    pub fn boot(image: &OsString) -> Self {
        let free = TcpListener::bind(("127.0.0.1", 0)).expect("a free port");
        let port = free.local_addr().expect("its number").port();
        drop(free);
        let mut qemu = Command::new("qemu-system-arm")
            .args(["-M", "mps2-an386", "-display", "none", "-monitor", "none"])
            .args(["-chardev", "null,id=log"])
            .args(["-semihosting-config", "enable=on,target=native,chardev=log"])
            .args([
                "-serial",
                &format!("tcp:127.0.0.1:{port},server=on,wait=off,nodelay=on"),
            ])
            .args(["-serial", "null", "-kernel"])
            .arg(image)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .spawn()
            .expect("qemu-system-arm starts");
        let patience = Instant::now() + Duration::from_secs(10);
        let link = loop {
            match TcpStream::connect(("127.0.0.1", port)) {
                Ok(link) => break link,
                Err(_) if Instant::now() < patience => {
                    std::thread::sleep(Duration::from_millis(20))
                }
                Err(error) => {
                    let _ = qemu.kill();
                    panic!("QEMU does not listen: {error}");
                }
            }
        };
        link.set_nodelay(true).expect("a socket option");
        Self { qemu, link }
    }
}

impl Wire for Emulated {
    fn write(&mut self, bytes: &[u8]) {
        self.link
            .write_all(bytes)
            .expect("the board's link takes bytes");
    }

    fn read(&mut self, patience: Duration) -> Vec<u8> {
        let mut bytes = vec![0; 4096];
        self.link
            .set_read_timeout(Some(patience.max(Duration::from_millis(1))))
            .expect("a socket option");
        match self.link.read(&mut bytes) {
            Ok(0) => panic!("the board has closed its link"),
            Ok(n) => bytes.truncate(n),
            Err(e) if matches!(e.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                bytes.clear()
            }
            Err(e) => panic!("the board's link: {e}"),
        }
        bytes
    }
}

impl Drop for Emulated {
    fn drop(&mut self) {
        let _ = self.qemu.kill();
        let _ = self.qemu.wait();
    }
}
