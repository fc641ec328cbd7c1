//! Prints the instructions of every case and way, and at last of placing an object and of turning its light, a line each.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::board::{println, Clock};
use bench::firmware;
use bench::growth::{placing, ways, Memory, CASES};

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = Clock::new()?;
    for case in CASES {
        for way in ways() {
            println!("{}", case.count(way, memory, &mut clock)?);
        }
    }
    let [place, light] = placing(&mut clock)?;
    println!("{place}\n{light}");
    Some(())
});
