//! Firmware draws the same pictures as the host, and links no float routine.
//!
//! Builds `examples/hello.rs` for three cores and runs it under QEMU, both by `tools/cross`. Without the tools the tests
//! say so and pass, except under `CI=true`.

#[path = "../examples/show/mod.rs"]
mod show;

use std::io::{Read, Write};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// QEMU needs a second or two; more than this means that the firmware hangs.
const PATIENCE: Duration = Duration::from_secs(120);

#[test]
fn thumbv6m_draws_as_the_host_and_without_floats() {
    let Some(firmware) = Firmware::build("thumbv6m-none-eabi") else {
        return;
    };
    assert_eq!(firmware.run(), host());
    assert_eq!(firmware.float_routines(), [""; 0]);
}

#[test]
fn thumbv7m_draws_as_the_host_and_without_floats() {
    let Some(firmware) = Firmware::build("thumbv7m-none-eabi") else {
        return;
    };
    assert_eq!(firmware.run(), host());
    assert_eq!(firmware.float_routines(), [""; 0]);
}

// This core has an FPU, so the absence of routines would say nothing.
#[test]
fn thumbv7em_draws_as_the_host() {
    let Some(firmware) = Firmware::build("thumbv7em-none-eabihf") else {
        return;
    };
    assert_eq!(firmware.run(), host());
}

/// The comparison would mean little if the frames were empty or alike.
#[test]
fn frames_differ() {
    let lines = host();
    let checksum = |line: &String| line.split_once(" crc ").map(|(_, rest)| rest[..8].to_string());
    let mut checksums: Vec<_> = lines.iter().map(checksum).collect();
    assert!(checksums.iter().all(Option::is_some), "{lines:#?}");
    checksums.sort();
    checksums.dedup();
    assert_eq!(checksums.len(), lines.len(), "{lines:#?}");
    assert!(lines.iter().any(|line| !line.contains(" 0 clipped")), "{lines:#?}");
}

fn host() -> Vec<String> {
    let mut stage = Box::new(show::Stage::new());
    (0..show::FRAMES).map(|frame| stage.draw(frame).to_string()).collect()
}

/// `hello`, built for one target.
struct Firmware {
    target: &'static str,
    /// One at a time, or a run would have to wait for another one's build and seem to hang.
    _turn: MutexGuard<'static, ()>,
}

static TURN: Mutex<()> = Mutex::new(());

impl Firmware {
    /// None if the tools for it are missing.
    fn build(target: &'static str) -> Option<Self> {
        let check = Command::new("bash").args(["tools/cross", "--check", target]).current_dir(ROOT).output();
        let lacking = match check {
            Ok(check) if check.status.success() => {
                let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
                let build = cargo("build", target).output().expect("bash ran a moment ago");
                assert!(build.status.success(), "{}", String::from_utf8_lossy(&build.stderr));
                return Some(Self { target, _turn: turn });
            }
            Ok(check) => String::from_utf8_lossy(&check.stderr).into_owned(),
            Err(error) => format!("bash: {error}\n"),
        };
        if std::env::var("CI").as_deref() == Ok("true") {
            panic!("{target}: {lacking}");
        }
        // Not by eprintln, which the test harness shows only when a test fails.
        write!(std::io::stderr(), "\nSKIPPED, NOT TESTED: firmware for {target}\n{lacking}").expect("stderr");
        None
    }

    /// The lines it prints under QEMU. It must exit with 0.
    fn run(&self) -> Vec<String> {
        let mut child =
            cargo("run", self.target).stdin(Stdio::null()).stdout(Stdio::piped()).spawn().expect("bash");
        let mut stdout = child.stdout.take().expect("piped");
        let (sender, printed) = std::sync::mpsc::channel();
        let reader = std::thread::spawn(move || {
            let mut text = String::new();
            // Its receiver is there as long as anyone wants the text.
            let _ = sender.send(stdout.read_to_string(&mut text).map(|_| text));
        });
        // All is printed when it ends. What hangs is ended here: the script and cargo have each replaced
        // themselves, so the child is QEMU.
        let Ok(text) = printed.recv_timeout(PATIENCE) else {
            child.kill().expect("a child of ours");
            panic!("{}: no end after {PATIENCE:?}", self.target);
        };
        let (text, status) = (text.expect("text"), child.wait().expect("a child of ours"));
        reader.join().expect("reader");
        assert!(status.success(), "{}: {status}\n{text}", self.target);
        text.lines().map(str::to_string).collect()
    }

