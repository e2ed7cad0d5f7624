//! Input files that are read whole.

use std::io::{Error, Result};
use std::path::Path;

/// The bytes of a file or a pipe; a device is refused, since it need not have an end.
///
/// # Errors
/// What the system says.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    if is_device(path) {
        return Err(Error::other("it is a device"));
    }
    std::fs::read(path)
}

/// The text of a file or a pipe.
///
/// # Errors
/// What the system says, or that the bytes are no text.
pub fn text(path: &Path) -> Result<String> {
    String::from_utf8(read(path)?).map_err(|_| Error::other("it is not valid UTF-8"))
}

#[cfg(unix)]
fn is_device(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt;
    std::fs::metadata(path).is_ok_and(|found| found.file_type().is_char_device())
}

#[cfg(not(unix))]
fn is_device(_: &Path) -> bool {
    false
}

#[cfg(all(test, unix))]
mod tests {
    #[test]
    fn a_device_is_refused() {
        assert_eq!(super::read("/dev/zero".as_ref()).unwrap_err().to_string(), "it is a device");
        assert!(super::text("/dev/zero".as_ref()).is_err() && super::read(file!().as_ref()).is_err());
    }
}
