//! How fog grows from its start to its end: how far on the way the factor is 1 − `odd`/64, half-way between two levels, in 2⁻³⁰, rounded
//! to nearest. `odd` is 1, 3 … 63.

/// The factor is linear in the distance.
#[inline(always)]
pub(super) fn linear(odd: u32) -> u32 {
    odd << 24 // odd ≤ 63: below 2³⁰
}

/// −log₆₄(1 − odd/64): one density everywhere.
#[inline(always)]
pub(super) fn exponential(odd: u32) -> u32 {
    static SHARES: [u32; 32] = [
        0x003e_0a7c,
        0x00bd_221c,
        0x0140_7674,
        0x01c8_5259,
        0x0255_08a3,
        0x02e6_f563,
        0x037e_7f48,
        0x041c_1957,
        0x04c0_44f6,
        0x056b_946f,
        0x061e_ae01,
        0x06da_4fb3,
        0x079f_540e,
        0x086e_b827,
        0x0949_a34a,
        0x0a31_70ee,
        0x0b27_bdc4,
        0x0c2e_7926,
        0x0d47_fcb9,
        0x0e77_2d3c,
        0x0fbf_a900,
        0x1126_0b94,
        0x12b0_5371,
        0x1466_8060,
        0x1653_9586,
        0x1887_5526,
        0x1b19_7205,
        0x1e2f_fdd1,
        0x220e_0cac,
        0x273b_969e,
        0x2f17_fee8,
        0x4000_0000,
    ];
    of(&SHARES, odd)
}

/// The square root of the shares of [`exponential`]: thin near the start.
#[inline(always)]
pub(super) fn squared(odd: u32) -> u32 {
    static SHARES: [u32; 32] = [
        0x03f0_34b2,
        0x06e0_544a,
        0x08f3_6372,
        0x0aae_4bc2,
        0x0c37_964a,
        0x0da0_ee17,
        0x0ef4_3e21,
        0x1037_d151,
        0x1170_01c3,
        0x12a0_079d,
        0x13ca_6834,
        0x14f1_374a,
        0x1616_4077,
        0x173b_237c,
        0x1861_695d,
        0x198a_958e,
        0x1ab8_359d,
        0x1beb_f0fc,
        0x1d27_9ab8,
        0x1e6d_4717,
        0x1fbf_67ce,
        0x2120_f305,
        0x2295_9bf6,
        0x2422_2904,
        0x25cc_fd5d,
        0x279f_01b9,
        0x29a5_4a40,
        0x2bf4_59f6,
        0x2eaf_6c68,
        0x321b_ddc0,
        0x36e6_5fcb,
        0x4000_0000,
    ];
    of(&SHARES, odd)
}

#[inline(always)]
fn of(shares: &[u32; 32], odd: u32) -> u32 {
    shares.get((odd >> 1) as usize).copied().unwrap_or(1 << 30)
}
