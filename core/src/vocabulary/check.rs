//! Whether a vocabulary's actions can be what they say.

use super::action::{Action, Signature};
use super::error::VocabularyError;
use crate::category::CategorySet;

/// Checks what actions take and need against what there is.
pub(super) fn actions(
    actions: &[Action],
    parameters: &[u8],
    features: u8,
    stop: Option<u8>,
) -> Result<(), VocabularyError> {
    let mut known = CategorySet::EMPTY;
    for (&count, q) in parameters.iter().zip(1..) {
        if count > 0 {
            known = known.with(q);
        }
    }
    for (i, action) in actions.iter().enumerate() {
        let at = saturate(i);
        let Signature {
            compulsory,
            voluntary,
        } = action.signature;
        if compulsory.union(voluntary).0 & !known.0 != 0 {
            return Err(VocabularyError::UnknownCategory { action: at });
        }
        if !compulsory.intersection(voluntary).is_empty() {
            return Err(VocabularyError::Contradiction { action: at });
        }
        for need in [action.object, action.storage] {
            if !need.wanted.union(need.unwanted).fits(usize::from(features)) {
                return Err(VocabularyError::UnknownFeature { action: at });
            }
            if !need.wanted.intersection(need.unwanted).is_empty() {
                return Err(VocabularyError::Contradiction { action: at });
            }
        }
    }
    match stop.map(|stop| actions.get(usize::from(stop))) {
        None => Ok(()),
        Some(Some(action)) if action.signature.compulsory.is_empty() => Ok(()),
        Some(_) => Err(VocabularyError::BadStop),
    }
}

/// A count as a byte, 255 when it is larger.
pub(super) fn saturate(count: usize) -> u8 {
    u8::try_from(count).unwrap_or(u8::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vocabulary::tests::pick;

    #[test]
    fn what_contradicts_itself_is_refused_with_its_place() {
        assert_eq!(
            actions(&[Action::default(), pick()], &[], 2, None),
            Err(VocabularyError::UnknownCategory { action: 1 })
        );
        assert_eq!(
            actions(&[pick()], &[2], 1, None),
            Err(VocabularyError::UnknownFeature { action: 0 })
        );
        let mut torn = pick();
        torn.signature.voluntary = torn.signature.compulsory;
        assert_eq!(
            actions(&[torn], &[2], 2, None),
            Err(VocabularyError::Contradiction { action: 0 })
        );
        assert_eq!(
            actions(&[pick()], &[2], 2, Some(0)),
            Err(VocabularyError::BadStop)
        );
        assert_eq!(
            actions(&[pick()], &[2], 2, Some(9)),
            Err(VocabularyError::BadStop)
        );
    }
}
