//! The release image, untouched, on a board whose memory was painted before it started: what paint is left below the
//! stack afterwards says how deep the stack ever was, interrupts on top of the loop included.

use std::ffi::OsString;
use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::time::Duration;

use deictic::link::{self, Emulation};

use crate::host::Wire;

/// What memory is painted with.
const PAINT: u8 = 0xac;

/// A running board and its lines.
pub struct Painted {
    /// What runs until it is dropped.
    _emulation: Emulation,
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

impl Painted {
    /// Paints `stack`, boots `image` and connects to it.
    ///
    /// # Panics
    /// When QEMU does not start or does not listen in time.
    #[must_use]
    pub fn boot(image: &Path, stack: std::ops::Range<u32>) -> Self {
        let paint = std::env::temp_dir().join(format!("deictic-paint-{}", std::process::id()));
        std::fs::write(&paint, vec![PAINT; stack.len()]).expect("a temporary file");
        let loader = format!(
            "loader,file={},addr={:#x},force-raw=on",
            paint.display(),
            stack.start
        );
        let port = free_port();
        let control = format!("tcp:127.0.0.1:{port},server=on,wait=off");
        let further = ["-device", &loader, "-qmp", &control].map(OsString::from);
        let mut emulation = Emulation::start(image, [true, false, true], &further)
            .expect("QEMU is there: `cargo xtask setup` installs it");
        let control = TcpStream::connect(("127.0.0.1", port)).expect("QEMU listens there, too");
        let mut line = |uart| emulation.take(uart).expect("it was wanted");
        let mut board = Self {
            host: line(0),
            sensor: line(2),
            control: BufReader::new(control),
            _emulation: emulation,
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
