//! S3 with depth, its faces not asked by planes.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::cells::{self, Deep};

bench::cell!(Deep<{ cells::TORUS }>, cells::s3_z_no_planes);
