//! What `pinhole-render` draws, says and writes, and the templates whose pictures it shows.

mod boards;
mod files;
mod people;
