//! README and docs say what is so: their TOML is read, their commands and options are there, and their samples
//! print what they show.

use std::path::{Path, PathBuf};
use std::process::Command;

use deictic::scene::SceneLine;
use deictic::vocabulary::TABLETOP;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap()
        .to_owned()
}

/// README and every page of docs, with their names.
fn pages() -> Vec<(String, String)> {
    let docs = std::fs::read_dir(root().join("docs")).unwrap();
    let docs = docs.map(|entry| entry.unwrap().path());
    let pages = docs.filter(|path| path.extension().is_some_and(|e| e == "md"));
    let pages = pages.chain([root().join("README.md")]);
    pages
        .map(|path| {
            (
                path.display().to_string(),
                std::fs::read_to_string(path).unwrap(),
            )
        })
        .collect()
}

/// The blocks of code of a language.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("```{language}\n");
    let blocks = page.split(&fence).skip(1);
    blocks
        .map(|block| block.split("```").next().unwrap())
        .collect()
}

fn deictic(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_sample_of_toml_is_toml() {
    let mut seen = 0;
    for (name, page) in pages() {
        for block in blocks(&page, "toml") {
            let read = toml::from_str::<toml::Table>(block);
            assert!(read.is_ok(), "{name}: {read:?}\n{block}");
            seen += 1;
        }
    }
    assert!(seen >= 3, "{seen}");
}

#[test]
fn the_readmes_action_is_the_tabletops() {
    let (_, page) = pages().pop().unwrap();
    let sample: toml::Table = toml::from_str(blocks(&page, "toml")[0]).unwrap();
    let whole: toml::Table = toml::from_str(TABLETOP).unwrap();
    let actions = |table: &toml::Table| table["action"].as_array().unwrap().clone();
    for action in actions(&sample) {
        assert!(actions(&whole).contains(&action), "{action}");
    }
}

#[test]
fn the_readmes_lines_about_the_table_are_read() {
    let (_, page) = pages().pop().unwrap();
    let spans = page
        .split('`')
        .filter(|span| span.starts_with("{\"") && !span.contains("..."));
    let lines: Vec<_> = spans.collect();
    for line in &lines {
        assert!(SceneLine::parse(line.as_bytes()).is_ok(), "{line}");
    }
    assert!(lines.len() >= 2, "{lines:?}");
}

/// The commands that a page shows, in blocks and within the text, as their arguments.
fn commands(page: &str) -> Vec<Vec<&str>> {
    let code = page.lines().chain(page.split('`'));
    let told = code.filter_map(|code| {
        let code = code.trim_start_matches("$ ");
        let rest = code
            .strip_prefix("deictic ")
            .or_else(|| code.strip_prefix("cargo run -p deictic -- "))?;
        // What is told of it stands at a distance.
        rest.lines().next()?.split("  ").next()
    });
    told.map(|command| command.split_whitespace().collect())
        .collect()
}

#[test]
fn every_command_and_option_that_is_shown_is_there() {
    let mut seen = 0;
    for (name, page) in pages() {
        for command in commands(&page) {
            let two = matches!(command.first(), Some(&("gestures" | "scene")));
            let of = if two { 2 } else { 1 };
            let mut arguments: Vec<_> = command.iter().take(of).copied().collect();
            arguments.push("--help");
            let help = deictic(&arguments);
            assert!(help.contains("Usage: deictic"), "{name}: {command:?}");
            let options = command.iter().filter(|word| word.starts_with("--"));
            for option in options.map(|o| {
                o.split('=')
                    .next()
                    .unwrap()
                    .trim_end_matches(['.', ',', ')'])
            }) {
                let listed = help
                    .lines()
                    .any(|line| line.trim_start().split([' ', ',']).any(|w| w == option));
                assert!(listed, "{name}: {command:?} has no {option}");
            }
            seen += 1;
        }
    }
    assert!(seen >= 30, "{seen}");
}

/// The arguments of a command line, quotes taken off.
fn arguments(line: &str) -> Vec<String> {
    let parts = line.split('"').enumerate();
    let words = parts.flat_map(|(i, part)| match i % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// docs/language.md's vocabulary with one word more.
fn mine() -> String {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pages_mine.toml");
    let more = TABLETOP.replace("\"lift\"]", "\"lift\", \"fetch\"]");
    assert_ne!(more, TABLETOP);
    std::fs::write(&path, more).unwrap();
    path.display().to_string()
}

#[test]
fn what_samples_show_is_what_is_printed() {
    let mine = mine();
    let mut seen = 0;
    for (name, page) in pages() {
        for block in blocks(&page, "text") {
            for sample in block.split("$ deictic ").skip(1) {
                let (line, shown) = sample.split_once('\n').unwrap();
                if !["decide ", "understand "]
                    .iter()
                    .any(|command| line.starts_with(command))
                {
                    continue;
                }
                let arguments: Vec<_> = arguments(&line.replace("mine.toml", &mine));
                let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
                assert_eq!(deictic(&arguments).trim(), shown.trim(), "{name}: {line}");
                seen += 1;
            }
        }
    }
    assert!(seen >= 5, "{seen}");
}
