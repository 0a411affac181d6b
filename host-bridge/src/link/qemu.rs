//! The unit's image on an emulated board, started for the purpose and ended with its wire.

use std::ffi::OsString;
use std::io;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
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

/// How long the emulator may take to open a board's lines, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// How often an emulator is started anew that ended at once: somebody was faster at its ports.
const ATTEMPTS: usize = 3;

/// The board's UARTs, of which the first is the host link and the third the hand sensor's.
const UARTS: usize = 3;

/// A board that is being emulated, until this is dropped.
pub struct Emulation {
    qemu: Child,
    ports: [Option<u16>; UARTS],
    lines: [Option<Stream>; UARTS],
}

impl Emulation {
    /// Starts the image, with further arguments of the emulator, and connects to those of its UARTs that are `wanted`.
    ///
    /// # Errors
    /// [`WireError`] with what to do about it.
    pub fn start(
        image: &Path,
        wanted: [bool; UARTS],
        further: &[OsString],
    ) -> Result<Self, WireError> {
        Self::start_with(image, wanted, None, further)
    }

    /// The same, with one of the other UARTs listening at a port of its own for somebody else to connect to.
    fn start_with(
        image: &Path,
        wanted: [bool; UARTS],
        left: Option<(usize, u16)>,
        further: &[OsString],
    ) -> Result<Self, WireError> {
        let mut attempts = 1..ATTEMPTS;
        loop {
            let mut emulation = Self::spawn(image, wanted, left, further)?;
            match (emulation.connect(), attempts.next()) {
                (Ok(()), _) => return Ok(emulation),
                (Err(cause), None) => return Err(WireError::Silent(cause)),
                (Err(_), Some(_)) => {}
            }
        }
    }

    fn spawn(
        image: &Path,
        wanted: [bool; UARTS],
        left: Option<(usize, u16)>,
        further: &[OsString],
    ) -> Result<Self, WireError> {
        let mut ports = [None; UARTS];
        for (port, _) in ports.iter_mut().zip(wanted).filter(|(_, wanted)| *wanted) {
            *port = Some(free_port().map_err(WireError::Silent)?);
        }
        let mut qemu = Command::new(QEMU);
        qemu.args(["-M", "mps2-an386", "-display", "none", "-monitor", "none"])
            .args(["-chardev", "null,id=log"])
            .args(["-semihosting-config", "enable=on,target=native,chardev=log"]);
        for (uart, port) in ports.into_iter().enumerate() {
            let others = left.filter(|(number, _)| *number == uart).map(|l| l.1);
            let listening = |port| format!("tcp:127.0.0.1:{port},server=on,wait=off,nodelay=on");
            qemu.args([
                "-serial",
                &port.or(others).map_or_else(|| "null".to_owned(), listening),
            ]);
        }
        qemu.args(further).arg("-kernel").arg(image);
        qemu.stdin(Stdio::null()).stdout(Stdio::null());
        Ok(Self {
            qemu: qemu.spawn().map_err(WireError::NoQemu)?,
            ports,
            lines: [const { None }; UARTS],
        })
    }

    /// Connects to all UARTs that are wanted; an error when the emulator has ended or takes too long.
    fn connect(&mut self) -> io::Result<()> {
        let patience = Instant::now() + PATIENCE;
        for (line, port) in self.lines.iter_mut().zip(self.ports) {
            let Some(port) = port else { continue };
            *line = loop {
                if let Ok(stream) = Stream::open("127.0.0.1", port) {
                    break Some(stream);
                }
                if let Some(status) = self.qemu.try_wait()? {
                    return Err(io::Error::other(format!("it has ended ({status})")));
                }
                if Instant::now() >= patience {
                    return Err(io::ErrorKind::TimedOut.into());
                }
                std::thread::sleep(Duration::from_millis(5));
            };
        }
        Ok(())
    }

    /// The line to one of its UARTs, once.
    pub fn take(&mut self, uart: usize) -> Option<Box<dyn Wire>> {
        let line = self.lines.get_mut(uart)?.take()?;
        Some(Box::new(line))
    }

    /// Where one of its UARTs listens, to one host at a time.
    #[must_use]
    pub fn port(&self, uart: usize) -> Option<u16> {
        self.ports.get(uart).copied().flatten()
    }

    /// The number of the emulator's process.
    #[must_use]
    pub fn process(&self) -> u32 {
        self.qemu.id()
    }
}

impl Drop for Emulation {
    fn drop(&mut self) {
        // It may have ended by itself, which is as good.
        let _ = self.qemu.kill();
        let _ = self.qemu.wait();
    }
}

/// A running board and its host link.
pub struct Board {
    host: Box<dyn Wire>,
    _emulation: Emulation,
}

impl Board {
    /// Boots the image and connects to its host link; its hand sensor's, if there is one, listens at that port.
    pub fn boot(sensor: Option<u16>) -> Result<Self, WireError> {
        let left = sensor.map(|port| (2, port));
        let wanted = [true, false, false];
        Self::with(Emulation::start_with(&image()?, wanted, left, &[])?)
    }

    /// Boots the image and connects to its host link and to its hand sensor's.
    pub fn boot_with_sensor() -> Result<(Self, Box<dyn Wire>), WireError> {
        let mut emulation = Emulation::start(&image()?, [true, false, true], &[])?;
        let sensor = emulation.take(2).ok_or_else(unconnected)?;
        Ok((Self::with(emulation)?, sensor))
    }

    fn with(mut emulation: Emulation) -> Result<Self, WireError> {
        Ok(Self {
            host: emulation.take(0).ok_or_else(unconnected)?,
            _emulation: emulation,
        })
    }
}

fn unconnected() -> WireError {
    WireError::Silent(io::ErrorKind::NotConnected.into())
}

/// The image that is named, or that lies where it is built.
fn image() -> Result<PathBuf, WireError> {
    let image = std::env::var_os(IMAGE_VARIABLE).unwrap_or_else(|| OsString::from(IMAGE));
    let image = PathBuf::from(image);
    if image.is_file() {
        return Ok(image);
    }
    Err(WireError::NoImage {
        path: image.display().to_string(),
    })
}

/// A port of the loopback interface where nobody listens.
fn free_port() -> io::Result<u16> {
    Ok(TcpListener::bind(("127.0.0.1", 0))?.local_addr()?.port())
}

impl Wire for Board {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.host.write(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        self.host.read(buffer, patience)
    }
}
