//! From firmware to a display: drivers and wire formats show pictures on models of panels, and the README's steps lead to a picture
//! and to firmware that links no float routine. That all cores draw the host's pictures is in step `device-tests` of `.ci/steps`;
//! `boards/emulate` compares displays of emulated boards, pixel by pixel.

mod floats;
mod tearing;
mod template;
mod wire;
