//! An arm that speaks its own network interface, simulated by franka-sim (MuJoCo, about 100 MB from PyPI).

use std::fs;
use std::net::{Ipv4Addr, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

use crate::process;
use crate::python::Environment;

/// The release that this was tested with.
const PACKAGE: &str = "franka-sim==1.1.7";

/// Writes the model that is simulated.
const MODEL: &str = include_str!("fci_model.py");

/// How long the simulator may take to start.
const PATIENCE: Duration = Duration::from_secs(60);

/// The port of the arm's interface.
const PORT: u16 = 1337;

/// Installs the simulator beside the other build products; gives where.
pub fn install() -> Result<PathBuf> {
    let place = process::target().join("franka-sim");
    let model = place.join("fr3.xml");
    if model.is_file() {
        return Ok(place);
    }
    eprintln!("installing {PACKAGE}");
    let python = Environment::create(&place)?;
    process::run(python.install().args(["--retries", "1", PACKAGE]))
        .context("franka-sim cannot be fetched from PyPI")?;
    let script = place.join("fci_model.py");
    fs::write(&script, MODEL)?;
    process::run(Command::new(python.interpreter()).arg(script).arg(&model))?;
    Ok(place)
}

/// Whether a network namespace can be made: the simulator listens on all addresses.
pub fn has_namespaces() -> bool {
    process::output(&mut in_a_namespace("true")).is_some()
}

/// A line of shell in a network namespace of its own, with only its loopback interface.
pub fn in_a_namespace(line: &str) -> Command {
    let mut command = Command::new("unshare");
    let user = process::output(Command::new("id").arg("-u"));
    if user.is_none_or(|user| user.trim() != "0") {
        command.arg("--map-root-user");
    }
    // A thousand commands a second are lost on a machine that has much else to do. Where more priority cannot be had,
    // `nice` says so and goes on without.
    command
        .args(["--net", "nice", "-n", "-15", "sh", "-c"])
        .arg(format!("ip link set lo up && {line}"));
    command
}

/// A running simulator, ended whatever happens.
pub struct Simulator(Child);

impl Drop for Simulator {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Starts what [`install`] has installed.
pub fn start(place: &Path) -> Result<Simulator> {
    let log = place.join("log.txt");
    let to = fs::File::create(&log)?;
    let child = Command::new(place.join("bin/run-franka-sim-server"))
        // Whatever is grasped is as wide as the things that the arm thinks of.
        .args(["--gripper-object-width", "0.04"])
        .env("FR3_MJCF", place.join("fr3.xml"))
        .stdin(Stdio::null())
        .stdout(to.try_clone()?)
        .stderr(to)
        .spawn()
        .context("cannot start franka-sim")?;
    let simulator = Simulator(child);
    let until = Instant::now() + PATIENCE;
    while !fs::read_to_string(&log)?.contains("Server ready for new client") {
        if Instant::now() > until {
            bail!("franka-sim does not start; see {}", log.display());
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    // The port answers a moment after the log says so.
    while TcpStream::connect((Ipv4Addr::LOCALHOST, PORT)).is_err() && Instant::now() < until {
        std::thread::sleep(Duration::from_millis(100));
    }
    Ok(simulator)
}
