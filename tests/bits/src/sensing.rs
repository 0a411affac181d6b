//! Sensors made from a number.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::joint::Sensors;
use deictic_core::sentence::{GESTURE, LANGUAGE};

use crate::random::Random;

/// Tables as the paper's are, for the first three categories: 1 for what is meant, a flat fifth to a
/// half for all else of a hand, anything up to three quarters of a voice.
pub fn learn<const B: usize>(
    sensors: &mut Sensors<B>,
    random: &mut Random,
    vocabulary: &board::Vocabulary,
) {
    sensors.clear();
    for modality in [GESTURE, LANGUAGE] {
        for category in [Category::ACTION, Category::OBJECT, Category::STORAGE] {
            let options = vocabulary.options_of(category).min(board::OPTIONS);
            let flat = (51 + random.below(77)) as u8;
            for meant in 0..options {
                let mut row = [flat; board::OPTIONS];
                for (k, value) in row.iter_mut().enumerate() {
                    if k == meant {
                        *value = u8::MAX;
                    } else if modality == LANGUAGE {
                        *value = random.below(192) as u8;
                    }
                }
                let row = row.get(..options).unwrap_or_default();
                // Three tables of two modalities fit, as the vocabulary's counts are fixed.
                let _ = sensors.set_row(modality, category, meant as u8, row);
            }
        }
    }
}
