//! How one person aims, found on things whose places are known.
//!
//! People who point along the line from eye to fingertip, and sensors that stand a little askew, miss by the same
//! angles every time. What is found is how the sensor would have to stand for the least misses, turned about the places
//! where the finger was, and how far the person still misses then.

use std::path::Path;

use deictic_core::gesture::calibration::Calibration;
use deictic_core::gesture::context::Context;
use deictic_core::gesture::mapping::Mapping;
use deictic_core::gesture::pointing::{Aim, Mount, Ray, miss, ray};
use deictic_core::gesture::reader::HandReader;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::wire::Sample;
use deictic_core::large;
use deictic_core::protocol::hand::HandSettings;
use deictic_core::time::Micros;
use nalgebra::{Matrix3, Rotation3, Vector3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

/// As many targets as tell an aim.
pub const ENOUGH: usize = 3;

/// By how much, rad, people and sensors may be askew before anything is known of them: six degrees.
const ASKEW: f64 = 0.1;

/// The beginning and the end of pointing, in which the finger is on its way.
const ON_ITS_WAY: Micros = Micros::from_millis(200);

/// Why an aim cannot be told.
#[derive(Debug, Error)]
pub enum AimError {
    /// Fewer targets were pointed at than tell an aim.
    #[error("{0} targets were pointed at; an aim needs {ENOUGH}")]
    TooFew(usize),
    /// The finger missed all by more than a hand can.
    #[error("the hand points {0:.0} degrees away from where the targets are")]
    Away(f64),
    /// The file cannot be read.
    #[error("cannot read the aim in {path}: {cause}")]
    Unreadable {
        /// The file.
        path: String,
        /// What the system said.
        #[source]
        cause: std::io::Error,
    },
    /// The file is none that holds an aim.
    #[error("{path} holds no aim: {cause}")]
    Syntax {
        /// The file.
        path: String,
        /// What is wrong.
        #[source]
        cause: toml::de::Error,
    },
    /// The sensor cannot stand so, or nobody aims so.
    #[error("{0} holds an aim that cannot be")]
    Unsound(String),
}

impl AimError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::TooFew(_) => "point at each thing for a second, and close the hand in between",
            Self::Away(_) => {
                "see that `[sensor]` of the scene file says where the sensor stands, and point at the things in the order that was asked"
            }
            Self::Unreadable { .. } | Self::Syntax { .. } | Self::Unsound(_) => {
                "give a file that `deictic gestures aim --out` has written"
            }
        }
    }
}

/// Where a hand pointed, time after time. A closed hand, or none, ends each.
pub struct Pointings<'a> {
    reader: HandReader<{ large::OPTIONS }, { large::CATEGORIES }, { large::WORDS }>,
    table: &'a Tabletop,
    lexicon: &'a Lexicon,
    mapping: Mapping,
    mount: Mount,
    clock: Micros,
    last: Option<u32>,
    rays: Vec<(Micros, Ray)>,
}

impl<'a> Pointings<'a> {
    /// Before a table, with the sensor where its file says.
    #[must_use]
    pub fn new(table: &'a Tabletop, lexicon: &'a Lexicon) -> Self {
        Self {
            reader: HandReader::new(),
            table,
            lexicon,
            mapping: Mapping::new(),
            mount: table.hand().mount,
            clock: Micros(0),
            last: None,
            rays: Vec::new(),
        }
    }

    /// Takes a sample, and gives the mean ray of a pointing that it ends.
    pub fn push(&mut self, sample: &Sample) -> Option<Ray> {
        let time = match sample {
            Sample::Hand(frame) => frame.time,
            Sample::Nothing(time) => *time,
        };
        let ahead = time.wrapping_sub(self.last.replace(time).unwrap_or(time));
        self.clock = self.clock.after(Micros(u64::from(ahead)));
        let context = Context {
            vocabulary: self.lexicon.vocabulary(),
            scene: self.table.scene(),
            mapping: &self.mapping,
            templates: Templates::KNOWN,
            mount: &self.mount,
            aim: &self.table.hand().aim,
        };
        self.reader.take(self.clock, sample, &context);
        let shown = self.reader.shown();
        if let (Sample::Hand(frame), true) = (sample, shown == Some(Shape::Point as u8)) {
            self.rays
                .extend(ray(frame, &self.mount).map(|ray| (self.clock, ray)));
        }
        let over = shown == Some(Shape::Grab as u8) || self.reader.hand().is_none();
        if over { self.end() } else { None }
    }

