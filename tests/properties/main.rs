//! Properties of every input, tested on random inputs dense in hard values. Proptest shrinks a failing input to a small
//! case. Every run tests the same cases and writes no files. To test other cases, and more of them:
//!
//! ```text
//! PROPTEST_RNG_SEED=1 PROPTEST_CASES=100000 cargo test --test properties
//! ```

mod dirty;
#[path = "../../fuzz/targets/mod.rs"]
mod fuzzed;
mod scalar;
mod scenes;
mod two_cores;

use proptest::test_runner::{Config, RngSeed};
use support::oracle::rng::Rng;

/// A configuration of `number` cases from a fixed seed, unless the environment sets others.
fn cases(number: u32) -> Config {
    let mut config =
        Config { failure_persistence: None, max_global_rejects: 100 * number, ..Config::default() };
    if std::env::var_os("PROPTEST_CASES").is_none() {
        config.cases = number;
    }
    if config.rng_seed == RngSeed::Random {
        config.rng_seed = RngSeed::Fixed(0x9119);
    }
    config
}

/// What a fuzz target checks, of the inputs in `fuzz/seeds.txt` and of so many random ones.
fn check_fuzzed(name: &str, number: u32) {
    let (_, check) = fuzzed::TARGETS.into_iter().find(|target| target.0 == name).expect("a target");
    for line in include_str!("../../fuzz/seeds.txt").lines() {
        if let [target, _, digits] = line.split(' ').collect::<Vec<_>>()[..] {
            let byte = |two| u8::from_str_radix(two, 16).expect("two digits");
            let bytes = (0..digits.len()).step_by(2).map(|at| byte(&digits[at..at + 2]));
            if target == name {
                check(&bytes.collect::<Vec<_>>());
            }
        }
    }
    let mut rng = Rng::new(0xF022);
    for _ in 0..number {
        let bytes: Vec<u8> = (0..rng.int(8, 128)).map(|_| rng.bits() as u8).collect();
        check(&bytes);
    }
}

macro_rules! fuzzed {
    ($($target:ident: $number:expr,)*) => {$(
        #[test]
        fn $target() {
            check_fuzzed(stringify!($target), $number);
        }
    )*};
}

fuzzed! {
    anti_aliased: 100_000,
    scene: 25_000,
    set_up: 600_000,
    smooth: 100_000,
    texture: 30_000,
    translucent: 30_000,
}
