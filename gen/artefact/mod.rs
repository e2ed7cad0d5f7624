//! Room `artefact`.
