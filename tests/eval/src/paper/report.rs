//! One HTML file with everything in it.

use super::Results;
use super::figure::Figure;
use super::recorded::Recorded;

mod apart;
mod simulated;
mod stated;
mod table;

const STYLE: &str = "body{font:16px/1.5 sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;\
    color:#111}table{border-collapse:collapse;margin:1rem 0}td,th{padding:.2rem .7rem;\
    border-bottom:1px solid #ccc;text-align:right}td:first-child,th:first-child{text-align:left}\
    figure{display:inline-block;margin:1rem 1rem 1rem 0;width:28rem;vertical-align:top}\
    figure svg{width:100%;height:auto}figcaption{font-size:.9rem}.no{color:#b00}.note{color:#444}";

/// What the report is made of.
pub struct Material<'a> {
    /// The counts.
    pub results: &'a Results,
    /// The reference's own, where they are at hand.
    pub recorded: Option<&'a Recorded>,
    /// Figures with their drawings as SVG.
    pub figures: &'a [(Figure, String)],
    /// The noise levels' drawing.
    pub noise_levels: &'a str,
    /// Where the sets come from, in words.
    pub source: &'a str,
}

/// The report.
#[must_use]
pub fn html(material: &Material<'_>) -> String {
    let mut out = String::new();
    let mut put = |text: &str| {
        out.push_str(text);
        out.push('\n');
    };
    put("<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\">");
    put("<title>Tell and show, reproduced</title>");
    put(&format!("<style>{STYLE}</style></head><body>"));
    put("<h1>Tell and show, reproduced</h1>");
    put(&format!(
        "<p>The experiments of Vanc, Skoviera and Stepanova (2024, arXiv 2404.01702) with \
         Deictic's core. {} Shares are in percent, intervals 95 % (Wilson). <em>Reference</em> is \
         the authors' public implementation; where its habits differ from the paper's text the \
         core follows either.</p>",
        material.source
    ));
    put(&stated::claims(material));
    put("<h2>Figures</h2>");
    put(&format!(
        "<figure>{}<figcaption>The noise levels; n1 peaks at 43.</figcaption></figure>",
        material.noise_levels
    ));
    for (figure, svg) in material.figures {
        put(&format!(
            "<figure>{svg}<figcaption><strong>{}.</strong> {}</figcaption></figure>",
            figure.title, figure.caption
        ));
    }
    put(&simulated::side_by_side(material));
    put(&simulated::differences(material));
    put(&apart::free(material));
    put(&apart::setups(material));
    put(
        "<p class=\"note\">All counts are in scores.csv and bounds.csv beside this file, those of \
         each figure in a file of its name.</p></body></html>",
    );
    out
}
