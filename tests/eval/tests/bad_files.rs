//! Data sets that are damaged or contradict their vocabulary are refused with file, line and reason.

use std::fs;
use std::io::Write;
use std::path::Path;

use deictic_eval::dataset::{self, DatasetError, Fault};

const VOCABULARY: &str = r#"{
  "actions": ["wave", "grasp"], "objects": ["cup", "pan"], "storages": ["shelf"],
  "features": ["clean"], "types": ["deep"],
  "action_requirements": {
    "wave": {"compulsory": ["action"], "object_positive": [], "object_negative": [],
             "storage_positive": [], "storage_negative": [], "storage_type": []},
    "grasp": {"compulsory": ["action", "object"], "object_positive": ["clean"],
              "object_negative": [], "storage_positive": [], "storage_negative": [],
              "storage_type": []}
  },
  "sim_action_gesture": [[1, 0.5], [0.5, 1]], "sim_action_language": [[1, 0.5], [0.5, 1]],
  "sim_object_gesture": [[1, 0.2], [0.2, 1]], "sim_object_language": [[1, 0.2], [0.2, 1]],
  "sim_storage_gesture": [[1]], "sim_storage_language": [[1]]
}"#;

const GOOD: &str = r#"{"i": 0, "objects": [["cup", ["deep"], [[0.9, 1]]], ["pan", [], [[0.1, 0]]]],
 "storages": [], "gesture": {"action": [0.2, 0.9], "object": [0.8, 0.1], "storage": []},
 "language": {"action": [0.1, 0.8], "object": [], "storage": []},
 "truth": {"action": "grasp", "object": "cup", "storage": null}, "feas": {}}"#;

fn folder(lines: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("vocab.json"), VOCABULARY).unwrap();
    fs::write(folder.path().join("set.jsonl"), lines).unwrap();
    folder
}

fn good() -> String {
    GOOD.replace('\n', "")
}

/// Reads a good line followed by a changed one, and gives the fault of the second.
fn fault(change: (&str, &str)) -> (Fault, String) {
    let bad = good().replacen(change.0, change.1, 1);
    assert_ne!(bad, good(), "the change changes nothing");
    let folder = folder(&format!("{}\n{bad}\n", good()));
    let error = dataset::read_folder(folder.path()).unwrap_err();
    let text = error.to_string();
    match error {
        DatasetError::Line { file, line, fault } => {
            assert_eq!(line, 2, "{text}");
            assert!(file.ends_with("set.jsonl"));
            assert!(text.contains("set.jsonl, line 2: "), "{text}");
            (fault, text)
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_good_line_is_read() {
    let folder = folder(&good());
    let (catalogue, sets) = dataset::read_folder(folder.path()).unwrap();
    let record = &sets[0].records[0];
    assert_eq!(sets[0].name, "set");
    assert_eq!(record.truth.options(), [Some(1), Some(0), None]);
    assert_eq!(record.words[0][1].as_deref(), Some(&[0.8, 0.1][..]));
    assert_eq!(record.words[1][1], None);
    assert!(catalogue.meets(1, 1, &record.objects[0]));
    assert!(!catalogue.meets(1, 1, &record.objects[1]));
    assert!(catalogue.possible(1, record));
}

#[test]
fn numbers_that_cannot_be_are_named() {
    assert!(matches!(fault(("0.8", "NaN")).0, Fault::NotANumber));
    assert!(matches!(fault(("0.8", "-Infinity")).0, Fault::NotANumber));
    let (f, text) = fault(("[0.8,", "[1.8,"));
    assert!(matches!(f, Fault::Range { .. }));
    assert!(text.contains("gesture's object word has 1.8"), "{text}");
    let (f, text) = fault(("[[0.9, 1]]", "[[-0.9, 1]]"));
    assert!(matches!(f, Fault::Range { .. }));
    assert!(text.contains("a feature of `cup`"), "{text}");
}

#[test]
fn wrong_lengths_are_named() {
    let (f, text) = fault(("[0.2, 0.9]", "[0.2]"));
    assert!(
        matches!(
            f,
            Fault::Length {
                found: 1,
                wanted: 2,
                ..
            }
        ),
        "{text}"
    );
    let (f, text) = fault(("[[0.9, 1]]", "[[0.9, 1], [0, 0]]"));
    assert!(
        matches!(
            f,
            Fault::Length {
                found: 2,
                wanted: 1,
                ..
            }
        ),
        "{text}"
    );
}

#[test]
fn unknown_names_and_contradictions_are_named() {
    let (f, text) = fault((r#"["pan""#, r#"["pot""#));
    assert!(
        matches!(
            f,
            Fault::Unknown {
                category: "object",
                ..
            }
        ),
        "{text}"
    );
    assert!(text.contains("`pot`"));
    let (f, _) = fault((r#""action": "grasp""#, r#""action": "grap""#));
    assert!(matches!(
        f,
        Fault::Unknown {
            category: "action",
            ..
        }
    ));
    let (f, _) = fault((r#"["deep"]"#, r#"["flat"]"#));
    assert!(matches!(
        f,
        Fault::Unknown {
            category: "type",
            ..
        }
    ));
    let (f, _) = fault((r#"["pan""#, r#"["cup""#));
    assert!(matches!(f, Fault::Twice { .. }));
    let (f, _) = fault((r#""object": "cup""#, r#""object": null"#));
    assert!(matches!(
        f,
        Fault::Signature {
            category: "object",
            ..
        }
    ));
}

#[test]
fn lines_and_streams_cut_short_are_named() {
    let (f, _) = fault((r#", "feas": {}}"#, ""));
    assert!(matches!(f, Fault::Json(_)));

    let folder = folder("");
    fs::remove_file(folder.path().join("set.jsonl")).unwrap();
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    for _ in 0..3 {
        writeln!(packer, "{}", good()).unwrap();
    }
    let packed = packer.finish().unwrap();
    fs::write(
        folder.path().join("set.jsonl.gz"),
        &packed[..packed.len() - 20],
    )
    .unwrap();
    let error = dataset::read_folder(folder.path()).unwrap_err();
    assert!(
        matches!(
            error,
            DatasetError::Truncated { .. } | DatasetError::Line { .. }
        ),
        "{error}"
    );
    assert!(error.to_string().contains("set.jsonl.gz, line "), "{error}");
}

#[test]
fn a_folder_without_sets_or_vocabulary_is_refused() {
    assert!(matches!(
        dataset::read_folder(Path::new("no/such/folder")),
        Err(DatasetError::Catalogue(_))
    ));
    let folder = folder("");
    fs::remove_file(folder.path().join("set.jsonl")).unwrap();
    assert!(matches!(
        dataset::read_folder(folder.path()),
        Err(DatasetError::NoSets { .. })
    ));
}

#[test]
fn a_vocabulary_with_an_unknown_feature_is_refused() {
    let folder = folder("");
    let wrong = VOCABULARY.replace(r#"["clean"], "#, r#"["tidy"], "#);
    fs::write(folder.path().join("vocab.json"), wrong).unwrap();
    let error = dataset::read_folder(folder.path()).unwrap_err().to_string();
    assert!(
        error.contains("vocab.json") && error.contains("clean"),
        "{error}"
    );
}

#[test]
fn a_set_without_samples_is_refused() {
    let error = dataset::read_folder(folder("").path()).unwrap_err();
    assert!(matches!(error, DatasetError::Empty { .. }), "{error}");
}
