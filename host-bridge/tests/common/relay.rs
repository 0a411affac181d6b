//! A cable between a bridge and a robot's serial line or port, which can be pulled and plugged in again.

use std::io;
use std::net::TcpListener;
use std::os::unix::fs::symlink;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use deictic::link::{self, Line, Pair, Wire};
use deictic::robot::way::Way;

/// The end of the cable that the bridge finds.
enum Socket {
    /// A port of this machine.
    Port(TcpListener),
    /// A name that leads to a pseudo-terminal.
    Terminal(PathBuf),
}

/// What is plugged in, and the pseudo-terminal that it lives as long as.
type Plug = (Box<dyn Wire>, Option<Pair>);

impl Socket {
    /// Something to plug in; `None` when nobody has come.
    fn open(&self) -> io::Result<Option<Plug>> {
        match self {
            Self::Port(port) => match port.accept() {
                Ok((stream, _)) => Ok(Some((link::over(stream).map_err(io::Error::other)?, None))),
                Err(_) => Ok(None),
            },
            Self::Terminal(name) => {
                let pair = Pair::open()?;
                let _ = std::fs::remove_file(name);
                symlink(pair.path(), name)?;
                Ok(Some((pair.wire()?, Some(pair))))
            }
        }
    }
}

/// The cable.
pub struct Relay {
    plugged: Arc<AtomicBool>,
    over: Arc<AtomicBool>,
    thread: Option<thread::JoinHandle<()>>,
    /// Where the bridge finds the robot.
    pub way: Way,
    _folder: tempfile::TempDir,
}

impl Relay {
    /// To a robot that listens there.
    pub fn to(robot: &Way) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let (line, adapter) = match robot {
            Way::Line(line) => (line.clone(), false),
            Way::Slcan(line) => (line.clone(), true),
            Way::Can(_) | Way::Flexible(_) => panic!("a bus has no such cable"),
        };
        let socket = if matches!(line, Line::Tcp { .. }) {
            let port = TcpListener::bind("127.0.0.1:0").unwrap();
            port.set_nonblocking(true).unwrap();
            Socket::Port(port)
        } else {
            Socket::Terminal(folder.path().join("tty"))
        };
        let address = match &socket {
            Socket::Port(port) => format!("tcp:{}", port.local_addr().unwrap()),
            Socket::Terminal(name) => format!("serial:{}", name.display()),
        };
        let address = if adapter {
            format!("slcan:{address}")
        } else {
            address
        };
        let (plugged, over) = (
            Arc::new(AtomicBool::new(true)),
            Arc::<AtomicBool>::default(),
        );
        let terminal = match &socket {
            Socket::Port(_) => None,
            Socket::Terminal(name) => Some(name.clone()),
        };
        let (is_plugged, is_over) = (Arc::clone(&plugged), Arc::clone(&over));
        let thread = thread::spawn(move || {
            while !is_over.load(Ordering::Relaxed) {
                carry(&socket, &line, &is_plugged, &is_over);
                thread::sleep(Duration::from_millis(5));
            }
        });
        let relay = Self {
            plugged,
            over,
            thread: Some(thread),
            way: address.parse().unwrap(),
            _folder: folder,
        };
        thread::sleep(Duration::from_millis(50));
        // On a busy machine the terminal may not be there by then.
        while terminal.as_ref().is_some_and(|name| !name.exists()) {
            thread::sleep(Duration::from_millis(5));
        }
        relay
    }

    /// Pulls the cable, or plugs it in again.
    pub fn plug(&self, plugged: bool) {
        self.plugged.store(plugged, Ordering::Relaxed);
    }
}

impl Drop for Relay {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(thread::JoinHandle::join);
    }
}

/// Carries bytes both ways as long as it is plugged in and both ends are there.
fn carry(socket: &Socket, robot: &Line, plugged: &AtomicBool, over: &AtomicBool) {
    if !plugged.load(Ordering::Relaxed) {
        return;
    }
    let Ok(Some((mut near, _pair))) = socket.open() else {
        return;
    };
    let Ok(mut far) = link::open_line(robot) else {
        return;
    };
    let mut buffer = [0; 4096];
    let mut pass = |from: &mut Box<dyn Wire>, to: &mut Box<dyn Wire>| {
        let read = from.read(&mut buffer, Duration::from_millis(1))?;
        if read > 0 {
            to.write(&buffer[..read])
        } else {
            Ok(())
        }
    };
    while plugged.load(Ordering::Relaxed) && !over.load(Ordering::Relaxed) {
        // A terminal that the bridge has not opened yet cannot be read.
        let waits = matches!(socket, Socket::Terminal(_));
        if pass(&mut near, &mut far).is_err() && !waits {
            return;
        }
        if pass(&mut far, &mut near).is_err() && !waits {
            return;
        }
    }
}
