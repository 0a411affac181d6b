use std::fs;
use std::net::{Ipv4Addr, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::process::{self, cargo, root};

/// Play the tabletop session on an arm that speaks its own network interface, and compare.
///
/// Installs franka-sim (MuJoCo, about 100 MB from PyPI) beside the other build products, starts it in a network
/// namespace of its own, as it listens on all addresses, and plays the same commands on it and on the simulated arm:
/// the outcomes must be the same. Takes some minutes, as that arm moves in real time.
#[derive(Args)]
pub struct Fci {
    /// Where franka-sim was installed; set by the command itself inside the network namespace
    #[arg(long, hide = true)]
    inside: Option<PathBuf>,
}

/// The release that this was tested with.
const PACKAGE: &str = "franka-sim==1.1.7";

/// Writes the model that is simulated.
const MODEL: &str = include_str!("fci_model.py");

/// How long the simulator may take to start.
const PATIENCE: Duration = Duration::from_secs(60);

/// The port of the arm's interface.
const PORT: u16 = 1337;

impl Fci {
    pub fn run(self) -> Result<()> {
        if let Some(place) = &self.inside {
            return compare(place);
        }
        process::run(cargo().args(["build", "--package", "deictic"]))?;
        let place = install()?;
        let this = std::env::current_exe().context("cannot find this program")?;
        let mut command = Command::new("unshare");
        let user = process::output(Command::new("id").arg("-u"));
        if user.is_none_or(|user| user.trim() != "0") {
            command.arg("--map-root-user");
        }
        // A thousand commands a second are lost on a machine that has much else to do. Where more priority cannot be had,
        // `nice` says so and goes on without.
        command
            .args(["--net", "nice", "-n", "-15", "sh", "-c"])
            .arg("ip link set lo up && exec \"$0\" fci --inside \"$1\"")
            .args([this, place]);
        process::run(&mut command)
    }
}

/// Installs the simulator; gives where.
fn install() -> Result<PathBuf> {
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    let place = target.join("franka-sim");
    let model = place.join("fr3.xml");
    if model.is_file() {
        return Ok(place);
    }
    eprintln!("installing {PACKAGE}");
    process::run(Command::new("python3").args(["-m", "venv"]).arg(&place))
        .context("Python's venv is needed: `apt-get install python3-venv`")?;
    let pip = place.join("bin/pip");
    process::run(Command::new(pip).args(["install", "--quiet", PACKAGE]))?;
    let script = place.join("fci_model.py");
    fs::write(&script, MODEL)?;
    process::run(
        Command::new(place.join("bin/python"))
            .arg(script)
            .arg(&model),
    )?;
    Ok(place)
}

/// Ends the simulator whatever happens.
struct Simulator(Child);

impl Drop for Simulator {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn start(place: &Path) -> Result<Simulator> {
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

/// One command's row: what was said and shown, what was decided, what the robot did.
type Row = [String; 4];

/// Plays the session on a robot; gives its summary.
fn play(robot: &str, haste: &str) -> Result<Vec<Row>> {
    // Built a moment ago, outside the network namespace, beside this program.
    let bridge = std::env::current_exe()?.with_file_name("deictic");
    let mut command = Command::new(bridge);
    command.args(["play", "--json"]);
    command.args(["--robot", robot, "--haste", haste]);
    let printed = process::output(&mut command);
    let printed = printed.with_context(|| format!("the session with {robot} failed"))?;
    let line = printed.lines().last().unwrap_or_default();
    let summary: serde_json::Value = serde_json::from_str(line)?;
    let rows = summary["rows"].as_array().context("no summary")?;
    let text = |value: &serde_json::Value| match value.as_array() {
        Some(all) => all
            .iter()
            .filter_map(|v| v.as_str())
            .collect::<Vec<_>>()
            .join(", then "),
        None => value.as_str().unwrap_or_default().to_owned(),
    };
    let row =
        |row: &serde_json::Value| ["said", "shown", "decided", "robot"].map(|key| text(&row[key]));
    Ok(rows.iter().map(row).collect())
}

fn compare(place: &Path) -> Result<()> {
    let expected = play("sim", "8")?;
    let _simulator = start(place)?;
    let found = play("fci:127.0.0.1,no-realtime", "1")?;
    println!(
        "{:<28} {:<21} {:<44} {:<24} over FCI",
        "said", "shown", "decided", "simulated"
    );
    for (e, f) in expected.iter().zip(&found) {
        let ([said, shown, decided, robot], [.., other]) = (e, f);
        println!("{said:<28} {shown:<21} {decided:<44} {robot:<24} {other}");
    }
    ensure!(expected == found, "the outcomes differ");
    println!("{} commands, the same outcomes", found.len());
    Ok(())
}
