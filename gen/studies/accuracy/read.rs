//! Results read back from the file `accuracy.json`.

use super::headline;
use super::results::Results;

/// The greatest number of a campaign: no count and no time comes near it.
const GREATEST: f64 = (1u64 << 50) as f64;

/// Why a text is no results. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// It is not the JSON that is written.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// There is no row.
    #[error("rows: found none")]
    Empty,
    /// A place among the rows that there is not.
    #[error("foldings[].row: found {row} where there are {rows} rows")]
    Row {
        /// The place.
        row: usize,
        /// How many rows there are.
        rows: usize,
    },
    /// A number that nothing comes near.
    #[error("{path}: found {number}")]
    Number {
        /// Keys down to it.
        path: String,
        /// The number.
        number: f64,
    },
}

/// The first number beyond [`GREATEST`]; seeds may be.
fn too_large(value: &serde_json::Value) -> Option<(String, f64)> {
    use serde_json::Value;
    let below = |key: &str, value: &Value| {
        let (path, number) = too_large(value)?;
        Some((if path.is_empty() { key.to_owned() } else { format!("{key}.{path}") }, number))
    };
    match value {
        Value::Object(map) => map.iter().filter(|(key, _)| *key != "seed").find_map(|(key, value)| below(key, value)),
        Value::Array(list) => list.iter().enumerate().find_map(|(i, value)| below(&i.to_string(), value)),
        Value::Number(number) => number.as_f64().filter(|x| x.abs() > GREATEST).map(|x| (String::new(), x)),
        _ => None,
    }
}

impl Results {
    /// Results as the file `accuracy.json` has them. Sentences are worded anew.
    ///
    /// # Errors
    /// What is wrong with the text.
    pub fn read(json: &str) -> Result<Self, ResultsError> {
        let mut results: Self = serde_json::from_str(json)?;
        results.check(&serde_json::from_str(json)?)?;
        results.headline = headline::sentences(&results);
        Ok(results)
    }

    /// What types do not say; `value` is the whole text. Sums and differences of numbers that pass are finite.
    fn check(&self, value: &serde_json::Value) -> Result<(), ResultsError> {
        if let Some((path, number)) = too_large(value) {
            return Err(ResultsError::Number { path, number });
        }
        if self.rows.is_empty() {
            return Err(ResultsError::Empty);
        }
        let rows = self.rows.len();
        match self.foldings.iter().filter_map(|fold| fold.row).find(|row| *row >= rows) {
            Some(row) => Err(ResultsError::Row { row, rows }),
            None => Ok(()),
        }
    }
}
