//! Reading recordings of hands: labelled shapes, and frames of a sensor.

use std::collections::BTreeMap;
use std::io::{BufReader, Read};
use std::path::Path;

use anyhow::{Context, bail};
use deictic_core::gesture::curl;
use deictic_core::gesture::frame::{FINGERS, Finger, HandFrame, Side};
use deictic_core::gesture::shape::{self, FEATURES, Shape};

/// The last bone's length over that of the one before it; 0.7 to 0.75 in people's four fingers.
const DISTAL: f64 = 0.72;

/// An outer joint bends no further than this, rad, whatever angles that jump say.
const OUTER: f64 = 1.2;

/// A labelled hand.
#[derive(Clone, Debug)]
pub struct Labelled {
    /// What it shows.
    pub shape: Shape,
    /// The recording that it is from; frames of one recording are alike.
    pub recording: u32,
    /// Its features.
    pub features: [f32; FEATURES],
    /// How far its fingers are folded, as far as the file tells.
    pub folds: [Option<f32>; FINGERS],
}

/// What a file of hands holds.
#[derive(Debug)]
pub enum Hands {
    /// Shapes with labels: columns `label`, `recording` and the 15 distances `d_T-I_mm`, ...; and, where
    /// they are, the angles of the joints, `index_b2_pitch`, ... in rad. Labels that the unit has no shape
    /// for are *none of these*.
    Labelled(Vec<Labelled>),
    /// Frames by recording and hand, in the order of time: columns as in `leapjs_frames.csv.xz`.
    Frames(BTreeMap<String, Vec<HandFrame>>),
}

/// Opens a CSV file, packed with xz when its name ends so.
///
/// # Errors
/// When it cannot be opened or unpacked.
pub fn open(path: &Path) -> anyhow::Result<csv::Reader<Box<dyn Read>>> {
    let file = std::fs::File::open(path).with_context(|| format!("opening {}", path.display()))?;
    let mut input: Box<dyn Read> = Box::new(file);
    if path.extension().is_some_and(|e| e == "xz") {
        let mut bytes = Vec::new();
        lzma_rs::xz_decompress(&mut BufReader::new(input), &mut bytes)
            .with_context(|| format!("unpacking {}", path.display()))?;
        input = Box::new(std::io::Cursor::new(bytes));
    }
    Ok(csv::Reader::from_reader(input))
}

/// Reads a file of either kind, told apart by its columns.
///
/// # Errors
/// Names the line and column of what cannot be read.
pub fn read(path: &Path) -> anyhow::Result<Hands> {
    let mut reader = open(path)?;
    let header = reader.headers()?.clone();
    if header.iter().any(|name| name == "label") {
        labelled(&mut reader, &header)
            .map(Hands::Labelled)
            .with_context(|| path.display().to_string())
    } else if header.iter().any(|name| name == "t_us") {
        frames(&mut reader, &header)
            .map(Hands::Frames)
            .with_context(|| path.display().to_string())
    } else {
        bail!(
            "{}: neither shapes (a column `label`) nor frames (a column `t_us`)",
            path.display()
        )
    }
}

/// A row of a CSV file whose columns are found by name.
struct Row<'a> {
    header: &'a csv::StringRecord,
    fields: csv::StringRecord,
    line: u64,
}

impl Row<'_> {
    fn text(&self, name: &str) -> anyhow::Result<&str> {
        let at = self.header.iter().position(|column| column == name);
        at.and_then(|at| self.fields.get(at))
            .with_context(|| format!("line {}: no column `{name}`", self.line))
    }

    fn number<T: std::str::FromStr>(&self, name: &str) -> anyhow::Result<T> {
        let text = self.text(name)?;
        match text.parse() {
            Ok(number) => Ok(number),
            Err(_) => bail!("line {}, column `{name}`: {text:?} is no number", self.line),
        }
    }

    fn point(&self, name: &str) -> anyhow::Result<[f32; 3]> {
        Ok([
            self.number(&format!("{name}x"))?,
            self.number(&format!("{name}y"))?,
            self.number(&format!("{name}z"))?,
        ])
    }
}

