//! The committed DBC file says of every frame what the code does. `BLESS=1 cargo test -p deictic-core
//! --test dbc` writes it anew.

use std::fmt::Write as _;

use deictic_core::can::{FROM_UNIT, TO_UNIT};
use deictic_core::command::SHORT;
use deictic_core::command::field::Part;
use deictic_core::command::message::{FromRobot, Layout, ToRobot};
use deictic_core::command::parcel::Sender;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/deictic.dbc");

/// `host_lost` as `HostLost`.
fn name(words: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    words.split('_').map(capital).collect()
}

/// A signal of whole bytes, little end first.
fn signal(name: &str, first_byte: usize, part: &Part, to: &str) -> String {
    let (start, bits) = (first_byte * 8, usize::from(part.bytes) * 8);
    let sign = if part.signed { '-' } else { '+' };
    let unit = part.unit;
    format!(" SG_ {name} : {start}|{bits}@1{sign} (1,0) [0|0] \"{unit}\" {to}\n")
}

struct Texts {
    messages: String,
    comments: String,
    values: String,
}

fn describe(layout: &Layout, sender: Sender, texts: &mut Texts) {
    let (from, to) = match sender {
        Sender::Host => ("Host", "Robot"),
        Sender::Robot => ("Robot", "Host"),
    };
    let short = layout.bytes() <= SHORT;
    let length = if short { SHORT + 1 } else { layout.bytes() };
    let id = layout.id;
    let _ = writeln!(texts.messages, "BO_ {id} {}: {length} {from}", layout.name);
    let carried = if short {
        ""
    } else {
        " Carried in frames of the sender's Long."
    };
    let meaning = layout.meaning.trim();
    let _ = writeln!(texts.comments, "CM_ BO_ {id} \"{meaning}{carried}\";");
    let mut at = 0;
    for field in layout.fields {
        for part in field.parts {
            let name = name(field.name) + part.suffix;
            texts.messages += &signal(&name, at, part, to);
            let _ = writeln!(
                texts.comments,
                "CM_ SG_ {id} {name} \"{}\";",
                field.meaning.trim()
            );
            if !part.codes.is_empty() {
                let _ = write!(texts.values, "VAL_ {id} {name}");
                for (code, number) in part.codes {
                    let _ = write!(texts.values, " {number} \"{code}\"");
                }
                texts.values += " ;\n";
            }
            at += usize::from(part.bytes);
        }
    }
    if short {
        let check = Part {
            suffix: "",
            bytes: 1,
            signed: false,
            unit: "",
            codes: &[],
        };
        texts.messages += &signal("Check", SHORT, &check, to);
        let over =
            "CRC-8 (SAE J1850) over identifier, little end first, and the seven bytes before.";
        let _ = writeln!(texts.comments, "CM_ SG_ {id} Check \"{over}\";");
    }
    texts.messages.push('\n');
}

fn file() -> String {
    let mut texts = Texts {
        messages: String::new(),
        comments: String::new(),
        values: String::new(),
    };
    for sender in [Sender::Host, Sender::Robot] {
        let (from, to) = match sender {
            Sender::Host => ("Host", "Robot"),
            Sender::Robot => ("Robot", "Host"),
        };
        for layout in sender.layouts() {
            describe(layout, sender, &mut texts);
        }
        let id = sender.long_id();
        let _ = writeln!(
            texts.messages,
            "BO_ {id} {from}Long: 8 {from}\n \
             SG_ Kind M : 4|4@1+ (1,0) [0|0] \"\" {to}\n \
             SG_ LengthHigh m1 : 0|4@1+ (1,0) [0|0] \"256 bytes\" {to}\n \
             SG_ LengthLow m1 : 8|8@1+ (1,0) [0|0] \"bytes\" {to}\n \
             SG_ FirstData m1 : 16|48@1+ (1,0) [0|0] \"\" {to}\n \
             SG_ Sequence m2 : 0|4@1+ (1,0) [0|0] \"\" {to}\n \
             SG_ NextData m2 : 8|56@1+ (1,0) [0|0] \"\" {to}\n"
        );
        let _ = writeln!(
            texts.comments,
            "CM_ BO_ {id} \"A message of more than seven bytes, as in ISO 15765-2 without flow control: its \
             identifier in two bytes, its bytes, CRC-16 (IBM-3740) over both; all little end first. Sealed, whatever \
             its length: 32768 is added to the identifier, and a counter of two bytes and a tag of four stand behind \
             the bytes (docs/robot.md).\";"
        );
        let _ = writeln!(texts.values, "VAL_ {id} Kind 1 \"First\" 2 \"Next\" ;");
    }
    for (id, name, from, to) in [
        (TO_UNIT, "ToUnit", "Host", "Unit"),
        (FROM_UNIT, "FromUnit", "Unit", "Host"),
    ] {
        let _ = writeln!(
            texts.messages,
            "BO_ {id} {name}: 8 {from}\n \
             SG_ Count : 0|8@1+ (1,0) [0|7] \"bytes\" {to}\n \
             SG_ Bytes : 8|56@1+ (1,0) [0|0] \"\" {to}\n"
        );
        let _ = writeln!(
            texts.comments,
            "CM_ BO_ {id} \"Bytes of the stream that docs/protocol.md describes.\";"
        );
    }
    let Texts {
        messages,
        comments,
        values,
    } = texts;
    format!(
        "VERSION \"1\"\n\nNS_ :\n\nBS_:\n\nBU_: Host Robot Unit\n\n{messages}{comments}\n{values}"
    )
}

#[test]
fn the_committed_file_describes_what_the_code_does() {
    let file = file();
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(FILE, &file).unwrap();
    }
    let committed = std::fs::read_to_string(FILE).unwrap();
    assert!(
        committed == file,
        "docs/deictic.dbc is another one; BLESS=1 writes it anew"
    );
}

#[test]
fn every_signal_of_a_message_has_a_name_of_its_own() {
    for layout in [ToRobot::LAYOUTS, FromRobot::LAYOUTS].concat() {
        let parts = layout
            .fields
            .iter()
            .flat_map(|f| f.parts.iter().map(|p| name(f.name) + p.suffix));
        let mut names: Vec<_> = parts.collect();
        let all = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all, "{}", layout.name);
    }
}
