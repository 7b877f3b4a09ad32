//! The documents against the program: every key, every link, every command, every case.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(ROOT).join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Keys and words of the table that error messages are made from: rows `("key", "words"),` behind `head`.
fn keys(file: &str, head: &str) -> BTreeSet<(String, String)> {
    let source = read(file);
    let table = source.split_once(head).and_then(|(_, rest)| rest.split_once("];"));
    let (table, _) = table.expect("the table of keys");
    let rows = table.lines().filter_map(|line| line.trim().strip_prefix("(\"")?.strip_suffix("),"));
    rows.map(|row| {
        let (key, words) = row.split_once("\", ").expect("a key and its words");
        let words = words.strip_prefix("r#").map_or(words, |raw| raw.trim_matches('#'));
        (key.to_owned(), words[1..words.len() - 1].to_owned())
    })
    .collect()
}

/// The keys and words in the tables of a document; a name in capitals stands for any.
fn described(document: &str) -> BTreeSet<(String, String)> {
    let text = read(document);
    let rows = text.lines().filter_map(|line| line.strip_prefix("| `")?.strip_suffix(" |"));
    let keys = rows.filter_map(|row| {
        let (key, rest) = row.split_once("` | ")?;
        // A table of files has no defaults.
        let (_, words) = rest.split_once(" | ")?;
        let names = ["NAME", "SIDE", "KEY"];
        let key = key.split('.').map(|name| if names.contains(&name) { "*" } else { name });
        Some((key.collect::<Vec<_>>().join("."), words.to_owned()))
    });
    keys.collect()
}

#[test]
fn case_files_md_has_every_key_with_the_words_of_its_errors_and_no_other() {
    let keys = keys("src/case/keys.rs", "ALLOWED: &[(&str, &str)] = &[");
    assert!(keys.len() > 30, "read {} keys alone", keys.len());
    assert_eq!(described("docs/case_files.md"), keys);
}

#[test]
fn studies_md_has_every_key_with_the_words_of_its_errors_and_no_other() {
    let keys = keys("src/study/keys.rs", "ALLOWED: &Words = &[");
    assert!(keys.len() > 20, "read {} keys alone", keys.len());
    assert_eq!(described("docs/studies.md"), keys);
}

fn documents() -> Vec<String> {
    let docs = fs::read_dir(Path::new(ROOT).join("docs")).expect("docs/");
    let names = docs.map(|entry| format!("docs/{}", entry.expect("an entry").file_name().to_string_lossy()));
    let top = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(str::to_owned);
    names.filter(|name| name.ends_with(".md")).chain(top).collect()
}

#[test]
fn every_link_and_every_file_named_is_there() {
    let mut seen = 0;
    for name in documents() {
        let text = read(&name);
        let folder = Path::new(ROOT).join(&name).parent().map(PathBuf::from).unwrap_or_default();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if !link.starts_with("http") {
                let file = link.split('#').next().unwrap_or_default();
                assert!(file.is_empty() || folder.join(file).exists(), "{name} links to {link}");
                seen += 1;
            }
        }
        // Paths in backquotes, as seen from the top.
        for path in text.split('`').skip(1).step_by(2).filter(|code| !code.contains([' ', '\n', '*', '{'])) {
            if ["src/", "cases/", "tests/", "benches/", "docs/"].iter().any(|top| path.starts_with(top)) {
                assert!(Path::new(ROOT).join(path).exists(), "{name} names {path}");
                seen += 1;
            }
        }
    }
    assert!(seen > 20, "{seen} paths alone");
}

fn toml_files(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(Path::new(ROOT).join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let names = entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    names.filter(|name| name.ends_with(".toml")).collect()
}

#[test]
fn the_readme_lists_every_case_and_every_study() {
    let readme = read("README.md");
    for case in toml_files("cases") {
        assert!(readme.contains(&format!("| `{case}` |")), "{case} is not in the table");
    }
    for study in toml_files("cases/studies") {
        assert!(readme.contains(&format!("| `studies/{study}` |")), "{study} is not in the table");
    }
}

/// The gallery is made by one command; what it shows is small enough to come with the source.
#[test]
fn the_readme_shows_a_small_picture_of_every_case() {
    let readme = read("README.md");
    let mut all = 0;
    for case in toml_files("cases") {
        let picture = format!("docs/images/gallery/{}", case.replace(".toml", ".png"));
        assert!(
            readme.contains(&format!("]({picture})")),
            "{case} has no picture: cargo run --release --example gallery"
        );
        let bytes = fs::metadata(Path::new(ROOT).join(&picture)).expect("a picture").len();
        assert!(bytes < 60_000, "{picture}: {bytes} bytes");
        all += bytes;
    }
    assert!(all < 1_500_000, "{all} bytes");
}

/// Each command is run as it stands but for a coarse cloud and a short time, which miss what a case expects (exit code
/// 1); one that the program does not take ends with 2.
#[test]
fn the_commands_of_the_readme_are_what_the_program_takes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for from in ["cases", "cases/reference", "cases/studies"] {
        fs::create_dir_all(folder.path().join(from)).expect("a folder");
        for entry in fs::read_dir(Path::new(ROOT).join(from)).expect("cases") {
            let path = entry.expect("an entry").path();
            if let (true, Some(name)) = (path.is_file(), path.file_name()) {
                fs::copy(&path, folder.path().join(from).join(name)).expect("a copy");
            }
        }
    }
    let readme = read("README.md");
    let commands: Vec<&str> =
        readme.lines().filter_map(|line| line.trim().strip_prefix("cargo run --release -- ")).collect();
    assert!(commands.len() >= 5, "{commands:?}");
    for command in commands {
        let mut words: Vec<&str> = command.split_whitespace().take_while(|word| *word != "#").collect();
        if words[0] == "run" && words[1].contains("dam_break") {
            words.extend(["--set", "time.end=0.05"]);
        } else if words[0] == "run" {
            words.extend(["--set", "cloud.spacing=0.125", "--set", "time.end=0.2", "--set", "method.radius=2.8"]);
        }
        if words[0] == "cost" {
            words.extend(["--set", "set.time.end=0.2", "--set", "repeats=1"]);
        }
        let output = Command::new(env!("CARGO_BIN_EXE_stillpoint")).args(&words).current_dir(folder.path()).output();
        let output = output.expect("the program starts");
        let message = String::from_utf8_lossy(&output.stderr);
        let code = output.status.code();
        assert!(code == Some(0) || (code == Some(1) && words[0] == "run"), "{words:?}: {code:?} {message}");
    }
    for picture in
        ["cavity_re100_random/pressure.png", "smoke/cost.png", "dam_break_mps/animation.png", "dam_break/sheet.png"]
    {
        assert!(folder.path().join("runs").join(picture).exists(), "no {picture}");
    }
}
