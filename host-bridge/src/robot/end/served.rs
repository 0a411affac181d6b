//! A robot's side behind a link, opened anew whenever it fails.

use std::io::{self, ErrorKind};
use std::net::{IpAddr, TcpListener};
use std::time::{Duration, Instant};

use deictic_core::can::{BusFrame, CLASSIC};
use deictic_core::command::Packet;
use deictic_core::command::parcel::Sender;
use deictic_core::command::seal::{Heard, ON_A_BUS, ON_A_STREAM};
use deictic_core::protocol::seal::Key;
use deictic_core::time::Micros;

use super::End;
use crate::link::{self, Line, Pair, Wire, WireError, bus};
use crate::robot::remote::{Carrier, Gate, OnBus, OnWire};
use crate::robot::way::Way;

/// How long to wait before a link that cannot be opened is tried again.
const REOPEN: Duration = Duration::from_millis(200);

/// Where a robot listens.
pub enum Listener {
    /// On a bus, or at a serial port.
    At(Way),
    /// At a pseudo-terminal; `adapter` for a LAWICEL adapter's text.
    Pair {
        /// The pseudo-terminal.
        pair: Pair,
        /// Whether the adapter's text is spoken.
        adapter: bool,
    },
    /// At a port of this machine, one host at a time; `adapter` for a LAWICEL adapter's text.
    Port {
        /// The port.
        port: TcpListener,
        /// Whether the adapter's text is spoken.
        adapter: bool,
    },
}

/// A robot cannot listen.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ListenError {
    /// The link cannot be opened.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Wire(#[from] WireError),
    /// Only this machine may talk to a simulated robot.
    #[error("{0} is not an address of this machine alone")]
    #[diagnostic(help("listen at 127.0.0.1"))]
    NotHere(String),
    /// The port cannot be had.
    #[error("cannot listen at {at}")]
    #[diagnostic(help("port 0 takes a free one"))]
    Port {
        /// Host and port.
        at: String,
        /// What the system said.
        #[source]
        cause: io::Error,
    },
}

impl Listener {
    /// Takes the place where hosts will be heard.
    ///
    /// # Errors
    /// [`ListenError`]
    pub fn open(way: &Way) -> Result<Self, ListenError> {
        let (Way::Line(Line::Tcp { host, port }) | Way::Slcan(Line::Tcp { host, port })) = way
        else {
            // It is opened anew whenever it fails, but one that is not there is a mistake.
            match way {
                Way::Can(interface) => drop(link::open_interface(interface)?),
                Way::Flexible(interface) => drop(link::open_flexible_interface(interface)?),
                Way::Slcan(line) | Way::Line(line) => drop(link::open_line(line)?),
            }
            return Ok(Self::At(way.clone()));
        };
        let ip = host.trim_matches(['[', ']']).parse::<IpAddr>();
        let Some(ip) = ip.ok().filter(IpAddr::is_loopback) else {
            return Err(ListenError::NotHere(host.clone()));
        };
        let listen = || {
            let listener = TcpListener::bind((ip, *port))?;
            listener.set_nonblocking(true)?;
            Ok(listener)
        };
        let at = || format!("{host}:{port}");
        let port = listen().map_err(|cause| ListenError::Port { at: at(), cause })?;
        let adapter = matches!(way, Way::Slcan(_));
        Ok(Self::Port { port, adapter })
    }

    /// Where a host finds it.
    #[must_use]
    pub fn address(&self) -> String {
        match self {
            Self::At(way) => way.to_string(),
            Self::Pair { pair, adapter } => {
                let kind = if *adapter { "slcan" } else { "serial" };
                format!("{kind}:{}", pair.path())
            }
            Self::Port { port, adapter } => {
                let kind = if *adapter { "slcan:tcp" } else { "tcp" };
                let at = port.local_addr();
                at.map_or_else(|e| e.to_string(), |at| format!("{kind}:{at}"))
            }
        }
    }

    /// How long the tags on its links are.
    fn tag(&self) -> usize {
        match self {
            Self::At(way) => way.tag(),
            Self::Pair { adapter, .. } | Self::Port { adapter, .. } if *adapter => ON_A_BUS,
            Self::Pair { .. } | Self::Port { .. } => ON_A_STREAM,
        }
    }

