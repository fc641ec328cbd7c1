//! Properties of every input, tested on random inputs dense in hard values. Proptest shrinks a failing input to a small
//! case. Every run tests the same cases and writes no files. To test other cases, and more of them:
//!
//! ```text
//! PROPTEST_RNG_SEED=1 PROPTEST_CASES=100000 cargo test --test properties
//! ```

mod dirty;
mod scalar;
mod scenes;
mod two_cores;

use proptest::test_runner::{Config, RngSeed};

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