    fn end(&mut self) -> Option<Ray> {
        let rays = std::mem::take(&mut self.rays);
        let (first, last) = (rays.first()?.0, rays.last()?.0);
        let steady = rays
            .iter()
            .filter(|(at, _)| at.since(first) >= ON_ITS_WAY && last.since(*at) >= ON_ITS_WAY);
        let (mut origin, mut direction) = (Vector3::zeros(), Vector3::zeros());
        let mut count = 0.0;
        for (_, ray) in steady {
            origin += Vector3::from(ray.origin);
            direction += Vector3::from(ray.direction);
            count += 1.0;
        }
        (count > 0.0).then(|| Ray {
            origin: (origin / count).into(),
            direction: direction.normalize().into(),
        })
    }
}

/// How a person aims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aimed {
    /// What a unit is told of it.
    pub settings: HandSettings,
    /// By how far the sensor was turned, rad.
    pub turned: f64,
}

/// The aim that rays at known targets tell; with few of them it stays near to what is assumed of everybody.
///
/// # Errors
/// [`AimError::TooFew`], [`AimError::Away`].
pub fn aim(settings: HandSettings, pointed: &[(Ray, [f32; 3])]) -> Result<Aimed, AimError> {
    if pointed.len() < ENOUGH {
        return Err(AimError::TooFew(pointed.len()));
    }
    let all: Vec<[Vector3<f64>; 3]> = pointed
        .iter()
        .map(|(ray, target)| {
            let double = |v: [f32; 3]| Vector3::from(v.map(f64::from));
            let origin = double(ray.origin);
            [
                origin,
                double(ray.direction),
                (double(*target) - origin).normalize(),
            ]
        })
        .collect();
    // A ridge that weighs what is assumed of the turn against what is assumed of a miss.
    let ridge = (f64::from(Aim::DEFAULT.sigma) / ASKEW).powi(2);
    let mut turn = Vector3::zeros();
    for _ in 0..8 {
        let rotation = Rotation3::new(turn);
        let (mut normal, mut off) = (Matrix3::identity() * ridge, -turn * ridge);
        for [_, direction, wanted] in &all {
            let direction = rotation * direction;
            normal += Matrix3::identity() - direction * direction.transpose();
            off += direction.cross(wanted);
        }
        turn += normal.try_inverse().unwrap_or_default() * off;
    }
    let degrees = turn.norm().to_degrees();
    // NaN is in no range.
    if !(0.0..30.0).contains(&degrees) {
        return Err(AimError::Away(degrees));
    }
    let rotation = Rotation3::new(turn).cast::<f32>();
    let sum: Vector3<f64> = all.iter().map(|a| a[0]).sum();
    let about = (sum / all.len() as f64).cast::<f32>();
    let mut calibration = Calibration::new();
    for (ray, target) in pointed {
        let direction = (rotation * Vector3::from(ray.direction)).into();
        calibration.missed_by(miss(&Ray { direction, ..*ray }, *target));
    }
    let Mount { axes, origin } = settings.mount;
    let mount = Mount {
        axes: axes.map(|axis| (rotation * Vector3::from(axis)).into()),
        origin: (about + rotation * (Vector3::from(origin) - about)).into(),
    };
    Ok(Aimed {
        settings: HandSettings {
            mount,
            aim: Aim {
                nothing: settings.aim.nothing,
                ..calibration.aim()
            },
        },
        turned: turn.norm(),
    })
}

/// `[sensor]` as scene files have it.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sensor {
    origin: [f32; 3],
    x: [f32; 3],
    y: [f32; 3],
    z: [f32; 3],
    sigma: f32,
    nothing: f32,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    sensor: Sensor,
}

/// The aim as the `[sensor]` of a scene file.
///
/// # Errors
/// Those of TOML; numbers have none.
pub fn write(settings: &HandSettings) -> Result<String, toml::ser::Error> {
    let [x, y, z] = settings.mount.axes;
    toml::to_string(&Written {
        sensor: Sensor {
            origin: settings.mount.origin,
            x,
            y,
            z,
            sigma: settings.aim.sigma,
            nothing: settings.aim.nothing,
        },
    })
}

/// Reads a file with an aim.
///
/// # Errors
/// [`AimError`]
pub fn read(path: &Path) -> Result<HandSettings, AimError> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|cause| AimError::Unreadable {
        path: name.clone(),
        cause,
    })?;
    let Written { sensor } = toml::from_str(&text).map_err(|cause| AimError::Syntax {
        path: name.clone(),
        cause,
    })?;
    let settings = HandSettings {
        mount: Mount {
            axes: [sensor.x, sensor.y, sensor.z],
            origin: sensor.origin,
        },
        aim: Aim {
            sigma: sensor.sigma,
            nothing: sensor.nothing,
        },
    };
    if settings.mount.check().is_err() || !settings.aim.is_sound() {
        return Err(AimError::Unsound(name));
    }
    Ok(settings)
}
