//! Numbers and what they count: "5 cm", "half a metre", "two and a half centimetres", "minus 30
//! degrees".

use super::error::LanguageError;
use super::table::{Meaning, Table};
use super::token::{Kind, SIGNS, Token};

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measured {
    /// The place of a category's name in [`Table::kinds`], and metres, radians or pieces.
    Quantity(usize, f32),
    /// A number without unit.
    Number(f32),
}

/// Nothing on a table is larger, and everything smaller keeps its sense in 32 bits.
const LARGEST: f64 = 1e6;

/// Reads a number, with its unit if there is one, at the start of `tokens`; also how many tokens it
/// takes.
///
/// # Errors
/// [`LanguageError::BadQuantity`] beyond a million, [`LanguageError::UnclearNumber`].
pub fn measure(
    tokens: &[Token],
    table: &Table,
) -> Result<Option<(Measured, usize)>, LanguageError> {
    if let [sign, digits, ..] = tokens
        && sign.text.starts_with(SIGNS)
    {
        let word = format!("{}{}", sign.text, digits.text);
        return Err(LanguageError::UnclearNumber { word });
    }
    let run = tokens.iter().take_while(|t| t.kind == Kind::Word).count();
    let mut cursor = Cursor {
        tokens: tokens.get(..run).unwrap_or_default(),
        at: 0,
        table,
    };
    let minus = cursor
        .take(|m| matches!(m, Meaning::Minus).then_some(()))
        .is_some();
    let Some(mut value) = cursor.number()? else {
        return Ok(None);
    };
    let number_end = cursor.at;
    let unit = cursor.take(unit_of);
    let mut sum = 0.0;
    if unit.is_some() {
        // "a metre and a half"
        let before = cursor.at;
        let and = cursor.take(|m| matches!(m, Meaning::NumberAnd).then_some(()));
        match and.and_then(|()| cursor.take(fraction_of)) {
            Some(fraction) if cursor.take(unit_of).is_none() => value += fraction,
            _ => cursor.at = before,
        }
    }
    if let Some((kind, factor)) = unit.filter(|(kind, _)| table.sums(*kind)) {
        sum = cursor.smaller(kind, factor)?;
    }
    if minus {
        value = -value;
        sum = -sum;
    }
    let used = if unit.is_some() {
        cursor.at
    } else {
        number_end
    };
    let measured = unit.map_or(value, |(_, factor)| value * factor + sum);
    if !(measured.abs() <= LARGEST && value.abs() <= LARGEST) {
        let said = tokens.get(..used).unwrap_or_default();
        let said: Vec<_> = said.iter().map(|t| t.text.as_str()).collect();
        return Err(LanguageError::BadQuantity {
            word: said.join(" "),
        });
    }
    let measured = measured as f32;
    Ok(Some(match unit {
        Some((kind, _)) => (Measured::Quantity(kind, measured), used),
        None => (Measured::Number(measured), used),
    }))
}

fn unit_of(meaning: &Meaning) -> Option<(usize, f64)> {
    match meaning {
        Meaning::Unit(kind, factor) => Some((*kind, *factor)),
        _ => None,
    }
}

fn number_of(meaning: &Meaning) -> Option<f64> {
    match meaning {
        Meaning::Number(value) => Some(f64::from(*value)),
        _ => None,
    }
}

fn fraction_of(meaning: &Meaning) -> Option<f64> {
    number_of(meaning).filter(|v| *v < 1.0)
}

struct Cursor<'a> {
    tokens: &'a [Token],
    at: usize,
    table: &'a Table,
}

