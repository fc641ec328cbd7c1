//! S3: the torus, a colour for each face.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Plain};

bench::cell!(Plain<{ cells::TORUS }>, cells::s3);
