//! Reference pictures and coordinates in files. `GOLDEN=1 cargo test --test golden` writes them anew.

mod picture;
mod pictures;
mod reference;
