//! Firmware that tests build with `tools/cross`, from copies of the templates too.

use crate::ROOT;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};

/// Whether all these scripts, run in the repository with their arguments, end well. If not, the test says what it leaves out; with
/// `CI` set it fails.
pub fn has_tools(what: &str, checks: &[&[&str]]) -> bool {
    let lacking = checks.iter().filter_map(|check| {
        match Command::new("bash").args(*check).current_dir(ROOT).output() {
            Ok(output) if output.status.success() => None,
            Ok(output) => Some(String::from_utf8_lossy(&output.stderr).into_owned()),
            Err(error) => Some(format!("bash: {error}\n")),
        }
    });
    let lacking: String = lacking.collect();
    if lacking.is_empty() {
        return true;
    }
    assert!(std::env::var_os("CI").is_none(), "{what}: {lacking}");
    // Not by eprintln, which the test harness shows only when a test fails.
    write!(std::io::stderr(), "\nSKIPPED, NOT TESTED: {what}\n{lacking}").expect("stderr");
    false
}

/// [`has_tools`] for what is built for a target.
pub fn has_compiler(what: &str, target: &str) -> bool {
    has_tools(what, &[&["tools/cross", "--check", target]])
}

/// Beside the folder of a test's own files, `CARGO_TARGET_TMPDIR`: another compiler and another cargo cannot share its build.
pub fn target_dir(tests: &str) -> PathBuf {
    Path::new(tests).with_file_name("cross")
}

/// `tools/cross`, run in the repository; arguments are its command.
pub fn cross(target_dir: &Path) -> Command {
    let mut command = Command::new("bash");
    command.arg(Path::new(ROOT).join("tools/cross")).current_dir(ROOT).env("CARGO_TARGET_DIR", target_dir);
    // These would replace the flags by which firmware is linked.
    command.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    command
}

/// What a command prints, which must end well.
pub fn run(command: &mut Command) -> String {
    let output = command.stdin(Stdio::null()).output().expect("a command");
    assert!(output.status.success(), "{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// Replaces a text that the file has once.
pub fn edit(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).expect("a file of the template");
    assert_eq!(text.matches(from).count(), 1, "{}: {from}", file.display());
    fs::write(file, text.replace(from, to)).expect("a file of the copy");
}

/// The image of a copy of a board's template in `folder`, once `change` has changed the copy.
pub fn image(
    board: &str,
    target: &str,
    target_dir: &Path,
    folder: &Path,
    change: impl FnOnce(&Path),
) -> PathBuf {
    // One at a time: all are built into one folder, and cargo takes them for one package, which it builds again where a file is
    // newer than what it has built.
    static ONE: Mutex<()> = Mutex::new(());
    let _one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    let copy = folder.join("firmware");
    run(Command::new("bash").arg(Path::new(ROOT).join("boards/new")).arg(board).arg(&copy));
    change(&copy);
    let build = [env!("CARGO"), "build", "--quiet", "--release", "--target", target];
    run(cross(target_dir).args(build).current_dir(&copy));
    let image = folder.join("image");
    fs::copy(target_dir.join(target).join("release/firmware"), &image).expect("the image");
    image
}

/// The folders of `boards` that are templates.
pub fn templates() -> Vec<String> {
    let folders = fs::read_dir(Path::new(ROOT).join("boards")).expect("boards");
    let names = folders.map(|folder| folder.expect("a folder").file_name().into_string().expect("a name"));
    let names: Vec<_> = names.filter(|name| name.contains('-')).collect();
    assert!(names.len() >= 9, "{names:?}");
    names
}

/// A temporary folder outside the repository, so that the repository's `.cargo/config.toml` does not apply.
pub struct Folder(pub PathBuf);

impl Folder {
    /// `name` is that of one test.
    pub fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("pinhole-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        Self(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
