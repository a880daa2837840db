//! Values of arguments: sizes, points, fields, each with the message for what it can not be.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use crate::frame::MOST_DOTS;
use crate::math::{DVec3, Size};
use crate::scene::{Digits, FacetMode, UpAxis};
use crate::view::TileShare;

use super::up::Up;

/// The most dots or cells along one side of a picture.
const MOST_ACROSS: u32 = 32_768;

/// A width and a height, as in `80x25`.
pub fn size(text: &str) -> Result<Size, String> {
    let [width, height] = pair::<u32>(text).ok_or("expected WIDTHxHEIGHT, as in 80x25")?;
    if width == 0 || height == 0 {
        return Err("width and height must be at least 1".into());
    }
    let size = Size::new(width, height);
    if width > MOST_ACROSS || height > MOST_ACROSS || size.area() > MOST_DOTS {
        return Err(format!("larger than {MOST_ACROSS} on a side, or {MOST_DOTS} in all"));
    }
    Ok(size)
}

/// A point or a direction, as in `1,2.5,-3`.
pub fn point(text: &str) -> Result<DVec3, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    let Some(&[x, y, z]) = numbers.as_deref() else { return Err("expected X,Y,Z, as in 0,-9,3".into()) };
    let point = DVec3::new(x, y, z);
    if point.is_finite() { Ok(point) } else { Err("coordinates must be finite".into()) }
}

/// One of the parts of a picture, as in `2/8`.
pub fn share(text: &str) -> Result<TileShare, String> {
    let numbers =
        text.split_once('/').and_then(|(k, n)| Some((k.trim().parse().ok()?, n.trim().parse().ok()?)));
    let (number, of) = numbers.ok_or("expected K/N, as in 2/8")?;
    TileShare::new(number, of).ok_or_else(|| "parts are counted from 1/N to N/N".into())
}

/// A folder that is there.
pub fn folder(text: &str) -> Result<PathBuf, String> {
    let folder = PathBuf::from(text);
    if folder.is_dir() { Ok(folder) } else { Err("there is no such folder".into()) }
}

/// How curved things are made.
pub fn facets(text: &str) -> Result<FacetMode, String> {
    let modes = [FacetMode::Smooth, FacetMode::OpenScad];
    modes.into_iter().find(|mode| mode.name() == text).ok_or_else(|| "expected smooth or openscad".into())
}

/// What the digits of a number say.
pub fn digits(text: &str) -> Result<Digits, String> {
    let all = [Digits::Exact, Digits::Six];
    all.into_iter().find(|digits| digits.name() == text).ok_or_else(|| "expected six or exact".into())
}

/// An axis of a mesh file.
pub fn up_axis(text: &str) -> Result<UpAxis, String> {
    match text {
        "y" | "Y" => Ok(UpAxis::Y),
        "z" | "Z" => Ok(UpAxis::Z),
        _ => Err("expected y or z".into()),
    }
}

/// A direction, or an axis of a mesh file.
pub fn up(text: &str) -> Result<Up, String> {
    if let Ok(axis) = up_axis(text) {
        return Ok(Up::Axis(axis));
    }
    point(text).map(Up::Direction).map_err(|error| format!("{error}; or y or z, the axis of a mesh file"))
}

/// A variable of a program and its value, as in `size=[1,2,3]`.
pub fn definition(text: &str) -> Result<String, String> {
    let is_name = |name: &str| {
        !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '$'))
    };
    match text.split_once('=') {
        Some((name, value)) if is_name(name.trim()) && !value.trim().is_empty() => Ok(text.to_owned()),
        _ => Err("expected NAME=VALUE, as in size=[1,2,3] or 'name=\"a text\"'".into()),
    }
}

/// Full angles across and down in degrees, as in `40x25`.
pub fn field(text: &str) -> Result<[f64; 2], String> {
    let angles = pair::<f64>(text).ok_or("expected ACROSSxDOWN in degrees, as in 40x25")?;
    if angles.iter().all(|&a| a > 0.0 && a < 180.0) {
        Ok(angles)
    } else {
        Err("each angle must be above 0 and below 180 degrees".into())
    }
}

/// Bytes, as in `500MiB`.
pub fn bytes(text: &str) -> Result<u64, String> {
    const UNITS: [(&str, u64); 7] = [
        ("KiB", 1 << 10),
        ("MiB", 1 << 20),
        ("GiB", 1 << 30),
        ("kB", 1_000),
        ("MB", 1_000_000),
        ("GB", 1_000_000_000),
        ("", 1),
    ];
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = UNITS.iter().find(|(name, _)| name.eq_ignore_ascii_case(&text[digits.len()..]));
    match (digits.trim().parse::<f64>(), unit) {
        (Ok(number), Some((_, unit))) if number > 0.0 && number.is_finite() => {
            Ok((number * *unit as f64) as u64)
        }
        _ => Err("expected a number of bytes above 0, or of KiB, MiB or GiB, as in 500MiB".into()),
    }
}

