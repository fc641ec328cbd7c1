//! Runs firmware under QEMU: talks to its serial line, and takes pictures of its display by QMP.
//!
//! (QEMU: *QEMU Machine Protocol Specification*; command `screendump` in the *QMP Reference Manual*.)

use crate::picture::Picture;
use crate::show::SIZE;
use std::io::{self, BufRead, BufReader, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// A run of the firmware. Dropping it ends QEMU.
pub(crate) struct Emulator {
    qemu: Child,
    control: Line,
    serial: Line,
    patience: Duration,
    folder: Folder,
    /// Stack depth in bytes, as the firmware reports it at its end.
    stack: Option<usize>,
}

/// The firmware's report of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Report {
    pub(crate) frame: u32,
    /// Bytes of pixels that were sent.
    pub(crate) bytes: usize,
    pub(crate) caption: String,
}

impl Emulator {
    /// Starts `firmware` on a core. No answer of QEMU or of the firmware may take longer than `patience`.
    pub(crate) fn start(core: &str, firmware: &Path, patience: Duration) -> io::Result<Self> {
        let folder = Folder::new()?;
        let listen = |name: &str| -> io::Result<(UnixListener, String)> {
            let socket = folder.0.join(name);
            let listener = UnixListener::bind(&socket)?;
            listener.set_nonblocking(true)?;
            Ok((listener, format!("unix:{}", socket.display())))
        };
        let ((control, qmp), (serial, uart)) = (listen("qmp")?, listen("serial")?);
        let mut qemu = Command::new("qemu-system-arm")
            .args(["-M", "lm3s6965evb", "-cpu", core, "-display", "none", "-monitor", "none"])
            .args(["-semihosting-config", "enable=on,target=native"])
            // Starts only when everything is connected.
            .args(["-S", "-qmp", &qmp, "-serial", &uart, "-kernel"])
            .arg(firmware)
            .stdin(Stdio::null())
            .stderr(std::fs::File::create(folder.0.join("stderr"))?)
            .spawn()
            .map_err(|error| io::Error::new(error.kind(), format!("qemu-system-arm: {error}")))?;
        let mut accept = |listener: &UnixListener| {
            let accepted = wait(patience, || match listener.accept() {
                Ok((stream, _)) => Ok(Some(stream)),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => match qemu.try_wait()? {
                    Some(status) => Err(io::Error::other(format!("QEMU ended: {status}"))),
                    None => Ok(None),
                },
                Err(error) => Err(error),
            });
            accepted.and_then(|stream| Line::new(stream, patience))
        };
        let connected = accept(&control).and_then(|control| Ok((control, accept(&serial)?)));
        let (control, serial) = match connected {
            Ok(lines) => lines,
            Err(error) => {
                end(&mut qemu);
                return Err(folder.explain(error));
            }
        };
        let mut emulator = Self { qemu, control, serial, patience, folder, stack: None };
        match emulator.begin() {
            Ok(()) => Ok(emulator),
            Err(error) => Err(emulator.folder.explain(error)),
        }
    }

