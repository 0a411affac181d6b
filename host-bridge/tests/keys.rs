//! With a key, the bridge and the unit believe nobody else, and each says what is wrong when the other has none or another.

use std::time::Duration;

use deictic::clock::Simulated;
use deictic::link::{Inside, Locked, Wire};
use deictic::scene::SceneFile;
use deictic::unit::{Event, GestureUnit, UnitError};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::protocol::message::Configuration;
use deictic_core::protocol::seal::{KEY, Key};

fn key(byte: u8) -> Key {
    Key::new(&[byte; KEY]).unwrap()
}

/// A bridge with one key before a unit with another, or without.
fn connect(bridge: Option<u8>, unit: Option<u8>) -> Result<(GestureUnit, Lexicon), UnitError> {
    let lexicon = Lexicon::tabletop().unwrap();
    let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
    let opener = Box::new(move || {
        let mut wire = Inside::start();
        if let Some(byte) = unit {
            wire.lock(key(byte));
        }
        let wire: Box<dyn Wire> = Box::new(wire);
        Ok(match bridge {
            None => wire,
            Some(byte) => Box::new(Locked {
                wire,
                key: key(byte),
            }),
        })
    });
    let configuration = Configuration::DEFAULT;
    let unit = GestureUnit::over(opener, lexicon.vocabulary(), table.scene(), configuration)?;
    Ok((unit, lexicon))
}

#[test]
fn the_same_key_at_both_ends_is_all_it_takes() {
    let _clock = Simulated::start();
    for keys in [None, Some(7)] {
        let (mut unit, lexicon) = connect(keys, keys).unwrap();
        let stop = lexicon.vocabulary().stop().unwrap();
        let sentence = deictic::answering::certainly(Category::ACTION, stop, &lexicon).unwrap();
        unit.observe(&[sentence]).unwrap();
        let decided = (0..200).any(|_| {
            let events = unit.poll(Duration::from_millis(10));
            events
                .iter()
                .any(|e| matches!(e, Event::Decision { trust: Ok(()), .. }))
        });
        assert!(decided);
    }
}

#[test]
fn whoever_lacks_the_key_is_told_so() {
    let _clock = Simulated::start();
    let error = |bridge, unit| connect(bridge, unit).map(|_| ()).unwrap_err();
    assert!(matches!(error(None, Some(7)), UnitError::WantsKey));
    assert!(matches!(error(Some(7), None), UnitError::NoKey));
    assert!(matches!(error(Some(7), Some(8)), UnitError::OtherKey));
}
