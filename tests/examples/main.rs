//! The examples, run as a user runs them: their pictures and films, their messages for bad input, and their promises about
//! standard output and files.

mod cookbook;
mod film;
mod programs;
mod shared_promises;
mod spin;
