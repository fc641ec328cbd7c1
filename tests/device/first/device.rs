use cortex_m as _;
use semihosting::{print, println};

#[cortex_m_rt::entry]
fn main() -> ! {
    print();
    semihosting::process::exit(0)
}
