//! Lines of output for the user, of the command and of pinhole's host examples.

use super::shown::shown;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Lines to standard output. Who closes it (`| head`) has read enough, and the program goes on without.
pub(crate) fn say(lines: impl Display) -> Result<(), String> {
    let text: String = lines.to_string().split('\n').flat_map(|line| [shown(line), "\n".into()]).collect();
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(problem) if problem.kind() != ErrorKind::BrokenPipe => {
            Err(format!("standard output: cannot be written: {problem}"))
        }
        _ => Ok(()),
    }
}

/// A line to standard error, if anybody reads that; there is no other place to say that nobody does.
pub(crate) fn complain(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{}", shown(&line.to_string()));
}

/// Prints the warnings about a model to standard error, one line each.
pub(crate) fn warn(model: &Path, warnings: impl IntoIterator<Item = impl Display>) {
    for warning in warnings {
        complain(format_args!("{}: warning: {warning}", model.display()));
    }
}
