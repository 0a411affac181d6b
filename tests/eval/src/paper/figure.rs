//! Figures as data: what is drawn, written as CSV and described in the report.

use crate::bound::Bound;
use crate::interval::wilson;
use crate::score::Tally;

/// A share with its 95 % interval, in percent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The share.
    pub share: f64,
    /// Its interval.
    pub interval: [f64; 2],
}

impl Point {
    /// `count` of a tally's samples.
    #[must_use]
    pub fn of(tally: &Tally, count: impl Fn(&Tally) -> usize) -> Self {
        let k = count(tally);
        Self {
            share: tally.percent(k),
            interval: wilson(k, tally.n),
        }
    }

    /// `count` of a bound's samples.
    #[must_use]
    pub fn of_bound(bound: &Bound, count: impl Fn(&Bound) -> f64) -> Self {
        let k = count(bound);
        Self {
            share: bound.percent(k),
            interval: wilson(k.round() as usize, bound.n),
        }
    }
}

/// One line, or one colour of bars.
#[derive(Clone, Debug)]
pub struct Series {
    /// What it is called.
    pub name: String,
    /// One per place of the figure; `None` where there is nothing to show.
    pub points: Vec<Option<Point>>,
}

/// How a figure is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A line per series over the places.
    Lines,
    /// A group of bars per place.
    Bars,
}

/// A figure of shares.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Its file's name.
    pub name: &'static str,
    /// What it shows, in one line.
    pub title: String,
    /// What to see in it.
    pub caption: String,
    /// How it is drawn.
    pub form: Form,
    /// What the places are.
    pub x: &'static str,
    /// What is counted, with its unit.
    pub y: &'static str,
    /// The places' names.
    pub places: Vec<String>,
    /// The series.
    pub series: Vec<Series>,
}

impl Figure {
    /// Whether there is anything to show.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.series
            .iter()
            .all(|s| s.points.iter().all(Option::is_none))
    }
}
