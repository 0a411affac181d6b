//! What the paper states, beside what comes out.

use std::fmt::Write;

use super::Material;
use super::table::{cell, row, share, table};
use crate::paper::claims::{stated, verdicts};

/// Numbers and orderings that the paper claims.
pub fn claims(material: &Material<'_>) -> String {
    let mut rows = String::new();
    for claim in stated() {
        let ours = share(material, &claim.sets, claim.variant, |t| t.action_decided);
        let theirs = material
            .recorded
            .and_then(|r| r.accuracy(&claim.sets, claim.variant))
            .map(|a| a.action_decided);
        let gap = ours.map(|x| x - claim.stated);
        let verdict = match (claim.within, gap) {
            (Some(within), Some(gap)) if gap.abs() <= within => "within 2 points",
            (Some(_), Some(_)) => "<span class=\"no\">not met</span>",
            (None, Some(_)) => "as it is",
            _ => "–",
        };
        rows += &row(&[
            claim.what.to_owned(),
            format!("{:.1}", claim.stated),
            cell(theirs),
            cell(ours),
            verdict.to_owned(),
        ]);
    }
    let mut out = String::from(
        "<h2>What the paper states</h2><p>Actions decided right, sum and entropy thresholds; the \
         paper counts the action alone. Its 24.3 for M1 at n4 is not what its code gives on D_A, but \
         close to what it gives on D_prop.</p>",
    );
    let heads = [
        "",
        "Paper",
        "Reference",
        "This core, reference's habits",
        "",
    ];
    out += &table(&heads, &rows);
    if let Some(verdicts) = verdicts(material.results) {
        out += "<ul>";
        for v in verdicts {
            let holds = if v.holds {
                "holds"
            } else {
                "<span class=\"no\">does not hold</span>"
            };
            let _ = write!(out, "<li>{}: {holds} ({}).</li>", v.says, v.figures);
        }
        out += "</ul>";
    }
    out
}
