//! The counts behind the report, for other programs.

use std::path::Path;

use super::Results;
use super::figure::Figure;
use crate::interval::wilson;
use crate::score::Score;

/// Writes one row per set and variant.
///
/// # Errors
/// The system's.
pub fn scores(path: &Path, results: &Results) -> csv::Result<()> {
    let mut out = csv::Writer::from_path(path)?;
    out.write_record([
        "set",
        "model",
        "merge",
        "threshold",
        "profile",
        "n",
        "triple_argmax",
        "triple_argmax_low",
        "triple_argmax_high",
        "action_argmax",
        "triple_decided",
        "action_decided",
        "triple_wrong_executed",
        "action_wrong_executed",
        "undecided",
    ])?;
    for (set, variant, tally) in results.iter() {
        let score = Score::new(set, variant, tally);
        let s = score.shares;
        let [low, high] = score.interval_95.triple_argmax;
        let numbers = [
            s.triple_argmax,
            low,
            high,
            s.action_argmax,
            s.triple_decided,
            s.action_decided,
            s.triple_wrong_executed,
            s.action_wrong_executed,
            s.undecided,
        ];
        let names = [
            score.file,
            score.model,
            score.merge,
            score.threshold,
            score.profile,
        ];
        let cells = names
            .into_iter()
            .chain([score.n.to_string()])
            .chain(numbers.map(|x| format!("{x:.3}")));
        out.write_record(cells)?;
    }
    out.flush()?;
    Ok(())
}

/// Writes one row per set: its bound.
///
/// # Errors
/// The system's.
pub fn bounds(path: &Path, results: &Results) -> csv::Result<()> {
    let mut out = csv::Writer::from_path(path)?;
    out.write_record([
        "set",
        "n",
        "triple",
        "triple_low",
        "triple_high",
        "action",
        "floor",
    ])?;
    for (set, bound) in results.bounds() {
        let [low, high] = wilson(bound.triple as usize, bound.n);
        let numbers = [
            bound.percent(bound.triple),
            low,
            high,
            bound.percent(bound.action),
            bound.percent(bound.floor),
        ];
        let cells = [set.to_owned(), bound.n.to_string()];
        out.write_record(cells.into_iter().chain(numbers.map(|x| format!("{x:.3}"))))?;
    }
    out.flush()?;
    Ok(())
}

/// Writes one row per point of a figure.
///
/// # Errors
/// The system's.
pub fn figure(path: &Path, figure: &Figure) -> csv::Result<()> {
    let mut out = csv::Writer::from_path(path)?;
    out.write_record([figure.x, "series", figure.y, "low", "high"])?;
    for series in &figure.series {
        for (place, point) in figure.places.iter().zip(&series.points) {
            if let Some(point) = point {
                let [low, high] = point.interval;
                out.write_record([
                    place.clone(),
                    series.name.clone(),
                    format!("{:.3}", point.share),
                    format!("{low:.3}"),
                    format!("{high:.3}"),
                ])?;
            }
        }
    }
    out.flush()?;
    Ok(())
}
