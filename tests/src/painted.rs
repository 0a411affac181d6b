//! The release image, untouched, on a board whose memory was painted before it started: what paint is left below the
//! stack afterwards says how deep the stack ever was, interrupts on top of the loop included.

use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use deictic::link::{self, Line};

use crate::host::Wire;

/// The emulator's program.
const QEMU: &str = "qemu-system-arm";

/// What memory is painted with.
const PAINT: u8 = 0xac;

/// How long the emulator may take to open the board's lines.
const PATIENCE: Duration = Duration::from_secs(20);

/// A running board and its lines.
pub struct Painted {
    qemu: Child,
    host: Box<dyn link::Wire>,
    sensor: Box<dyn link::Wire>,
    control: BufReader<TcpStream>,
    /// Where the stack may lie: from the end of the variables to its top.
    stack: std::ops::Range<u32>,
}

fn free_port() -> u16 {
    let listener = TcpListener::bind(("127.0.0.1", 0)).expect("a free port");
    listener.local_addr().expect("it has one").port()
}

fn reach<T, E: std::fmt::Debug>(mut open: impl FnMut() -> Result<T, E>) -> T {
    let patience = Instant::now() + PATIENCE;
    loop {
        match open() {
            Ok(opened) => return opened,
            Err(error) => assert!(Instant::now() < patience, "no board: {error:?}"),
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

impl Painted {
    /// Paints `stack`, boots `image` and connects to it.
    ///
    /// # Panics
    /// When QEMU does not start or does not listen in time.
    #[must_use]
    pub fn boot(image: &Path, stack: std::ops::Range<u32>) -> Self {
        let ports = [(); 3].map(|()| free_port());
        let [host, sensor, control] =
            ports.map(|port| format!("tcp:127.0.0.1:{port},server=on,wait=off"));
        let paint = std::env::temp_dir().join(format!("deictic-paint-{}", std::process::id()));
        std::fs::write(&paint, vec![PAINT; stack.len()]).expect("a temporary file");
        let loader = format!(
            "loader,file={},addr={:#x},force-raw=on",
            paint.display(),
            stack.start
        );
        let qemu = Command::new(QEMU)
            .args(["-M", "mps2-an386", "-display", "none", "-monitor", "none"])
            .args(["-chardev", "null,id=log"])
            .args(["-semihosting-config", "enable=on,target=native,chardev=log"])
            .args(["-serial", &format!("{host},nodelay=on"), "-serial", "null"])
            .args(["-serial", &format!("{sensor},nodelay=on"), "-qmp", &control])
            .args(["-device", &loader, "-kernel"])
            .arg(image)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .spawn()
            .expect("QEMU is there: `cargo xtask setup` installs it");
        let line = |port| Line::Tcp {
            host: "127.0.0.1".into(),
            port,
        };
        let mut board = Self {
            host: reach(|| link::open_line(&line(ports[0]))),
            sensor: reach(|| link::open_line(&line(ports[1]))),
            control: BufReader::new(reach(|| TcpStream::connect(("127.0.0.1", ports[2])))),
            qemu,
            stack,
        };
        // QEMU listens before it reads the paint, but answers only after it.
        board.ask("{\"execute\": \"qmp_capabilities\"}");
        let _ = std::fs::remove_file(&paint);
        board
    }

    /// Gives bytes to the unit's sensor line.
    ///
    /// # Panics
    /// When the board is gone.
    pub fn sense(&mut self, bytes: &[u8]) {
        self.sensor
            .write(bytes)
            .expect("the sensor line takes bytes");
    }

    /// Halts the board and says how many bytes of stack it has used at most.
    ///
    /// # Panics
    /// When QEMU does not do as it is told.
    #[must_use]
    pub fn high_water(&mut self) -> u32 {
        let dump = std::env::temp_dir().join(format!("deictic-stack-{}", std::process::id()));
        self.ask("{\"execute\": \"stop\"}");
        let (start, size) = (self.stack.start, self.stack.len());
        self.ask(&format!(
            "{{\"execute\": \"pmemsave\", \"arguments\": {{\"val\": {start}, \"size\": {size}, \
             \"filename\": \"{}\"}}}}",
            dump.display()
        ));
        let memory = std::fs::read(&dump).expect("QEMU has written it");
        let _ = std::fs::remove_file(&dump);
        assert_eq!(memory.len(), size);
        let left = memory.iter().take_while(|byte| **byte == PAINT).count();
        u32::try_from(size - left).expect("less than the board's memory")
    }

    /// Asks the emulator for something and waits until it is done.
    fn ask(&mut self, what: &str) {
        writeln!(self.control.get_mut(), "{what}").expect("QEMU listens");
        let mut line = String::new();
        while !line.contains("\"return\"") {
            assert!(!line.contains("\"error\""), "{what}: {line}");
            line.clear();
            let read = self.control.read_line(&mut line).expect("QEMU answers");
            assert!(read > 0, "QEMU is gone");
        }
    }
}

impl Wire for Painted {
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

impl Drop for Painted {
    fn drop(&mut self) {
        let _ = self.qemu.kill();
        let _ = self.qemu.wait();
    }
}
