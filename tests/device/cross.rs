//! Firmware, built by `tools/cross` once for each target, and run under QEMU.

use crate::floats::is_float_routine;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use support::{firmware, ROOT};

/// QEMU needs a second or two; more than this means that the firmware hangs.
pub(crate) const PATIENCE: Duration = Duration::from_secs(120);

/// The example `hello`, built for one target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Firmware {
    target: &'static str,
}

/// The builds so far, locked during a build: a run that waited for a build would seem to hang.
static BUILT: Mutex<BTreeMap<&'static str, Option<Firmware>>> = Mutex::new(BTreeMap::new());

impl Firmware {
    /// `None` if the tools for the target are missing; with `CI` set that fails.
    pub(crate) fn for_target(target: &'static str) -> Option<Self> {
        let mut built = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
        *built.entry(target).or_insert_with(|| Self::build(target))
    }

    fn build(target: &'static str) -> Option<Self> {
        if !has_tools(target) {
            return None;
        }
        let build = ["build", "--quiet", "--release", "--features", "qemu", "--example", "hello", "--target"];
        firmware::run(cross().arg(env!("CARGO")).args(build).arg(target));
        Some(Self { target })
    }

    fn image(&self) -> PathBuf {
        target_dir().join(self.target).join("release/examples/hello")
    }

    /// The lines that `hello` prints on an emulated core. It must exit with 0.
    pub(crate) fn run_hello(&self, core: &str) -> Vec<String> {
        let mut child = Command::new("bash")
            .args(["tools/emulate", core])
            .arg(self.image())
            .current_dir(ROOT)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .expect("bash");
        let mut stdout = child.stdout.take().expect("piped");
        let (sender, printed) = std::sync::mpsc::channel();
        let reader = std::thread::spawn(move || {
            let mut text = String::new();
            // Its receiver is there as long as anyone wants the text.
            let _ = sender.send(stdout.read_to_string(&mut text).map(|_| text));
        });
        // All is printed when it ends. What hangs is ended here: the script has replaced itself, so the child is QEMU.
        let Ok(text) = printed.recv_timeout(PATIENCE) else {
            child.kill().expect("the child can be killed");
            panic!("{core}: no end after {PATIENCE:?}");
        };
        let (text, status) = (text.expect("text"), child.wait().expect("the child can be waited for"));
        reader.join().expect("reader");
        assert!(status.success(), "{core}: {status}\n{text}");
        text.lines().map(str::to_string).collect()
    }

    /// The float routines that are linked into the example.
    pub(crate) fn float_routines(&self) -> Vec<String> {
        let listing = symbols(&self.image());
        assert!(
            listing.lines().any(|line| line.ends_with(" Reset")),
            "not the symbols of a firmware: {listing}"
        );
        let names = listing.lines().filter_map(|line| line.split_whitespace().last());
        names.filter(|name| is_float_routine(name)).map(str::to_string).collect()
    }
}

/// Whether the tools for a target are installed. If not, the test says so; with `CI` set it fails.
pub(crate) fn has_tools(target: &str) -> bool {
    firmware::has_compiler(&format!("firmware for {target}"), target)
}

/// The symbols of an image, one a line.
pub(crate) fn symbols(image: &Path) -> String {
    firmware::run(cross().args(["bash", "-c", "\"$NM\" \"$1\"", "nm"]).arg(image))
}

pub(crate) fn target_dir() -> PathBuf {
    firmware::target_dir(env!("CARGO_TARGET_TMPDIR"))
}

fn cross() -> Command {
    firmware::cross(&target_dir())
}
