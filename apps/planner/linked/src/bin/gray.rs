//! Faces with depth in bands, on a display of 16 greys or of one bit a pixel, whose bands have no pixels of whole bytes.
#![no_std]
#![no_main]

use linked::*;

depth_bands!(|band| band);
