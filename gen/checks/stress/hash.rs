//! The 64-bit hash FNV-1a: the same on every machine.

/// Where a hash begins.
pub(super) const BASIS: u64 = 0xcbf2_9ce4_8422_2325;

/// A hash with more bytes taken in.
pub(super) fn fnv(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of the authors of the hash.
    #[test]
    fn known_hashes() {
        let hash = |text: &str| fnv(BASIS, text.as_bytes());
        assert_eq!([hash(""), hash("a"), hash("foobar")], [BASIS, 0xaf63_dc4c_8601_ec8c, 0x8594_4171_f739_67e8]);
    }
}
