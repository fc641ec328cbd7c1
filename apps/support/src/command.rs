//! Command lines: help, options that several programs take, and one form for every refusal.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{value_parser, Arg, ArgAction, ArgMatches, Command};
use clap_complete::Shell;
use embedded_graphics::geometry::Size;
use std::io::{self, Write};
use std::ops::RangeInclusive;
use std::path::Path;
use std::process::ExitCode;

pub use crate::host::{complain, say, warn};

/// Runs a program. An error is printed as one line, whatever characters a file or its name brings into the message, and the
/// exit code is 2.
pub fn run<E: ToString>(program: impl FnOnce() -> Result<ExitCode, E>) -> ExitCode {
    program().unwrap_or_else(|problem| {
        complain(problem.to_string());
        ExitCode::from(2)
    })
}

/// Parses the command line. Asked for help, it prints the help and ends the program. The error is the message to print where an
/// argument is wrong.
pub fn matches(command: Command) -> Result<ArgMatches, String> {
    command.try_get_matches().map_err(|error| {
        if error.exit_code() == 0 {
            error.exit();
        }
        // The lines up to the first empty one name the problem; tips and usage follow.
        let text = error.to_string();
        let lines: Vec<_> = text.lines().take_while(|line| !line.is_empty()).map(str::trim).collect();
        lines.join(" ") + what_to_do(&error)
    })
}

/// Parses the command line of a program that users install: it has a version, and prints completions of its options for a shell, or its
/// man page.
pub fn installed(command: Command) -> Result<ArgMatches, String> {
    let completions = Arg::new("completions").long("completions").value_name("SHELL");
    let man = Arg::new("man").long("man").action(ArgAction::SetTrue).exclusive(true);
    let mut command = command
        .version(env!("CARGO_PKG_VERSION"))
        .next_help_heading("To install")
        .arg(
            completions
                .help("Print the completions of options for a shell")
                .value_parser(value_parser!(Shell))
                .exclusive(true),
        )
        .arg(man.help("Print the man page"));
    let mut given = matches(command.clone())?;
    let mut text = Vec::new();
    if let Some(shell) = given.remove_one::<Shell>("completions") {
        let name = command.get_name().to_string();
        clap_complete::generate(shell, &mut command, name, &mut text);
    } else if given.get_flag("man") {
        clap_mangen::Man::new(command).render(&mut text).map_err(|e| e.to_string())?;
    } else {
        return Ok(given);
    }
    let _ = io::stdout().write_all(&text); // a reader such as `head` may have seen enough
    std::process::exit(0)
}

/// The advice that ends the message about a refused argument, from its colon on.
fn what_to_do(error: &clap::Error) -> &'static str {
    match (error.kind(), error.get(ContextKind::InvalidArg)) {
        // A value after a space where the option can stand alone, or a second file.
        (ErrorKind::UnknownArgument, Some(ContextValue::String(word))) if !word.starts_with('-') => {
            ": one file is taken; a value of an option that may stand alone follows =, as in --option=value"
        }
        (ErrorKind::UnknownArgument | ErrorKind::MissingRequiredArgument, _) => {
            ": --help lists what there is"
        }
        _ => "",
    }
}

/// The option `--NAME VALUE`, with a default.
pub fn option(name: &'static str, value: &'static str, help: &'static str, default: &'static str) -> Arg {
    Arg::new(name).long(name).value_name(value).help(help).default_value(default)
}

/// Parses the value of `--size WxH`; width and height must lie in `range`. The error is the message to print if the text is not a
/// valid size.
pub fn size(text: &str, range: RangeInclusive<u32>) -> Result<Size, String> {
    let size = text.split_once('x').and_then(|(w, h)| Some(Size::new(w.parse().ok()?, h.parse().ok()?)));
    size.filter(|size| range.contains(&size.width) && range.contains(&size.height)).ok_or_else(|| {
        format!("--size: {text} is not WxH, each from {} to {}, such as 320x240", range.start(), range.end())
    })
}

/// Creates the folder for the output unless it exists. The error names the folder.
pub fn folder(path: &Path) -> Result<(), String> {
    std::fs::create_dir_all(path).map_err(|e| format!("{}: cannot be created: {e}", path.display()))
}
