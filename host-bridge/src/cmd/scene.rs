//! `deictic scene`: what is on the table of a running session, and changes of it.

use clap::{Args, Subcommand};
use miette::{IntoDiagnostic, Result, WrapErr, miette};
use serde_json::Value;

use super::{advice, json};
use crate::scene::feed;
use crate::scene::line::Thing;
use crate::scene::{Likelihood, SceneLine};

/// Show or change the table of a session that was started with `deictic run --scene-port PORT`
///
/// ```text
/// $ deictic scene set --port 7800 --object can --at 0.4,0.1,0.06 --feature full-liquid=0.3
/// $ deictic scene set --port 7800 --remove --object cup
/// $ deictic scene show --port 7800
/// ```
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
pub struct Scene {
    #[command(subcommand)]
    what: What,
}

#[derive(Clone, Debug, Subcommand)]
enum What {
    /// Print what is on the table
    Show(Show),
    /// Change one thing; what is not named stays as it is
    Set(Set),
}

#[derive(Args, Clone, Debug)]
struct Show {
    /// The session's scene port
    #[arg(long)]
    port: u16,
}

#[derive(Args, Clone, Debug)]
struct Set {
    /// The session's scene port
    #[arg(long)]
    port: u16,
    /// The thing, when it is an object
    #[arg(
        long,
        value_name = "NAME",
        required_unless_present = "storage",
        conflicts_with = "storage"
    )]
    object: Option<String>,
    /// The thing, when it is a storage
    #[arg(long, value_name = "NAME")]
    storage: Option<String>,
    /// Where it is, in metres in the robot's base frame
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    at: Option<[f32; 3]>,
    /// A feature and its likelihood in 0..=1, or true or false; may be given several times
    #[arg(long, value_name = "NAME=LIKELIHOOD", value_parser = feature)]
    feature: Vec<(String, Likelihood)>,
    /// It is gone
    #[arg(long, conflicts_with_all = ["at", "feature"])]
    remove: bool,
}

fn place(written: &str) -> Result<[f32; 3], String> {
    let numbers: Result<Vec<f32>, _> = written.split(',').map(|n| n.trim().parse()).collect();
    let finite = numbers.ok().filter(|all| all.iter().all(|n| n.is_finite()));
    let place = finite.and_then(|numbers| numbers.try_into().ok());
    place.ok_or_else(|| {
        format!("`{written}` is no place; write three finite numbers, in metres, as 0.4,-0.1,0.06")
    })
}

fn feature(written: &str) -> Result<(String, Likelihood), String> {
    let error = || {
        format!(
            "`{written}` is no feature with a likelihood from 0 to 1; write it as glued=0.8 or glued=true"
        )
    };
    let (name, likelihood) = written.split_once('=').ok_or_else(error)?;
    let likelihood = match likelihood {
        "true" => Likelihood::Certain(true),
        "false" => Likelihood::Certain(false),
        number => Likelihood::Some(number.parse().map_err(|_| error())?),
    };
    likelihood.value().map_err(|_| error())?;
    Ok((name.to_owned(), likelihood))
}

impl Scene {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        let (port, line) = match self.what {
            What::Show(show) => (show.port, SceneLine::Show),
            What::Set(set) => {
                let thing = Thing {
                    object: set.object,
                    storage: set.storage,
                    position: set.at,
                    features: set.feature.into_iter().collect(),
                };
                let line = if set.remove {
                    SceneLine::Remove(thing)
                } else {
                    SceneLine::Change(thing)
                };
                (set.port, line)
            }
        };
        let line = serde_json::to_string(&line).into_diagnostic()?;
        let answer = feed::ask(port, &line).map_err(|e| {
            advice(
                format!("no session takes scenes at port {port}: {e}"),
                "start one with `deictic run --scene-port PORT`",
            )
        })?;
        let answer: Value = serde_json::from_str(&answer)
            .into_diagnostic()
            .wrap_err("the answer is no JSON")?;
        if let Some(error) = answer["error"].as_str() {
            return Err(advice(error, answer["remedy"].as_str().unwrap_or_default()));
        }
        let things = answer["things"].as_array();
        for thing in things.ok_or_else(|| miette!("the answer names no things"))? {
            json::print(thing);
        }
        Ok(())
    }
}
