//! The curves as a picture: one panel per direction, one line per model.

use std::fmt::Write;

use super::{Curves, Fit};

const PANEL: (f64, f64) = (210.0, 190.0);
const MARGIN: (f64, f64) = (52.0, 34.0);
const COLOURS: [&str; 4] = ["#0b6e4f", "#c1440e", "#2b4c9b", "#7a7a7a"];

/// An SVG of the curves, points as measured and the straight lines that fit them.
#[must_use]
pub fn draw(curves: &Curves, directions: &[&str]) -> String {
    let step = (PANEL.0 + MARGIN.0 + 14.0, PANEL.1 + 2.0 * MARGIN.1);
    let (width, height) = (step.0 * directions.len() as f64, step.1 + 22.0);
    let top = curves
        .values()
        .flat_map(|model| model.values())
        .flat_map(|curve| curve.values())
        .copied()
        .max()
        .unwrap_or(1);
    let top = (top as f64 / 5_000.0).ceil() * 5_000.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let mut put = |line: String| {
        svg.push_str(&line);
        svg.push('\n');
    };
    for (i, direction) in directions.iter().enumerate() {
        let left = MARGIN.0 + step.0 * i as f64;
        let bottom = MARGIN.1 + PANEL.1;
        let most = curves
            .values()
            .filter_map(|model| model.get(*direction)?.keys().max())
            .max()
            .map_or(1.0, |most| f64::from(*most));
        let place = |x: f64, y: f64| (left + x / most * PANEL.0, bottom - y / top * PANEL.1);
        put(format!(
            "<path d=\"M{left} {} V{bottom} H{}\" fill=\"none\" stroke=\"black\"/>",
            MARGIN.1,
            left + PANEL.0
        ));
        for part in 0..=4 {
            let y = top * f64::from(part) / 4.0;
            let (_, at) = place(0.0, y);
            put(format!(
                "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{y:.0}</text>",
                left - 5.0,
                at + 4.0
            ));
        }
        put(format!(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{direction}</text>",
            left + PANEL.0 / 2.0,
            bottom + 28.0
        ));
        for ((model, by_direction), colour) in curves.iter().zip(COLOURS) {
            let Some(curve) = by_direction.get(*direction) else {
                continue;
            };
            let fit = Fit::of(curve);
            let (from, to) = (
                place(0.0, fit.start),
                place(most, fit.start + fit.slope * most),
            );
            put(format!(
                "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>",
                from.0, from.1, to.0, to.1
            ));
            put(format!(
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"{colour}\">{model}: +{:.0} each</text>",
                to.0,
                to.1 - 8.0,
                fit.slope
            ));
            for (size, count) in curve {
                let (x, y) = place(f64::from(*size), *count as f64);
                put(format!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\" fill=\"{colour}\"/>"
                ));
                if *model == *curves.keys().next().unwrap_or(model) {
                    put(format!(
                        "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{size}</text>",
                        bottom + 14.0
                    ));
                }
            }
        }
    }
    let _ = write!(
        svg,
        "<text x=\"{}\" y=\"{}\">instructions of one decision on a Cortex-M4F; a table of 8 actions, 6 objects and 4 \
         storages, two modalities with three words each, one of these varied</text>\n</svg>\n",
        MARGIN.0,
        height - 8.0
    );
    svg
}
