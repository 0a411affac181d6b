//! Tables in HTML and the shares they hold.

use std::fmt::Write;

use super::Material;
use crate::score::Tally;
use crate::variant::Variant;

/// A share with one decimal, or a dash.
pub fn cell(x: Option<f64>) -> String {
    x.map_or_else(|| "–".to_owned(), |x| format!("{x:.1}"))
}

/// One row.
pub fn row(cells: &[String]) -> String {
    let mut out = String::from("<tr>");
    for cell in cells {
        let _ = write!(out, "<td>{cell}</td>");
    }
    out + "</tr>\n"
}

/// A table of rows under heads.
pub fn table(heads: &[&str], rows: &str) -> String {
    let heads: String = heads.iter().map(|h| format!("<th>{h}</th>")).collect();
    format!("<table><tr>{heads}</tr>\n{rows}</table>")
}

/// The variant and its share over sets.
pub fn share(
    material: &Material<'_>,
    sets: &[String],
    variant: Variant,
    count: impl Fn(&Tally) -> usize,
) -> Option<f64> {
    let tally = material.results.tally(sets, variant)?;
    Some(tally.percent(count(&tally)))
}
