//! A key, a signature, its verification, a shared secret.

use bench::board::{println, Clock};
use core::hint::black_box;

/// Any number below the order of the curve.
const SECRET: [u32; 8] =
    [0x1357_9bdf, 0x2468_ace0, 0xdead_beef, 0x0bad_f00d, 0x89ab_cdef, 0x7654_3210, 0x0f1e_2d3c, 0x4b5a_6978];
/// Another one: what a signature takes from chance.
const CHANCE: [u32; 8] =
    [0x600d_cafe, 0x3141_5926, 0x2718_2818, 0x1618_0339, 0x1414_2135, 0x0577_2156, 0x1732_0508, 0x5a5a_a5a5];
const HASH: [u8; 32] = *b"an arbitrary hash of thirty-two ";

pub(crate) fn count(clock: &mut Clock) -> Option<()> {
    let (secret, chance, hash) = black_box((SECRET, CHANCE, HASH));
    let ([mut x, mut y, mut r, mut s], mut shared) = ([[0; 8]; 4], [0; 32]);
    let mut good = [false; 4];
    let key = clock.count(&mut || good[0] = p256_cm4::keygen(&mut x, &mut y, &secret))?;
    let sign = clock.count(&mut || good[1] = p256_cm4::sign(&mut r, &mut s, &hash, &secret, &chance))?;
    let verify = clock.count(&mut || good[2] = p256_cm4::verify(&x, &y, &hash, &r, &s))?;
    let ecdh =
        clock.count(&mut || good[3] = p256_cm4::ecdh_calc_shared_secret(&mut shared, &chance, &x, &y))?;
    black_box(shared);
    for instructions in [key, sign, verify, ecdh] {
        println!("{instructions}");
    }
    (good == [true; 4]).then_some(())
}
