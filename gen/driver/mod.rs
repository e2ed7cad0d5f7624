//! The host's side of the stream wrapper: packs pairs and poses into words, unpacks verdicts, retests in software.
