//! JSON as it is printed.

use serde::Serialize;
use serde_json::{Number, Value};

/// Prints a value in a line.
pub fn print(value: &impl Serialize) {
    if let Ok(value) = serde_json::to_value(value) {
        anstream::println!("{}", tidy(value));
    }
}

/// The same with the shortest decimals that give its 32-bit figures: 0.1, not 0.10000000149011612. A figure
/// that needs 64 bits keeps them.
pub fn tidy(value: Value) -> Value {
    match value {
        Value::Number(number) => Value::Number(shortest(&number).unwrap_or(number)),
        Value::Array(list) => list.into_iter().map(tidy).collect(),
        Value::Object(map) => map
            .into_iter()
            .map(|(key, value)| (key, tidy(value)))
            .collect(),
        other => other,
    }
}

fn shortest(number: &Number) -> Option<Number> {
    let figure = number.as_f64().filter(|_| number.is_f64())?;
    let small = figure as f32;
    let same = f64::from(small) == figure;
    Number::from_f64(small.to_string().parse().ok().filter(|_| same)?)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn small_figures_are_short_and_large_ones_are_kept() {
        let before =
            json!({ "a": [0.1_f32, 0.5, 1.0 / 3.0, 7, -1e-7_f32], "b": u64::MAX, "c": null });
        let after =
            r#"{"a":[0.1,0.5,0.3333333333333333,7,-1e-7],"b":18446744073709551615,"c":null}"#;
        assert_eq!(tidy(before).to_string(), after);
    }
}
