//! Pictures of a session: a file for every step, and a live one on the terminal.

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use miette::{IntoDiagnostic, Result, WrapErr};

use crate::draw::{HEIGHT, Picture, svg, text};
use crate::robot::Event;
use crate::session::{Happening, Session};

/// How often the live picture is drawn.
const EVERY: Duration = Duration::from_millis(100);

/// Which pictures.
#[derive(Args, Clone, Debug, Default)]
pub struct Draw {
    /// Draw arm and table into a file of this folder (SVG) for every step of the robot
    #[arg(long, value_name = "DIR")]
    draw: Option<PathBuf>,
    /// Draw arm and table at the top of the terminal, all the time
    #[arg(long, conflicts_with = "json")]
    live: bool,
}

impl Draw {
    /// Begins to draw.
    ///
    /// # Errors
    /// When the folder cannot be made.
    pub fn open(&self) -> Result<Pictures> {
        if let Some(folder) = &self.draw {
            std::fs::create_dir_all(folder)
                .into_diagnostic()
                .wrap_err_with(|| format!("{} cannot be made", folder.display()))?;
        }
        let live = self.live && io::stdout().is_terminal();
        if live {
            // Clears the screen and keeps the picture's lines out of what scrolls.
            let first = HEIGHT + 2;
            print!("\x1b[2J\x1b[{first}r\x1b[{first};1H");
        }
        Ok(Pictures {
            folder: self.draw.clone(),
            number: 0,
            live: live.then(Instant::now),
        })
    }
}

/// Draws a session.
#[derive(Debug)]
pub struct Pictures {
    folder: Option<PathBuf>,
    number: usize,
    /// When the live picture is due.
    live: Option<Instant>,
}

fn picture(session: &Session<'_>, caption: &str) -> Picture {
    let (posture, holding) = (session.posture(), session.holding());
    Picture::of(
        posture,
        holding,
        session.table(),
        session.lexicon(),
        caption,
    )
}

/// A file's name for a caption: what is no letter or digit becomes a dash.
fn plain(caption: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() { c } else { '-' };
    caption.chars().map(plain).collect()
}

fn write(folder: &Path, number: usize, caption: &str, picture: &Picture) -> Result<()> {
    let path = folder.join(format!("{number:04}-{}.svg", plain(caption)));
    std::fs::write(&path, svg(picture))
        .into_diagnostic()
        .wrap_err_with(|| format!("{} cannot be written", path.display()))
}

impl Pictures {
    /// Draws what happens into a file, if it is a step of the robot.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn happening(&mut self, happening: &Happening, session: &Session<'_>) -> Result<()> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let caption = match happening {
            Happening::Robot(Event::Begun { step, .. }) => step.clone(),
            Happening::Robot(Event::Done(_)) => "done".to_owned(),
            Happening::Robot(Event::Stopped { step, .. }) => format!("stopped: {step}"),
            Happening::Robot(Event::Failed { .. }) => "failed".to_owned(),
            _ => return Ok(()),
        };
        self.number += 1;
        write(folder, self.number, &caption, &picture(session, &caption))
    }

    /// Draws the live picture when it is due.
    pub fn turn(&mut self, session: &Session<'_>) {
        let now = Instant::now();
        let Some(due) = self.live.as_mut().filter(|due| **due <= now) else {
            return;
        };
        *due = now + EVERY;
        // What a person types stays where it is: the cursor is put back.
        let mut out = String::from("\x1b7");
        for (i, line) in text(&picture(session, "")).iter().enumerate() {
            out.push_str(&format!("\x1b[{};1H{line}\x1b[K", i + 1));
        }
        out.push_str("\x1b8");
        let mut stdout = io::stdout();
        let _ = stdout
            .write_all(out.as_bytes())
            .and_then(|()| stdout.flush());
    }
}

impl Drop for Pictures {
    fn drop(&mut self) {
        if self.live.is_some() {
            println!("\x1b[r\x1b[999;1H");
        }
    }
}
