//! What answers at the other end may be another version, a smaller unit, or no unit at all.

mod common;

use std::time::Duration;

use common::*;
use deictic::link::{Inside, Wire};
use deictic::unit::{GestureUnit, UnitError};
use deictic::vocabulary::Lexicon;
use deictic_core::large::{self, Link, ToHost, ToUnit};
use deictic_core::protocol::message::{Configuration, Hello};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};

/// A unit of another version: it answers every Hello with its own.
struct Other(Box<Link>, Vec<u8>);

impl Wire for Other {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        for &byte in bytes {
            if let Some(received) = self.0.receive::<ToUnit>(byte) {
                assert!(
                    matches!(received.message, ToUnit::Hello(_)),
                    "it was told more"
                );
                let hello = Hello {
                    version: VERSION + 1,
                    schema: !SCHEMA,
                    boot: 1,
                    capacities: large::Unit::capacities(),
                };
                let mut out = Outbox::<256>::new();
                assert!(self.0.send::<ToHost, 256>(&ToHost::Hello(hello), &mut out));
                self.1.extend(out.waiting());
            }
        }
        Ok(())
    }

    fn read(&mut self, buffer: &mut [u8], _: Duration) -> std::io::Result<usize> {
        let n = self.1.len().min(buffer.len());
        buffer[..n].copy_from_slice(&self.1[..n]);
        self.1.drain(..n);
        Ok(n)
    }
}

#[test]
fn another_version_is_named_with_ours_and_told_nothing() {
    let lexicon = lexicon();
    let table = table(&lexicon);
    let opener = Box::new(|| Ok(Box::new(Other(Box::default(), Vec::new())) as Box<dyn Wire>));
    let (words, scene) = (lexicon.vocabulary(), table.scene());
    let connected = GestureUnit::over(opener, words, scene, Configuration::DEFAULT);
    let Err(error) = connected else {
        panic!("it connected")
    };
    assert!(matches!(
        error,
        UnitError::Schema {
            unit: (2, _),
            host: (1, SCHEMA)
        }
    ));
    let said = error.to_string();
    assert!(
        said.contains("version 2") && said.contains("version 1"),
        "{said}"
    );
    let help = miette::Diagnostic::help(&error).unwrap().to_string();
    assert!(help.contains("flash"), "{help}");
}

#[test]
fn what_a_unit_cannot_hold_is_said_before_it_is_sent() {
    let actions: String = (0..17)
        .map(|i| format!("[[action]]\nname = \"a{i}\"\n"))
        .collect();
    let lexicon = Lexicon::parse("x", &format!("name = \"x\"\n{actions}")).unwrap();
    let empty = deictic::scene::SceneFile::parse("x", "").unwrap();
    let table = empty.tabletop(&lexicon).unwrap();
    let opener = Box::new(|| Ok(Box::new(Inside::start()) as Box<dyn Wire>));
    let (words, scene) = (lexicon.vocabulary(), table.scene());
    let connected = GestureUnit::over(opener, words, scene, Configuration::DEFAULT);
    assert!(matches!(
        connected.err(),
        Some(UnitError::TooLarge {
            capacity: 16,
            wanted: 17,
            ..
        })
    ));
}

/// A line on which something that is no unit chatters.
struct Chatter(u32);

impl Wire for Chatter {
    fn write(&mut self, _: &[u8]) -> std::io::Result<()> {
        Ok(())
    }

    fn read(&mut self, buffer: &mut [u8], _: Duration) -> std::io::Result<usize> {
        for byte in buffer.iter_mut() {
            self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *byte = (self.0 >> 24) as u8;
        }
        Ok(buffer.len())
    }
}

#[test]
fn what_is_no_unit_is_not_taken_for_one() {
    let lexicon = lexicon();
    let table = table(&lexicon);
    let opener = Box::new(|| Ok(Box::new(Chatter(7)) as Box<dyn Wire>));
    let (words, scene) = (lexicon.vocabulary(), table.scene());
    let connected = GestureUnit::over(opener, words, scene, Configuration::DEFAULT);
    assert!(matches!(connected.err(), Some(UnitError::NoAnswer)));
}
