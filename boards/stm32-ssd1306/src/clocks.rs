//! The clocks of an STM32F411: 100 MHz, and 50 MHz for the slow bus.

use embassy_stm32::rcc::{APBPrescaler, Pll, PllMul, PllPDiv, PllPreDiv, PllSource, Sysclk};

pub fn config() -> embassy_stm32::Config {
    let mut config = embassy_stm32::Config::default();
    // 16 MHz without a crystal, times 200, by 32: 100 MHz.
    config.rcc.pll_src = PllSource::HSI;
    config.rcc.pll = Some(Pll {
        prediv: PllPreDiv::DIV16,
        mul: PllMul::MUL200,
        divp: Some(PllPDiv::DIV2),
        divq: None,
        divr: None,
    });
    config.rcc.sys = Sysclk::PLL1_P;
    config.rcc.apb1_pre = APBPrescaler::DIV2;
    config
}
