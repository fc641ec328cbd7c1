//! Measures how far the library's numbers lie from f64's and writes docs/accuracy.md:
//!
//! ```text
//! cargo run --release --example accuracy -- --help
//! ```

#[path = "../../tests/bridge/mod.rs"]
mod bridge;
mod figures;
mod functions;
#[allow(dead_code)]
#[path = "../../src/math/num.rs"]
mod num;
#[path = "../../tests/oracle/mod.rs"]
mod oracle;
mod population;
mod sweep;
#[allow(dead_code)]
#[path = "../../src/math/unit.rs"]
mod unit;

fn main() {
    let t = std::time::Instant::now();
    for m in functions::all() {
        println!("{:50} {:30} {:.3} {} {} ratio {:.3}", m.what, m.unit, m.error.log2(), figures::binary(m.error), figures::binary(m.bound), m.bound/m.error);
    }
        println!("{:?}", t.elapsed());
    std::thread::scope(|s| {
    for p in &population::POPULATIONS {
      s.spawn(||{
        let s = sweep::sweep(p).unwrap();
        println!("{} {} cameras {}", p.name, s.cameras, figures::decimal(s.per_ratio));
      });
    }
        });
        println!("{:?}", t.elapsed());
}
