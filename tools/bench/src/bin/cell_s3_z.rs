//! S3 with depth.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Deep};

bench::cell!(Deep<{ cells::TORUS }>, cells::s3_z);
