//! A line that a test can spoil, and a far robot whose arm counts what it really begins.
#![allow(dead_code)]

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use deictic::robot::end::End;
use deictic::robot::remote::{Carrier, Gate};
use deictic::robot::sim::Sim;
use deictic::robot::{Command, CommandId, Event, Posture, Refusal, Robot, Taken, World};
use deictic_core::command::Packet;
use deictic_core::command::seal::Heard;
use deictic_core::time::Micros;

/// Which way a packet goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    ToRobot,
    ToHost,
}

/// What becomes of a packet: those that arrive in its place; an error is a cable that is pulled.
pub type Spoil = Box<dyn FnMut(Way, &Packet) -> io::Result<Vec<Packet>> + Send>;

/// Counts what an arm really begins.
pub struct Counted {
    pub inner: Sim,
    pub begun: Arc<Mutex<Vec<CommandId>>>,
    /// It begins, but never ends by itself.
    pub hangs: bool,
}

impl Robot for Counted {
    fn begin(
        &mut self,
        now: Micros,
        command: &Command,
        world: World<'_>,
    ) -> Result<Taken, Refusal> {
        let taken = self.inner.begin(now, command, world)?;
        self.begun.lock().unwrap().push(command.id);
        Ok(taken)
    }

    fn stop(&mut self, now: Micros) {
        // Hosts stop whatever it may be doing when they come.
        self.hangs &= self.begun.lock().unwrap().is_empty();
        self.inner.stop(now);
    }

    fn poll(&mut self, now: Micros) -> Vec<Event> {
        if self.hangs {
            return Vec::new();
        }
        self.inner.poll(now)
    }

    fn home(&mut self, now: Micros, id: CommandId) -> Result<Taken, Refusal> {
        let taken = self.inner.home(now, id)?;
        self.begun.lock().unwrap().push(id);
        Ok(taken)
    }

    fn hold(&mut self, now: Micros) -> Result<(), Refusal> {
        self.inner.hold(now)
    }

    fn resume(&mut self, now: Micros) -> Result<(), Refusal> {
        self.inner.resume(now)
    }

    fn progress(&self, now: Micros) -> Option<(CommandId, u8)> {
        self.inner.progress(now)
    }

    fn holding(&self) -> Option<&str> {
        self.inner.holding()
    }

    fn posture(&self, now: Micros) -> Option<Posture> {
        self.inner.posture(now)
    }
}

/// The far end and the line to it.
pub struct Far {
    pub end: End,
    pub gate: Gate,
    pub now: Micros,
    pub spoil: Option<Spoil>,
    /// Reading and writing fail.
    pub cut: bool,
    pub to_host: VecDeque<Packet>,
}

impl Far {
    fn carry(&mut self, way: Way, packets: Vec<Packet>) -> io::Result<Vec<Packet>> {
        let Some(spoil) = &mut self.spoil else {
            return Ok(packets);
        };
        let mut arrive = Vec::new();
        for packet in packets {
            arrive.extend(spoil(way, &packet).inspect_err(|_| self.cut = true)?);
        }
        Ok(arrive)
    }

    /// The far end takes what has come to it; gives what it says.
    pub fn take(&mut self, packet: &Packet) -> Vec<Packet> {
        let mut out = Vec::new();
        match self.gate.hear(packet.clone()) {
            Heard::Message(packet) => self.end.take(self.now, &packet, &mut out),
            Heard::Answer(packet) => return vec![packet],
            Heard::Nothing => {}
        }
        self.seal(&out)
    }

    fn seal(&mut self, out: &[Packet]) -> Vec<Packet> {
        out.iter()
            .flat_map(|packet| self.gate.say(packet))
            .collect()
    }

    /// The far end lives on, whoever listens.
    pub fn live(&mut self) {
        let mut out = Vec::new();
        self.end.poll(self.now, &mut out);
        let out = self.seal(&out);
        if !self.cut {
            let arrived = self.carry(Way::ToHost, out).unwrap_or_default();
            self.to_host.extend(arrived);
        }
    }
}

/// The host's end of the line.
pub struct Cord(pub Arc<Mutex<Far>>);

impl Carrier for Cord {
    fn send(&mut self, packet: &Packet) -> io::Result<()> {
        let mut far = self.0.lock().unwrap();
        if far.cut {
            return Err(io::Error::other("pulled"));
        }
        for packet in far.carry(Way::ToRobot, vec![packet.clone()])? {
            let out = far.take(&packet);
            let out = far.carry(Way::ToHost, out)?;
            far.to_host.extend(out);
        }
        Ok(())
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Packet>> {
        let mut far = self.0.lock().unwrap();
        far.live();
        if far.cut {
            return Err(io::Error::other("pulled"));
        }
        let packet = far.to_host.pop_front();
        drop(far);
        if packet.is_none() && !patience.is_zero() {
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(packet)
    }

    fn lost(&self) -> u64 {
        0
    }
}
