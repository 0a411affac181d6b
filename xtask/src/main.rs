//! `cargo xtask COMMAND`: everything that CI and the README call.
//!
//! | command | does |
//! |---|---|
//! | `setup` | gets what is missing: the target or a compiler that can build it, QEMU |
//! | `demo` | plays a tabletop session on the unit in QEMU with a simulated Panda |
//! | `firmware` | builds the images of both boards |
//! | `qemu` | boots the unit in QEMU and says how to connect |
//! | `budget` | measures the image against its golden figures |
//! | `growth` | measures how a decision's cost grows with what there is |
//! | `test` | formatting, lints, all tests, both images, budgets |
//! | `fci` | plays the session on an arm that speaks its own network interface (franka-sim) |
//! | `can` | tries the robot's links on a real CAN bus, if need be in a Linux of its own |
//! | `latency` | measures how soon a decision is accepted by a robot, over every link |
//! | `fuzz` | fuzzes every door of core and bridge |
//! | `interface` | sees that nothing in the core can panic or format |
//! | `key` | makes a key for one board |
//! | `deny` | sees that every library's licence and origin will do |
//! | `versions` | sees that the oldest compiler and libraries that the manifests allow will do |
//! | `faults` | plays sessions under faults of every kind |
//! | `soak` | operates the unit in QEMU for an hour of its time, under faults |

mod board;
mod budget;
mod cmd;
mod growth;
mod guest;
mod moonshine;
mod process;
mod python;
mod qemu;
mod robots;
mod toolchain;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Setup(cmd::setup::Setup),
    Demo(cmd::demo::Demo),
    Firmware(cmd::firmware::Firmware),
    Qemu(cmd::qemu::Qemu),
    Budget(cmd::budget::Budget),
    Growth(cmd::growth::Growth),
    Test(cmd::test::Test),
    Fci(cmd::fci::Fci),
    Can(cmd::can::Can),
    Latency(cmd::latency::Latency),
    Fuzz(cmd::fuzz::Fuzz),
    Faults(cmd::faults::Faults),
    Soak(cmd::soak::Soak),
    Key(cmd::key::MakeKey),
    Interface(cmd::interface::Interface),
    Deny(cmd::deny::Deny),
    Versions(cmd::versions::Versions),
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Setup(setup) => setup.run(),
        Command::Demo(demo) => demo.run(),
        Command::Firmware(firmware) => firmware.run(),
        Command::Qemu(qemu) => qemu.run(),
        Command::Budget(budget) => budget.run(),
        Command::Growth(growth) => growth.run(),
        Command::Test(test) => test.run(),
        Command::Fci(fci) => fci.run(),
        Command::Can(can) => can.run(),
        Command::Latency(latency) => latency.run(),
        Command::Fuzz(fuzz) => fuzz.run(),
        Command::Faults(faults) => faults.run(),
        Command::Soak(soak) => soak.run(),
        Command::Key(key) => key.run(),
        Command::Interface(interface) => interface.run(),
        Command::Deny(deny) => deny.run(),
        Command::Versions(versions) => versions.run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}
