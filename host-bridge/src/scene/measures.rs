//! What things weigh and hold. The core decides without it; an arm that lifts and pours them does not.

use serde::Deserialize;

/// What is known of a thing's measures; what is not written is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
pub struct Measures {
    /// What it weighs, in kilograms.
    pub mass: Option<f32>,
    /// How much liquid it takes, in litres.
    pub holds: Option<f32>,
    /// How much liquid is in it, in litres.
    pub liquid: Option<f32>,
}

/// A measure that cannot be: its name and what was written.
pub type BadMeasure = (&'static str, f32);

impl Measures {
    /// The most that anything on a table may weigh or hold, in kilograms and litres.
    pub const MOST: f32 = 100.0;

    /// Whether they can be.
    ///
    /// # Errors
    /// `BadMeasure`: every one is above 0 and at most [`Measures::MOST`], but `liquid`, which is in 0 to `holds`.
    pub fn check(&self) -> Result<(), BadMeasure> {
        let sound = |x: f32| x > 0.0 && x <= Self::MOST;
        for (name, measure) in [("mass", self.mass), ("holds", self.holds)] {
            if let Some(bad) = measure.filter(|x| !sound(*x)) {
                return Err((name, bad));
            }
        }
        let most = self.holds.unwrap_or(Self::MOST);
        let bad = self.liquid.filter(|x| !(0.0..=most).contains(x));
        bad.map_or(Ok(()), |bad| Err(("liquid", bad)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_is_named() {
        let measures = |mass, holds, liquid| Measures {
            mass,
            holds,
            liquid,
        };
        assert_eq!(Measures::default().check(), Ok(()));
        assert_eq!(measures(Some(0.3), Some(0.5), Some(0.0)).check(), Ok(()));
        assert_eq!(measures(Some(0.0), None, None).check(), Err(("mass", 0.0)));
        assert_eq!(
            measures(None, Some(-1.0), None).check(),
            Err(("holds", -1.0))
        );
        let over = measures(None, Some(0.5), Some(0.6)).check();
        assert_eq!(over, Err(("liquid", 0.6)));
        assert!(measures(Some(f32::NAN), None, None).check().is_err());
    }
}