    /// A link to a host; `None` when none has come.
    fn accept(&self) -> io::Result<Option<Box<dyn Carrier>>> {
        let opened = match self {
            Self::At(Way::Can(interface)) => link::open_interface(interface).map(on_bus),
            Self::At(Way::Flexible(interface)) => {
                link::open_flexible_interface(interface).map(on_bus)
            }
            Self::At(Way::Slcan(line)) => link::open_line(line).map(|wire| on_wire(wire, true)),
            Self::At(Way::Line(line)) => link::open_line(line).map(|wire| on_wire(wire, false)),
            Self::Pair { pair, adapter } => {
                let wire = pair.wire()?;
                return Ok(Some(on_wire(wire, *adapter)));
            }
            Self::Port { port, adapter } => match port.accept() {
                Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(None),
                Err(error) => return Err(error),
                Ok((stream, _)) => {
                    let wire = link::over(stream)?;
                    return Ok(Some(on_wire(wire, *adapter)));
                }
            },
        };
        opened.map(Some).map_err(io::Error::other)
    }
}

fn on_bus<const ROOM: usize>(bus: Box<dyn bus::Bus<BusFrame<ROOM>>>) -> Box<dyn Carrier> {
    Box::new(OnBus::new(bus, Sender::Robot))
}

fn on_wire(wire: Box<dyn Wire>, adapter: bool) -> Box<dyn Carrier> {
    if adapter {
        on_bus::<CLASSIC>(Box::new(bus::Adapter::new(wire)))
    } else {
        Box::new(OnWire::new(wire))
    }
}

/// A robot's side and the link to its host.
pub struct Served {
    end: End,
    listener: Listener,
    carrier: Option<Box<dyn Carrier>>,
    gate: Gate,
    began: Instant,
    again: Instant,
}

impl Served {
    /// Nobody has been heard yet.
    #[must_use]
    pub fn new(end: End, listener: Listener) -> Self {
        let now = Instant::now();
        Self {
            end,
            listener,
            carrier: None,
            gate: Gate::default(),
            began: now,
            again: now,
        }
    }

    /// Listens only to a host that has this key, but for a halt.
    ///
    /// # Errors
    /// When this machine has no random numbers.
    pub fn with_key(mut self, key: &Key) -> io::Result<Self> {
        self.gate = Gate::new(Sender::Robot, Some(key), self.listener.tag())?;
        Ok(self)
    }

    /// What stands between the robot and its links.
    #[must_use]
    pub fn gate(&self) -> &Gate {
        &self.gate
    }

    /// The robot's side.
    #[must_use]
    pub fn end(&self) -> &End {
        &self.end
    }

    /// Lets things happen, waiting at most `patience` for the first of them. Gives why the link was
    /// lost or cannot be opened, when that has just happened; the robot goes on without it, which
    /// means that it stops.
    pub fn turn(&mut self, patience: Duration) -> Option<io::Error> {
        let now = self.now();
        let mut out = Vec::new();
        self.end.poll(now, &mut out);
        let wake = Duration::from_micros(self.end.next_wake(now).since(now).0);
        let lost = match &mut self.carrier {
            None => self.reach(patience.min(wake)),
            Some(carrier) => {
                let mut wait = if out.is_empty() {
                    patience.min(wake)
                } else {
                    Duration::ZERO
                };
                let (end, gate) = (&mut self.end, &mut self.gate);
                let mut talk = || {
                    say(carrier, gate, &mut out)?;
                    while let Some(packet) = carrier.receive(wait)? {
                        match gate.hear(packet) {
                            Heard::Message(packet) => {
                                end.take(micros(self.began), &packet, &mut out)
                            }
                            Heard::Answer(packet) => carrier.send(&packet)?,
                            Heard::Nothing => {}
                        }
                        say(carrier, gate, &mut out)?;
                        wait = Duration::ZERO;
                    }
                    Ok(())
                };
                talk().err()
            }
        };
        if lost.is_some() {
            self.carrier = None;
            self.again = Instant::now() + REOPEN;
        }
        lost
    }

    fn reach(&mut self, patience: Duration) -> Option<io::Error> {
        std::thread::sleep(patience.min(Duration::from_millis(5)));
        if Instant::now() < self.again {
            return None;
        }
        match self.listener.accept() {
            Ok(carrier) => {
                self.carrier = carrier;
                None
            }
            Err(error) => Some(error),
        }
    }

    fn now(&self) -> Micros {
        micros(self.began)
    }
}

fn say(carrier: &mut Box<dyn Carrier>, gate: &mut Gate, out: &mut Vec<Packet>) -> io::Result<()> {
    let mut said = out.drain(..).flat_map(|packet| gate.say(&packet));
    said.try_for_each(|packet| carrier.send(&packet))
}

fn micros(began: Instant) -> Micros {
    Micros(u64::try_from(began.elapsed().as_micros()).unwrap_or(u64::MAX))
}
