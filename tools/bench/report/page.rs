//! The page: how it reads, and whether an older one says the same.

use crate::flash::{Flash, BUILDS, IMAGES};
use crate::speed::Speed;

pub(crate) fn text(compiler: &str, speed: &Speed, flash: &Flash) -> String {
    let mut text = format!("compiler {compiler}\n");
    for (key, (n, crc)) in &speed.lines {
        text += &format!("{key} {n} {crc}\n");
    }
    for image in IMAGES {
        for b in BUILDS {
            text += &format!("{} {} {} {}\n", image.name, b.target, b.level, flash.sizes[&(image.name, b)]);
        }
        text += &format!("{:?}\n", flash.files[image.name]);
    }
    text
}
pub(crate) fn compare(_: &str, _: &str, _: &str, _: &mut Vec<String>) {}