    fn begin(&mut self) -> io::Result<()> {
        self.control.read()?; // the greeting
        self.execute(r#"{"execute": "qmp_capabilities"}"#)?;
        self.execute(r#"{"execute": "cont"}"#)
    }

    /// Waits for the next frame; it stays until [`proceed`](Self::proceed). `None` after the last one.
    pub(crate) fn frame(&mut self) -> io::Result<Option<(Report, Picture)>> {
        let frame = self.report();
        frame.map_err(|error| self.folder.explain(error))
    }

    fn report(&mut self) -> io::Result<Option<(Report, Picture)>> {
        let line = self.serial.read()?;
        let wrong = || io::Error::other(format!("no report of a frame: {line:?}"));
        if let Some(stack) = line.strip_prefix("end ") {
            self.stack = Some(stack.parse().map_err(|_| wrong())?);
            return Ok(None);
        }
        let mut words = line.splitn(3, ' ');
        let mut word = || words.next().ok_or_else(wrong);
        let frame = word()?.parse().map_err(|_| wrong())?;
        let bytes = word()?.parse().map_err(|_| wrong())?;
        let caption = word()?.to_string();
        Ok(Some((Report { frame, bytes, caption }, self.picture()?)))
    }

    /// Lets the firmware draw the next frame.
    pub(crate) fn proceed(&mut self) -> io::Result<()> {
        self.answer(b'\n')
    }

    /// Sends a byte to the firmware. Any byte but a newline makes it send that byte to the display as a command, and end.
    pub(crate) fn answer(&mut self, byte: u8) -> io::Result<()> {
        self.serial.0.get_mut().write_all(&[byte])
    }

    /// Waits for the firmware's end; a panic or a command unknown to the display is an error. Returns the depth of the stack in
    /// bytes.
    pub(crate) fn finish(mut self) -> io::Result<usize> {
        let qemu = &mut self.qemu;
        let status = wait(self.patience, || qemu.try_wait())?;
        if !status.success() || complains(&self.folder.said()?) {
            return Err(self.folder.explain(io::Error::other(status.to_string())));
        }
        self.stack.ok_or_else(|| io::Error::other("it did not say how deep its stack was"))
    }

    fn picture(&mut self) -> io::Result<Picture> {
        let file = self.folder.0.join("picture.ppm");
        let name = escape(&file.to_string_lossy());
        self.execute(&format!(r#"{{"execute": "screendump", "arguments": {{"filename": "{name}"}}}}"#))?;
        let dump = std::fs::read(&file)?;
        decode(&dump).ok_or_else(|| io::Error::other("not a picture of the panel"))
    }

    /// Executes a QMP command; events before its answer are ignored.
    fn execute(&mut self, command: &str) -> io::Result<()> {
        self.control.0.get_mut().write_all(command.as_bytes())?;
        loop {
            let line = self.control.read()?;
            if line.starts_with(r#"{"return""#) {
                return Ok(());
            }
            if line.starts_with(r#"{"error""#) {
                return Err(io::Error::other(line));
            }
        }
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        end(&mut self.qemu);
    }
}

/// Ends QEMU, which may have ended by itself.
fn end(qemu: &mut Child) {
    let _ = qemu.kill();
    let _ = qemu.wait();
}

/// Whether the display model complained of an unknown command. Other output of QEMU is no failure.
pub(crate) fn complains(said: &str) -> bool {
    said.contains("ssd0323")
}

/// Text between the quotes of a JSON string (RFC 8259, section 7).
fn escape(text: &str) -> String {
    let escape = |c: char| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c < ' ' => format!("\\u{:04x}", u32::from(c)),
        c => c.to_string(),
    };
    text.chars().map(escape).collect()
}

/// Polls every few milliseconds until there is an answer or patience ends.
fn wait<T>(patience: Duration, mut ask: impl FnMut() -> io::Result<Option<T>>) -> io::Result<T> {
    const PAUSE: Duration = Duration::from_millis(2);
    let mut waited = Duration::ZERO;
    while waited < patience {
        if let Some(answer) = ask()? {
            return Ok(answer);
        }
        std::thread::sleep(PAUSE);
        waited += PAUSE;
    }
    Err(io::ErrorKind::TimedOut.into())
}

/// A connection that sends lines of text.
struct Line(BufReader<UnixStream>);

impl Line {
    fn new(stream: UnixStream, patience: Duration) -> io::Result<Self> {
        stream.set_nonblocking(false)?;
        stream.set_read_timeout(Some(patience))?;
        stream.set_write_timeout(Some(patience))?;
        Ok(Self(BufReader::new(stream)))
    }

    fn read(&mut self) -> io::Result<String> {
        let mut line = String::new();
        match self.0.read_line(&mut line) {
            Ok(0) => Err(io::ErrorKind::UnexpectedEof.into()),
            Ok(_) => Ok(line.trim_end().to_string()),
            // The kind of a timeout depends on the operating system.
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => Err(io::ErrorKind::TimedOut.into()),
            Err(error) => Err(error),
        }
    }
}

/// The temporary folder of a run. Its name is short, because sockets limit the length of paths.
struct Folder(PathBuf);

impl Folder {
    fn new() -> io::Result<Self> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("pinhole-{}-{number}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder); // of a process long gone
        std::fs::create_dir(&folder)?;
        Ok(Self(folder))
    }

    /// The messages of QEMU and its devices.
    fn said(&self) -> io::Result<String> {
        std::fs::read_to_string(self.0.join("stderr"))
    }

    /// An error with the messages of QEMU.
    fn explain(&self, error: io::Error) -> io::Error {
        let said = self.said().unwrap_or_default();
        io::Error::new(error.kind(), format!("{error}\n{said}"))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The panel's levels from a screen dump, a binary PPM: each pixel is a block of 4 × 4, and level L is grey 17·L.
fn decode(dump: &[u8]) -> Option<Picture> {
    const SCALE: usize = 4;
    let (width, height) = (SIZE.width as usize * SCALE, SIZE.height as usize * SCALE);
    let pixels = dump.strip_prefix(format!("P6\n{width} {height}\n255\n").as_bytes())?;
    let rows: Vec<&[u8]> = pixels.chunks(3 * width).collect();
    if pixels.len() != 3 * width * height {
        return None;
    }
    let mut levels = Vec::new();
    for block_row in rows.chunks(SCALE) {
        for left in (0..width).step_by(SCALE) {
            let value = block_row[0][3 * left];
            let even = |row: &&[u8]| row[3 * left..][..3 * SCALE].iter().all(|v| *v == value);
            if value % 17 != 0 || !block_row.iter().all(even) {
                return None;
            }
            levels.push(value / 17);
        }
    }
    Picture::new(levels)
}