fn rows<'a>(
    reader: &'a mut csv::Reader<Box<dyn Read>>,
    header: &'a csv::StringRecord,
) -> impl Iterator<Item = anyhow::Result<Row<'a>>> {
    reader.records().map(move |fields| {
        let fields = fields?;
        let line = fields.position().map_or(0, csv::Position::line);
        Ok(Row {
            header,
            fields,
            line,
        })
    })
}

fn labelled(
    reader: &mut csv::Reader<Box<dyn Read>>,
    header: &csv::StringRecord,
) -> anyhow::Result<Vec<Labelled>> {
    const POINTS: [&str; 6] = ["T", "I", "M", "R", "P", "palm"];
    let mut names = Vec::new();
    for (i, a) in POINTS.iter().enumerate() {
        names.extend(POINTS[i + 1..].iter().map(|b| format!("d_{a}-{b}_mm")));
    }
    let mut hands = Vec::new();
    for row in rows(reader, header) {
        let row = row?;
        let label = row.text("label")?;
        let shape = Shape::ALL.into_iter().find(|s| s.name() == label);
        let mut distances = [0.0; FEATURES];
        for (distance, name) in distances.iter_mut().zip(&names) {
            *distance = row.number(name)?;
        }
        let Ok(features) = shape::of_distances(&distances) else {
            bail!("line {}: distances that no hand has", row.line);
        };
        hands.push(Labelled {
            shape: shape.unwrap_or(Shape::None),
            recording: row.number("recording")?,
            features,
            folds: folds(&row),
        });
    }
    Ok(hands)
}

/// How far the fingers are folded by the angles between their bones, pitch and yaw, whose cosines' product
/// is the bend's cosine: the second bone's at the middle joint, the third's at the outer one. The thumb's
/// bones do not tell. Nothing without these columns.
fn folds(row: &Row<'_>) -> [Option<f32>; FINGERS] {
    let bend = |finger: &str, bone: usize| -> Option<f64> {
        let angle = |axis: &str| row.number::<f64>(&format!("{finger}_b{bone}_{axis}")).ok();
        Some((angle("pitch")?.cos() * angle("yaw")?.cos()).acos())
    };
    ["thumb", "index", "middle", "ring", "pinky"].map(|finger| {
        if finger == "thumb" {
            return None;
        }
        let (middle, outer) = (bend(finger, 2)?, bend(finger, 3)?.min(OUTER));
        // From the second bone to the line from its begin to the tip.
        let aside = f64::atan2(DISTAL * outer.sin(), 1.0 + DISTAL * outer.cos());
        Some(curl::folded_by((middle + aside).cos() as f32))
    })
}

fn frames(
    reader: &mut csv::Reader<Box<dyn Read>>,
    header: &csv::StringRecord,
) -> anyhow::Result<BTreeMap<String, Vec<HandFrame>>> {
    let mut recordings: BTreeMap<String, Vec<HandFrame>> = BTreeMap::new();
    for row in rows(reader, header) {
        let row = row?;
        let side = row.text("hand")?;
        let mut fingers = [None; 5];
        for (finger, name) in fingers.iter_mut().zip(["T", "I", "M", "R", "P"]) {
            *finger = Some(Finger {
                knuckle: row.point(&format!("{name}1"))?,
                middle: row.point(&format!("{name}2"))?,
                tip: row.point(&format!("{name}4"))?,
            });
        }
        let frame = HandFrame {
            // The wire's clock wraps as well.
            time: row.number::<u64>("t_us")? as u32,
            side: if side == "left" {
                Side::Left
            } else {
                Side::Right
            },
            confidence: row.number("conf")?,
            grab: row.number("grab")?,
            pinch: row.number("pinch")?,
            palm: row.point("palm_")?,
            velocity: row.point("v")?,
            normal: row.point("n")?,
            direction: row.point("d")?,
            fingers,
        };
        if let Err(error) = frame.check() {
            bail!("line {}: {error:?}", row.line);
        }
        let key = format!("{} {side}", row.text("recording")?);
        recordings.entry(key).or_default().push(frame);
    }
    Ok(recordings)
}
