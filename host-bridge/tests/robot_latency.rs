//! How soon a decision that leaves the unit is accepted by the robot, over every link, and how much of that is the
//! bridge's own share: from the decision's last byte to the first byte of the command, and from the last byte of the
//! acceptance to the session's saying so.
//!
//! `DEICTIC_COMMANDS` says how many commands every link is given, 200 when it is not there. `DEICTIC_CAN` names a CAN
//! interface of this machine; with it that link alone is tried, without it all others. `cargo xtask latency` runs both
//! and makes a table.

#[path = "common/bus.rs"]
mod bus;
#[path = "common/stamps.rs"]
mod stamps;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use deictic::answering::certainly;
use deictic::link::{self, Pair, Wire};
use deictic::robot::Event;
use deictic::robot::end::{End, Listener, Served};
use deictic::robot::remote::{Carrier, OnBus, Opener, Remote};
use deictic::robot::sim::Sim;
use deictic::robot::way;
use deictic::scene::SceneFile;
use deictic::session::{Happening, Session};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::command::parcel::Sender;
use deictic_core::protocol::message::Configuration;
use deictic_core::time::Micros;
use stamps::{Shares, Stamped, StampedCarrier, Stamps};

/// A robot that is served in this process until the switch is thrown; how it is reached.
fn serve(listener: Listener, over: &Arc<AtomicBool>) -> way::Way {
    let address = listener.address().parse().unwrap();
    let end = End::new(Box::new(Sim::new(1.0)), Lexicon::tabletop().unwrap(), 1);
    let over = Arc::clone(over);
    thread::spawn(move || {
        let mut served = Served::new(end, listener);
        while !over.load(Ordering::Relaxed) {
            served.turn(Duration::from_millis(20));
        }
    });
    address
}

/// A robot behind a bus that takes no time.
fn without_a_line(over: &Arc<AtomicBool>) -> Opener {
    let bus = bus::MemoryBus::default();
    let mut theirs = OnBus::new(Box::new(bus.node()), Sender::Robot);
    let mut end = End::new(Box::new(Sim::new(1.0)), Lexicon::tabletop().unwrap(), 1);
    let over = Arc::clone(over);
    thread::spawn(move || {
        let began = Instant::now();
        let now = || Micros(u64::try_from(began.elapsed().as_micros()).unwrap());
        while !over.load(Ordering::Relaxed) {
            let mut out = Vec::new();
            end.poll(now(), &mut out);
            if let Some(packet) = theirs.receive(Duration::from_millis(5)).unwrap() {
                end.take(now(), &packet, &mut out);
            }
            for packet in out {
                theirs.send(&packet).unwrap();
            }
        }
    });
    Box::new(move || {
        let ours = OnBus::new(Box::new(bus.node()), Sender::Host);
        Ok(Box::new(ours) as Box<dyn Carrier>)
    })
}

/// Has the unit decide so many commands, each stopped as soon as it is accepted.
fn measure(mut open: Opener, commands: usize) -> Shares {
    let lexicon = Lexicon::tabletop().unwrap();
    let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
    let stamps = Stamps::default();
    let on_wire = stamps.clone();
    let unit = Box::new(move || {
        let wire = link::open(&link::Address::Inside)?;
        Ok(Box::new(Stamped::new(wire, on_wire.clone())) as Box<dyn Wire>)
    });
    let on_carrier = stamps.clone();
    let robot: Opener = Box::new(move || {
        let carrier = open()?;
        Ok(Box::new(StampedCarrier::new(carrier, on_carrier.clone())) as Box<dyn Carrier>)
    });
    let mut robot = Remote::open(robot, &lexicon).unwrap();
    robot.wait(Duration::from_secs(3)).unwrap();
    let configuration = Configuration {
        window: Micros::from_millis(1),
        ..Configuration::DEFAULT
    };
    let mut session = Session::open(unit, Box::new(robot), table, &lexicon, configuration).unwrap();
    let action = lexicon.option(Category::ACTION, "move-up").unwrap();
    let move_up = certainly(Category::ACTION, action, &lexicon).unwrap();
    let mut shares = Shares::default();
    for number in 0..commands {
        stamps.clear();
        session.observe(move_up.clone()).unwrap();
        let given = Instant::now();
        // A machine that stalls for longer than a beat may be late makes the robot stop: it counts as failed.
        let (mut accepted, mut failed) = (false, false);
        while !(accepted || failed) || !session.is_idle() {
            assert!(
                given.elapsed() < Duration::from_secs(10),
                "command {number}"
            );
            let patience = if accepted { 1 } else { 10 };
            for happening in session.turn(Duration::from_millis(patience)) {
                match happening {
                    Happening::Accepted(_) => {
                        stamps.told();
                        accepted = true;
                        session.stop();
                    }
                    Happening::Robot(Event::Failed { .. }) | Happening::Refused { .. } => {
                        failed = true;
                    }
                    _ => {}
                }
            }
        }
        shares.take(&stamps);
    }
    shares
}

/// How many commands every link is given.
fn commands() -> usize {
    std::env::var("DEICTIC_COMMANDS").map_or(200, |n| n.parse().unwrap())
}

fn opener(listener: Listener, over: &Arc<AtomicBool>) -> Opener {
    let way = serve(listener, over);
    Box::new(move || way::carrier(&way).map_err(std::io::Error::other))
}

#[test]
fn a_decision_is_accepted_over_every_link_and_the_bridges_share_is_known() {
    let links: Vec<String> = match std::env::var("DEICTIC_CAN") {
        Ok(interface) => vec![format!("can:{interface}"), format!("can:{interface},fd")],
        Err(_) => ["none", "tcp", "serial", "slcan"].map(str::to_owned).into(),
    };
    for link in links {
        let over = Arc::new(AtomicBool::new(false));
        let pair = |adapter| Listener::Pair {
            pair: Pair::open().unwrap(),
            adapter,
        };
        let port = |way: &str| Listener::open(&way.parse().unwrap()).unwrap();
        let open = match link.as_str() {
            "none" => without_a_line(&over),
            "tcp" => opener(port("tcp:127.0.0.1:0"), &over),
            "serial" => opener(pair(false), &over),
            "slcan" => opener(pair(true), &over),
            way => opener(port(way), &over),
        };
        let shares = measure(open, commands());
        over.store(true, Ordering::Relaxed);
        println!("{}", shares.told(&link));
        // Stalls of this machine that make the robot stop are left out; a link that hardly carries anything is not.
        let count = shares.count();
        assert!(count * 2 > commands(), "{link}: {count}");
    }
}