/// A time, as in `16ms` or `0.5s`.
pub fn duration(text: &str) -> Result<Duration, String> {
    const UNITS: [(&str, f64); 4] = [("us", 1e-6), ("µs", 1e-6), ("ms", 1e-3), ("s", 1.0)];
    let unit = UNITS.iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?, unit)));
    let seconds = unit.and_then(|(number, unit)| Some(number.trim().parse::<f64>().ok()? * unit));
    // A day is more than anyone waits for.
    let seconds = seconds.filter(|seconds| *seconds > 0.0 && *seconds <= 86_400.0);
    seconds.map(Duration::from_secs_f64).ok_or("expected a time with its unit, as in 16ms or 0.5s".into())
}

/// Seconds, 0 or more, up to a day.
pub fn seconds(text: &str) -> Result<Duration, String> {
    match text.parse::<f64>() {
        Ok(x) if (0.0..=86_400.0).contains(&x) => Ok(Duration::from_secs_f64(x)),
        _ => Err("expected seconds, 0 or more, up to a day's 86400".into()),
    }
}

/// A share of all in percent, as in `0.5%`; gives it as 0 to 1.
pub fn percent(text: &str) -> Result<f64, String> {
    match text.trim_end_matches('%').trim().parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 100.0 => Ok(x / 100.0),
        _ => Err("expected a share above 0% and up to 100%, as in 0.5%".into()),
    }
}

/// Rays a dot: a power of two, 2 to 65536.
pub fn rays(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(x) if x.is_power_of_two() && (2..=65_536).contains(&x) => Ok(x),
        _ => Err("expected a power of two, 2 to 65536".into()),
    }
}

/// A number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("expected a finite number above 0".into()),
    }
}

/// A number of 0 or more.
pub fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x >= 0.0 && x.is_finite() => Ok(x),
        _ => Err("expected a finite number, 0 or more".into()),
    }
}

/// A number above 0.
pub fn above_zero(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("expected a finite number above 0".into()),
    }
}

fn pair<T: FromStr>(text: &str) -> Option<[T; 2]> {
    let (a, b) = text.split_once(['x', '×'])?;
    Some([a.trim().parse().ok()?, b.trim().parse().ok()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_people_write() {
        assert_eq!(size("80x25"), Ok(Size::new(80, 25)));
        assert_eq!(point("0, -9,3e1"), Ok(DVec3::new(0.0, -9.0, 30.0)));
        assert_eq!(field("40x25"), Ok([40.0, 25.0]));
        assert_eq!(
            ["500MiB", "1.5 GiB", "2gb", "4096"].map(bytes),
            [524_288_000, 1_610_612_736, 2_000_000_000, 4096].map(Ok)
        );
    }

    #[test]
    fn times_and_shares_have_units() {
        let ms = |ms: u64| Ok(Duration::from_millis(ms));
        assert_eq!(["16ms", "0.5s", "2000us", "1 s"].map(duration), [ms(16), ms(500), ms(2), ms(1000)]);
        assert_eq!(["0.5%", "100", "2 %"].map(percent), [Ok(0.005), Ok(1.0), Ok(0.02)]);
        assert_eq!(["2", "256"].map(rays), [Ok(2), Ok(256)]);
        assert_eq!(["0", "1.5"].map(seconds), [ms(0), ms(1500)]);
        for text in ["", "16", "0ms", "-1s", "nan s", "1e9s", "ms"] {
            assert!(duration(text).is_err(), "{text}");
        }
        for text in ["", "%", "0%", "101%", "nan%", "-1"] {
            assert!(percent(text).is_err() && rays(text).is_err(), "{text}");
        }
        for text in ["", "-1", "nan", "1e6"] {
            assert!(seconds(text).is_err(), "{text}");
        }
    }

    #[test]
    fn refuses_the_rest() {
        for text in ["", "80", "80x", "x25", "0x25", "-3x5", "99999x99999", "32768x32768"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "a,b,c"] {
            assert!(point(text).is_err(), "{text}");
        }
        for text in ["", "0", "-1MiB", "MiB", "1TB", "nan", "1e999"] {
            assert!(bytes(text).is_err(), "{text}");
        }
        for text in ["180x40", "0x40", "40", "nanx40"] {
            assert!(field(text).is_err(), "{text}");
        }
    }
}
