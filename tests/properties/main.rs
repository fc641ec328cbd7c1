//! What holds for every input, on random ones dense in hard values; what fails is shrunk to a small case. The cases
//! are the same in every run, and nothing is written into the tree. For others, and more of them:
//!
//! ```text
//! PROPTEST_RNG_SEED=1 PROPTEST_CASES=100000 cargo test --test properties
//! ```

mod bands;
mod clips;
mod dirty;
mod raster;
mod scenes;
mod strategies;
mod transforms;

use proptest::test_runner::{Config, RngSeed};

/// So many cases, from a fixed seed, unless the environment says otherwise.
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
