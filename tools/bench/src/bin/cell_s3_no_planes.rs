//! S3, its faces not asked by planes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Plain};

bench::cell!(Plain<{ cells::TORUS }>, cells::s3_no_planes);
