//! A picture as SVG.

use std::fmt::Write;

use super::{Drawn, HALF, Picture};

/// Pixels a metre.
const SCALE: f64 = 400.0;

/// How far the drawing reaches behind the robot and below the table, in metres.
const BEHIND: f64 = 0.15;
const BELOW: f64 = 0.05;

/// How wide and high each view is, in metres.
const SIZE: f64 = 1.1;

/// Where the robot stands in the view from above, in metres from its upper edge.
const MIDDLE: f64 = SIZE / 2.0;

/// Pixels above the views, for what is going on.
const HEAD: f64 = 30.0;

/// Where a place of the scene is in the picture.
type View = fn([f64; 3]) -> [f64; 2];

/// From the side: x to the right, z up.
fn side([x, _, z]: [f64; 3]) -> [f64; 2] {
    let up = HEAD + (SIZE - BELOW - z) * SCALE;
    [(x + BEHIND) * SCALE, up]
}

/// From above: x to the right, y up.
fn above([x, y, _]: [f64; 3]) -> [f64; 2] {
    [(x + BEHIND + SIZE) * SCALE, HEAD + (MIDDLE - y) * SCALE]
}

/// The picture, the view from the side beside the one from above.
#[must_use]
pub fn svg(picture: &Picture) -> String {
    let (width, height) = (2.0 * SIZE * SCALE, SIZE * SCALE + HEAD);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"white\"/>\n\
         <text x=\"10\" y=\"20\">{}</text>\n",
        escaped(&picture.caption)
    );
    let views: [(&str, View); 2] = [("side", side), ("above", above)];
    for (name, view) in views {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "<g id=\"{name}\">");
        if name == "side" {
            let [left, ground] = view([-BEHIND, 0.0, 0.0]);
            let right = left + SIZE * SCALE;
            let _ = writeln!(
                out,
                "<path d=\"M{left:.1} {ground:.1}H{right:.1}\" stroke=\"black\"/>"
            );
        }
        for thing in &picture.things {
            thing_into(&mut out, thing, name == "side", view);
        }
        arm_into(&mut out, picture, view);
        out.push_str("</g>\n");
    }
    out.push_str("</svg>\n");
    out
}

fn thing_into(out: &mut String, thing: &Drawn, side: bool, view: View) {
    let [x, y] = view(thing.at);
    // What stands on the table reaches down to it; what is held or stacked is as high as it is wide.
    let high = if thing.held {
        HALF
    } else {
        thing.at[2].clamp(0.01, HALF)
    };
    let (half, high) = (HALF * SCALE, if side { high * SCALE } else { HALF * SCALE });
    let fill = match (thing.storage, thing.held) {
        (true, _) => "#cfd8dc",
        (false, true) => "#ffcc80",
        (false, false) => "#90caf9",
    };
    let name = escaped(&thing.name);
    let (left, top) = (x - half, y - high);
    let (width, height) = (2.0 * half, 2.0 * high);
    let under = y + high + 13.0;
    let _ = writeln!(
        out,
        "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"3\" \
         fill=\"{fill}\" stroke=\"#546e7a\"/>\
         <text x=\"{x:.1}\" y=\"{under:.1}\" text-anchor=\"middle\">{name}</text>"
    );
}

fn arm_into(out: &mut String, picture: &Picture, view: View) {
    let points = |of: &[[f64; 3]]| {
        let points = of.iter().map(|p| view(*p));
        let written = points.map(|[x, y]| format!("{x:.1},{y:.1}"));
        written.collect::<Vec<_>>().join(" ")
    };
    let _ = writeln!(
        out,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#37474f\" stroke-width=\"8\" \
         stroke-linejoin=\"round\" stroke-opacity=\"0.7\"/>",
        points(&picture.arm)
    );
    for tip in &picture.tips {
        let [x, y] = view(*tip);
        let _ = writeln!(
            out,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"#d84315\"/>"
        );
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