    /// The float routines that are linked.
    fn float_routines(&self) -> Vec<String> {
        let image = target_dir().join(self.target).join("release/examples/hello");
        let nm = cross().args(["bash", "-c", "\"$NM\" \"$1\"", "nm"]).arg(image).output().expect("bash");
        assert!(nm.status.success(), "{}", String::from_utf8_lossy(&nm.stderr));
        let listing = String::from_utf8_lossy(&nm.stdout).into_owned();
        let names: Vec<&str> = listing.lines().filter_map(|line| line.split_whitespace().last()).collect();
        assert!(names.contains(&"Reset"), "not the symbols of a firmware: {listing}");
        names.into_iter().filter(|name| is_float_routine(name)).map(str::to_string).collect()
    }
}

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Beside the test's own build, not in it: two compilers share no build, nor two cargos a lock.
fn target_dir() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).with_file_name("cross")
}

fn cross() -> Command {
    let mut command = Command::new("bash");
    // These would replace the flags by which firmware is linked.
    command
        .arg("tools/cross")
        .current_dir(ROOT)
        .env("CARGO_TARGET_DIR", target_dir())
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    command
}

fn cargo(verb: &str, target: &str) -> Command {
    let mut command = cross();
    command.args([
        env!("CARGO"),
        verb,
        "--quiet",
        "--release",
        "--features",
        "qemu",
        "--example",
        "hello",
        "--target",
        target,
    ]);
    command
}

/// Whether a symbol belongs to software floating point: the names of the ARM ABI, of libgcc, of Rust's own
/// implementation, and of the printing and parsing of floats.
fn is_float_routine(name: &str) -> bool {
    if let Some(name) = name.strip_prefix("__aeabi_") {
        return ["f", "d", "cf", "cd", "h2f"].iter().any(|prefix| name.starts_with(prefix))
            || ["2f", "2d", "2f_vfp", "2d_vfp"].iter().any(|suffix| name.ends_with(suffix));
    }
    if let Some(name) = name.strip_prefix("__") {
        // f(loat) of s(ingle), d(ouble), t(etra) or h(alf) width.
        return ["sf", "df", "tf", "hf"].iter().any(|part| name.contains(part));
    }
    let rust = ["compiler_builtins5float", "compiler_builtins4math", "fmt5float", "flt2dec", "dec2flt"];
    rust.iter().any(|part| name.contains(part))
}

/// A check that cannot fail would be none.
#[test]
fn float_routines_are_known_by_name() {
    for name in [
        "__aeabi_fadd",
        "__aeabi_dmul",
        "__aeabi_cfcmple",
        "__aeabi_i2f",
        "__aeabi_ul2d",
        "__aeabi_f2iz",
        "__aeabi_d2f",
        "__addsf3",
        "__mulsf3",
        "__divdf3",
        "__floatunsisf",
        "__fixsfsi",
        "__extendsfdf2",
        "__unordsf2",
        "__powisf2",
        "_ZN17compiler_builtins5float3add8__addsf317h0",
        "_ZN4core3num7flt2dec8strategy5grisu",
    ] {
        assert!(is_float_routine(name), "{name}");
    }
    for name in [
        "__aeabi_idiv",
        "__aeabi_uidivmod",
        "__aeabi_ldivmod",
        "__aeabi_lmul",
        "__aeabi_llsl",
        "__aeabi_memcpy4",
        "__aeabi_memclr",
        "__muldi3",
        "__udivmodsi4",
        "__ashldi3",
        "__pre_init",
        "__sbss",
        "__INTERRUPTS",
        "Reset",
        "main",
        "DefaultHandler_",
        "__udivdi3",
        "__clzsi2",
    ] {
        assert!(!is_float_routine(name), "{name}");
    }
}
