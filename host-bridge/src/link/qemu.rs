//! The unit's image on an emulated board, started for the purpose and ended with its wire.

use std::ffi::OsString;
use std::io;
use std::net::TcpListener;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::tcp::Stream;
use super::{Wire, WireError};

/// The emulator's program.
pub const QEMU: &str = "qemu-system-arm";

/// The environment variable that names the image, which `cargo xtask` sets.
pub const IMAGE_VARIABLE: &str = "DEICTIC_IMAGE_MPS2_AN386";

/// Where `cargo xtask firmware` puts the image, from the project's root.
const IMAGE: &str = "target/thumbv7em-none-eabihf/release/mps2-an386";

/// How long the emulator may take to open the board's link, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(10);

/// A running board.
pub struct Board {
    qemu: Child,
    stream: Stream,
}

impl Board {
    /// Boots the image and connects to its host link.
    pub fn boot() -> Result<Self, WireError> {
        Self::boot_with(None)
    }

    /// Boots the image and connects to its host link and to its hand sensor's.
    pub fn boot_with_sensor() -> Result<(Self, Stream), WireError> {
        let port = free_port().map_err(WireError::Silent)?;
        let board = Self::boot_with(Some(port))?;
        let sensor = Stream::open("127.0.0.1", port)?;
        Ok((board, sensor))
    }

    fn boot_with(sensor: Option<u16>) -> Result<Self, WireError> {
        let image = std::env::var_os(IMAGE_VARIABLE).unwrap_or_else(|| OsString::from(IMAGE));
        let image = PathBuf::from(image);
        if !image.is_file() {
            return Err(WireError::NoImage {
                path: image.display().to_string(),
            });
        }
        let listening = |port| format!("tcp:127.0.0.1:{port},server=on,wait=off,nodelay=on");
        let port = free_port().map_err(WireError::Silent)?;
        let sensor = sensor.map_or_else(|| "null".to_owned(), listening);
        let mut qemu = Command::new(QEMU)
            .args(["-M", "mps2-an386", "-display", "none", "-monitor", "none"])
            .args(["-chardev", "null,id=log"])
            .args(["-semihosting-config", "enable=on,target=native,chardev=log"])
            .args(["-serial", &listening(port), "-serial", "null"])
            .args(["-serial", &sensor, "-kernel"])
            .arg(image)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .spawn()
            .map_err(WireError::NoQemu)?;
        let patience = Instant::now() + PATIENCE;
        loop {
            match Stream::open("127.0.0.1", port) {
                Ok(stream) => return Ok(Self { qemu, stream }),
                Err(_) if Instant::now() < patience => {
                    std::thread::sleep(Duration::from_millis(20))
                }
                Err(WireError::Tcp { cause, .. }) => {
                    end(&mut qemu);
                    return Err(WireError::Silent(cause));
                }
                Err(other) => {
                    end(&mut qemu);
                    return Err(other);
                }
            }
        }
    }
}

/// A port of the loopback interface where nobody listens.
fn free_port() -> io::Result<u16> {
    Ok(TcpListener::bind(("127.0.0.1", 0))?.local_addr()?.port())
}

fn end(qemu: &mut Child) {
    // It may have ended by itself, which is as good.
    let _ = qemu.kill();
    let _ = qemu.wait();
}

impl Wire for Board {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.stream.write(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        self.stream.read(buffer, patience)
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        end(&mut self.qemu);
    }
}
