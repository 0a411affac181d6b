//! The demo on a robot behind each of the links that there are, side by side in one table. What can be sealed is.

mod franka_sim;
mod guest_board;
mod played;

use std::path::Path;

use anyhow::{Context, Result, ensure};
use serde::Serialize;

use crate::cmd::key;
use crate::guest::{self, INTERFACE};
use crate::process;

pub use played::{Bridge, Row};

/// How a robot is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// Simulated in the bridge's process.
    Inside,
    /// Simulated in another process, which listens there.
    Listening(&'static str),
    /// Simulated in another process, on a CAN interface of Linux.
    Can,
    /// An arm on its own network interface.
    Fci,
}

impl Link {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Inside,
        Self::Listening("tcp:127.0.0.1:0"),
        Self::Listening("serial:pty"),
        Self::Listening("slcan:pty"),
        Self::Can,
        Self::Fci,
    ];

    /// The link of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|link| link.name() == name)
    }

    /// What it is called in a table.
    fn name(self) -> &'static str {
        match self {
            Self::Inside => "inside",
            Self::Listening(at) => at.trim_end_matches(":127.0.0.1:0"),
            Self::Can => "can:vcan0",
            Self::Fci => "fci:127.0.0.1",
        }
    }
}

/// What came of a link.
#[derive(Clone, Debug, Serialize)]
pub struct Column {
    /// The link.
    pub link: &'static str,
    /// Why it was not tried, if it was not.
    pub skipped: Option<String>,
    /// What became of the commands.
    pub rows: Vec<Row>,
}

/// Plays the demo over a link; an error when it fails, a reason where this machine cannot try it.
fn play(bridge: &Bridge, link: Link) -> Result<Column> {
    let played = match link {
        Link::Inside => Ok(bridge.play("sim", None)?),
        Link::Listening(at) => {
            let key = key::for_trials()?;
            let (_far, address) = played::Far::listening(bridge, at, &key)?;
            Ok(bridge.play(&address, Some(&key))?)
        }
        Link::Can if !guest::is_possible() => Err(guest::MISSING.to_owned()),
        Link::Can if guest::has_can() => {
            let (at, key) = (format!("can:{INTERFACE}"), key::for_trials()?);
            let (_far, address) = played::Far::listening(bridge, &at, &key)?;
            Ok(bridge.play(&address, Some(&key))?)
        }
        Link::Can => Ok(guest_board::play(bridge)?),
        Link::Fci => fci(bridge)?,
    };
    let (rows, skipped) = match played {
        Ok(rows) => (rows, None),
        Err(why) => (Vec::new(), Some(why)),
    };
    let link = link.name();
    Ok(Column {
        link,
        skipped,
        rows,
    })
}

/// Plays on franka-sim in a network namespace of its own; the reason where that cannot be.
fn fci(bridge: &Bridge) -> Result<Result<Vec<Row>, String>> {
    if !franka_sim::has_namespaces() {
        return Ok(Err(
            "no network namespace can be made: `unshare` and `ip` and the right to use them are needed".into(),
        ));
    }
    let place = match franka_sim::install() {
        Ok(place) => place,
        Err(error) => return Ok(Err(format!("{error:#}"))),
    };
    let this = std::env::current_exe().context("cannot find this program")?;
    let image = bridge.image.as_deref().unwrap_or(Path::new(""));
    let line = "exec \"$0\" fci --inside \"$1\" --image \"$2\"";
    let mut command = franka_sim::in_a_namespace(line);
    command.arg(this).arg(place).arg(image);
    let output = command.stderr(std::process::Stdio::inherit()).output()?;
    let printed = String::from_utf8_lossy(&output.stdout);
    let rows = printed.lines().last().map(serde_json::from_str);
    let rows = rows.context("nothing was played on franka-sim")?;
    Ok(Ok(rows.context("the session on franka-sim failed")?))
}

/// What [`fci`] runs in the namespace: prints the rows.
pub fn play_in_namespace(place: &Path, image: &Path) -> Result<()> {
    let image = image.is_file().then(|| image.to_owned());
    let bridge = Bridge::built(image)?;
    let _simulator = franka_sim::start(place)?;
    let rows = bridge.play("fci:127.0.0.1,no-realtime", None)?;
    println!("{}", serde_json::to_string(&rows)?);
    Ok(())
}

/// How results are wanted.
pub struct Wanted {
    /// As one line of JSON.
    pub json: bool,
    /// A link that cannot be tried here is an error.
    pub required: bool,
}

/// Plays the demo over these links, prints one table, and says whether all ended alike.
pub fn compare(bridge: &Bridge, links: &[Link], wanted: &Wanted) -> Result<()> {
    let mut columns = Vec::new();
    for link in links {
        eprintln!("playing: {}", link.name());
        columns.push(play(bridge, *link)?);
    }
    let (first, others) = columns.split_first().context("no link")?;
    let alike = others.iter().filter(|c| c.skipped.is_none()).all(|c| {
        c.rows.len() == first.rows.len() && c.rows.iter().zip(&first.rows).all(|(a, b)| a.is_as(b))
    });
    if wanted.json {
        let told = serde_json::json!({ "event": "robots", "alike": alike, "links": columns });
        println!("{told}");
    } else {
        print(first, others);
    }
    for column in others {
        if let Some(why) = &column.skipped {
            ensure!(!wanted.required, "{}: {why}", column.link);
            eprintln!("skipped {}: {why}", column.link);
        }
    }
    ensure!(alike, "the outcomes differ");
    eprintln!("{} commands, the same outcomes", first.rows.len());
    Ok(())
}

fn print(first: &Column, others: &[Column]) {
    let head = ["said", "shown", "decided", first.link].map(str::to_owned);
    let links = others.iter().map(|c| c.link.to_owned());
    let mut table: Vec<Vec<String>> = vec![head.into_iter().chain(links).collect()];
    for (i, row) in first.rows.iter().enumerate() {
        let decided = row.decided.join(", then ");
        let mut line = vec![row.said.clone(), row.shown.clone(), decided];
        line.push(row.ending().to_owned());
        line.extend(others.iter().map(|c| match c.rows.get(i) {
            None => "skipped".to_owned(),
            Some(other) if other.is_as(row) => "same".to_owned(),
            Some(other) => format!("{}: {}", other.decided.join(", then "), other.robot),
        }));
        table.push(line);
    }
    process::print_columns(&table);
}