impl Cursor<'_> {
    /// Takes the longest phrase that has such a meaning.
    fn take<T>(&mut self, wanted: impl Fn(&Meaning) -> Option<T>) -> Option<T> {
        let rest = self.tokens.get(self.at..).unwrap_or_default();
        for length in (1..=rest.len().min(4)).rev() {
            let words: Vec<_> = rest.iter().take(length).map(|t| t.text.as_str()).collect();
            if let Some(found) = self.table.meanings(&words).iter().find_map(&wanted) {
                self.at += length;
                return Some(found);
            }
        }
        None
    }

    /// What is added in smaller units: "10 cm and 5 mm", "5 m 3 cm".
    fn smaller(&mut self, kind: usize, mut factor: f64) -> Result<f64, LanguageError> {
        let mut sum = 0.0;
        loop {
            let before = self.at;
            self.take(|m| matches!(m, Meaning::NumberAnd).then_some(()));
            let value = self.number()?;
            let unit = value.and_then(|_| self.take(unit_of));
            match value.zip(unit.filter(|&(k, f)| k == kind && f < factor)) {
                Some((value, (_, smaller))) => {
                    sum += value * smaller;
                    factor = smaller;
                }
                None => {
                    self.at = before;
                    return Ok(sum);
                }
            }
        }
    }

    fn digits(&mut self) -> Result<Option<f64>, LanguageError> {
        let Some(token) = self.tokens.get(self.at) else {
            return Ok(None);
        };
        if !token.text.starts_with(|c: char| c.is_ascii_digit()) {
            return Ok(None);
        }
        let plain = plain(&token.text, self.table.pack().joints.thousands);
        let plain = plain.ok_or_else(|| LanguageError::UnclearNumber {
            word: token.text.clone(),
        })?;
        let value = plain.parse().ok();
        self.at += usize::from(value.is_some());
        Ok(value)
    }

    fn number(&mut self) -> Result<Option<f64>, LanguageError> {
        match self.digits()? {
            Some(value) => Ok(Some(self.with_fraction(value))),
            None => Ok(self.spelt()),
        }
    }

    /// A number in words.
    fn spelt(&mut self) -> Option<f64> {
        let mut value = self.take(number_of)?;
        if value < 1.0 && value > 0.0 {
            return Some(value);
        }
        // "twenty five", "two hundred and ten"
        loop {
            let before = self.at;
            if value >= 100.0 {
                self.take(|m| matches!(m, Meaning::NumberAnd).then_some(()));
            }
            match self.take(number_of) {
                Some(100.0) if value < 100.0 => value *= 100.0,
                Some(next) if next >= 1.0 && next < last_place(value) => value += next,
                _ => {
                    self.at = before;
                    break;
                }
            }
        }
        let before = self.at;
        if self
            .take(|m| matches!(m, Meaning::Point).then_some(()))
            .is_some()
        {
            match self.decimals() {
                Some(decimals) => return Some(value + decimals),
                None => self.at = before,
            }
        }
        Some(self.with_fraction(value))
    }

    /// "point two five"
    fn decimals(&mut self) -> Option<f64> {
        let mut scale = 0.1;
        let mut sum = None;
        while let Some(digit) =
            self.take(|m| number_of(m).filter(|v| *v < 10.0 && v.fract() == 0.0))
        {
            sum = Some(sum.unwrap_or(0.0) + digit * scale);
            scale *= 0.1;
        }
        sum
    }

    /// "and a half"
    fn with_fraction(&mut self, value: f64) -> f64 {
        let before = self.at;
        let and = self.take(|m| matches!(m, Meaning::NumberAnd).then_some(()));
        if let Some(fraction) = and.and_then(|()| self.take(fraction_of)) {
            return value + fraction;
        }
        self.at = before;
        value
    }
}

/// Digits without what groups them and with a dot before decimals; `None` when they may be more than
/// one number.
fn plain(text: &str, thousands: Option<char>) -> Option<String> {
    // Without a mark of thousands the comma is decimal, and a dot may be either.
    let mark = thousands.unwrap_or('.');
    let decimal = if mark == ',' { '.' } else { ',' };
    let (whole, decimals) = text.split_once(decimal).unwrap_or((text, ""));
    let groups: Vec<_> = whole.split(mark).collect();
    let (first, rest) = groups.split_first()?;
    let grouped = first.len() <= 3 && !first.starts_with('0') && rest.iter().all(|g| g.len() == 3);
    match rest {
        _ if decimals.contains([mark, decimal]) => None,
        [] => Some(text.replace(decimal, ".")),
        _ if grouped => thousands.map(|_| format!("{}.{decimals}", groups.concat())),
        [part] if decimals.is_empty() => {
            let fraction = thousands.is_none() || part.len() < 3 || *first == "0";
            fraction.then(|| format!("{first}.{part}"))
        }
        _ => None,
    }
}

/// A number that may follow must be smaller than the last place of the one before: 10 after a
/// hundred's hundreds, 1 after a ten's tens.
fn last_place(value: f64) -> f64 {
    if value >= 100.0 && value % 100.0 == 0.0 {
        100.0
    } else if value >= 20.0 && value % 10.0 == 0.0 {
        10.0
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn marks_group_digits_or_stand_before_decimals() {
        let english = |text| plain(text, Some(',')).and_then(|t| t.parse::<f64>().ok());
        for (text, value) in [
            ("1000", Some(1000.0)),
            ("1,000", Some(1000.0)),
            ("12,345", Some(12345.0)),
            ("1,000,000", Some(1e6)),
            ("1,250.5", Some(1250.5)),
            ("1.250", Some(1.25)),
            ("1,5", Some(1.5)),
            ("1,25", Some(1.25)),
            ("0,125", Some(0.125)),
            ("1,0000", None),
            ("1,00,000", None),
            ("1.250,5", None),
            ("1.2.3", None),
        ] {
            assert_eq!(english(text), value, "{text}");
        }
        let czech = |text| plain(text, None).and_then(|t| t.parse::<f64>().ok());
        for (text, value) in [
            ("1,000", Some(1.0)),
            ("12,345", Some(12.345)),
            ("1.5", Some(1.5)),
            ("0.125", Some(0.125)),
            ("1.000", None),
            ("1.000,5", None),
            ("1,000,5", None),
        ] {
            assert_eq!(czech(text), value, "{text}");
        }
    }
}
