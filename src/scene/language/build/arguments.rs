//! The arguments of a call, matched with the parameters of its word and checked against what they take.

use super::colors;
use super::lost::Lost;
use crate::math::DVec3;
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::language::nearest::{nearest, quoted};
use crate::scene::language::syntax::{Argument, Call, Spanned, TextSpan, Value};
use crate::scene::language::vocabulary::{FRAGMENT_SETTINGS, Meaning, Parameter, Takes, Word};
use crate::scene::profile::Fragments;

/// The arguments of one call, each at its parameter.
pub struct BoundArguments<'c, 'a> {
    word: &'static Word,
    call: &'c Call<'a>,
    /// One place for each parameter; `undef` counts as not given.
    values: Vec<Option<&'c Spanned<'a>>>,
    /// `$fn`, `$fa` and `$fs`, where they are given.
    settings: [Option<f64>; 3],
}

impl<'c, 'a> BoundArguments<'c, 'a> {
    /// Matches names and positions. All mismatches are reported, not the first only.
    pub fn bind(call: &'c Call<'a>, word: &'static Word, sink: &mut Sink) -> Result<Self, Reported> {
        let mut bound = Self { word, call, values: vec![None; word.arguments.len()], settings: [None; 3] };
        let mut given = vec![false; word.arguments.len()];
        let mut result = Ok(());
        let mut keep = |outcome: Result<(), Reported>| {
            if outcome.is_err() {
                result = outcome;
            }
        };
        // As OpenSCAD does: values without names fill the parameters in order, past those already named.
        for argument in &call.arguments {
            match argument.name {
                Some(name) if name.text.starts_with('$') => keep(bound.setting(name.text, argument, sink)),
                _ => keep(bound.place(argument, &mut given, sink)),
            }
            if sink.is_full() {
                break;
            }
        }
        result.map(|()| bound)
    }

    fn setting(&mut self, name: &str, argument: &Argument<'a>, sink: &mut Sink) -> Result<(), Reported> {
        if sink.leaves_out() && !FRAGMENT_SETTINGS.contains(&name) {
            // OpenSCAD passes on every variable of this kind, and most programs have some of their own.
            return Ok(());
        }
        let number = setting(
            name,
            argument.name.map_or(argument.value.span, |name| name.span),
            &argument.value,
            sink,
        )?;
        if let Some(index) = FRAGMENT_SETTINGS.iter().position(|&setting| setting == name) {
            self.settings[index] = number.or(self.settings[index]);
        }
        Ok(())
    }

    /// Whether any of the three settings is given.
    pub fn has_settings(&self) -> bool {
        self.settings != [None; 3]
    }

    /// The settings, those that are not given as they are above.
    pub fn fragments(&self, above: Fragments) -> Fragments {
        let [number, angle, size] = self.settings;
        Fragments {
            number: number.unwrap_or(above.number),
            angle: angle.unwrap_or(above.angle),
            size: size.unwrap_or(above.size),
        }
    }

    fn place(
        &mut self,
        argument: &'c Argument<'a>,
        given: &mut [bool],
        sink: &mut Sink,
    ) -> Result<(), Reported> {
        let index = match argument.name {
            Some(name) => self.word.arguments.iter().position(|parameter| parameter.name == name.text),
            None => (0..given.len()).find(|&i| self.word.arguments[i].by_position && !given[i]),
        };
        let Some(index) = index else { return Err(sink.report(self.unplaced(argument))) };
        if given[index] {
            let parameter = self.word.arguments[index].name;
            let place = argument.name.map_or(argument.value.span, |name| name.span);
            let message = format!("`{parameter}` of `{}` is given twice", self.word.name);
            return Err(sink.report(Diagnostic::error(place, message).label("the second time")));
        }
        given[index] = true;
        if !matches!(argument.value.value, Value::Undef) {
            self.values[index] = Some(&argument.value);
        }
        Ok(())
    }

    fn unplaced(&self, argument: &Argument<'_>) -> Diagnostic {
        let names: Vec<_> = self.word.arguments.iter().map(|parameter| parameter.name).collect();
        let takes = match names.as_slice() {
            [] => format!("`{}` takes no arguments", self.word.name),
            _ => format!("`{}` takes {}", self.word.name, names.join(", ")),
        };
        let Some(name) = argument.name else {
            let message = format!("one argument too many for `{}`", self.word.name);
            return Diagnostic::error(argument.value.span, message).help(takes);
        };
        let message = format!("`{}` has no argument `{}`", self.word.name, quoted(name.text));
        match nearest(name.text, names) {
            Some(right) => Diagnostic::error(name.span, message).help(format!("did you mean `{right}`?")),
            None => Diagnostic::error(name.span, message).help(takes),
        }
    }

    /// The word of the call.
    pub fn word(&self) -> &'static Word {
        self.word
    }

    fn get(&self, name: &str) -> Option<(&'static Parameter, &'c Spanned<'a>)> {
        let index = self.word.arguments.iter().position(|parameter| parameter.name == name)?;
        Some((&self.word.arguments[index], self.values[index]?))
    }

    /// The first argument given that is none of `names`.
    pub fn other_than(&self, names: &[&str]) -> Option<(&'static str, TextSpan)> {
        let mut given = self.word.arguments.iter().zip(&self.values);
        given.find_map(|(parameter, value)| match value {
            Some(value) if !names.contains(&parameter.name) => Some((parameter.name, value.span)),
            _ => None,
        })
    }

    /// The value of an argument as it is written.
    pub fn value(&self, name: &str) -> Option<&'c Spanned<'a>> {
        self.get(name).map(|(_, value)| value)
    }

    /// The place of an argument, or of the word where it is not given.
    pub fn place_of(&self, name: &str) -> TextSpan {
        self.value(name).map_or(self.call.name.span, |value| value.span)
    }

    /// The error of an argument that must be given.
    pub fn missing(&self, name: &str, sink: &mut Sink) -> Lost {
        let parameter = self.word.arguments.iter().find(|parameter| parameter.name == name);
        let takes = parameter.map_or("", |parameter| parameter.takes.describe());
        let message = format!("`{}` needs `{name}`", self.word.name);
        let error = Diagnostic::error(self.call.name.span.to(self.call.parentheses), message);
        self.refuse(error.help(format!("give it: {name} = {takes}")), Lost::Empty, sink)
    }

    /// An error of the call; where wrong parts are left out, a note that a primitive, or what a map holds, is
    /// `lost`.
    pub fn refuse(&self, error: Diagnostic, lost: Lost, sink: &mut Sink) -> Lost {
        refuse(self.word, error, lost, sink)
    }

    fn wrong(&self, parameter: &Parameter, value: &Spanned<'_>, sink: &mut Sink) -> Lost {
        let takes = parameter.takes;
        let message = format!("`{}` of `{}` takes {}", parameter.name, self.word.name, takes.describe());
        // Of a list with one number out of range, that number is what is wrong.
        let out_of_range = |item: &&Spanned<'_>| match item.value {
            Value::Number(number) => !in_range(number, takes),
            _ => false,
        };
        let wrong = match &value.value {
            Value::List(items) => items.iter().find(out_of_range).unwrap_or(value),
            _ => value,
        };
        let error =
            Diagnostic::error(wrong.span, message).label(format!("this is {}", wrong.value.describe()));
        match wrong.value {
            Value::Number(number) if takes == Takes::Color && number > 1.0 => {
                self.refuse(error.help("of 0 to 255 take the 255th part"), Lost::Missing, sink)
            }
            // A size of nothing makes nothing; what a text makes in place of a size nobody knows.
            Value::Number(_) => self.refuse(error, Lost::Empty, sink),
            _ => self.refuse(error, Lost::Missing, sink),
        }
    }

    /// A number, in the range that the parameter takes.
    pub fn number(&self, name: &str, sink: &mut Sink) -> Result<Option<f64>, Lost> {
        let Some((parameter, value)) = self.get(name) else { return Ok(None) };
        match value.value {
            Value::Number(number) if self.is_clamped(parameter, &[number], value, sink) => {
                Ok(Some(clamped(number)))
            }
            Value::Number(number) if in_range(number, parameter.takes) => Ok(Some(number)),
            _ => Err(self.wrong(parameter, value, sink)),
        }
    }

    /// Whether numbers that are no colour are taken as the nearest that is one, which is said: where wrong
    /// parts are left out, a part is not left out for its colour.
    fn is_clamped(
        &self,
        parameter: &Parameter,
        numbers: &[f64],
        value: &Spanned<'_>,
        sink: &mut Sink,
    ) -> bool {
        let is_color = parameter.takes == Takes::Color || self.word.meaning == Meaning::Color;
        let is_wrong = numbers.iter().any(|&number| !in_range(number, parameter.takes));
        if !(is_color && is_wrong && sink.leaves_out()) {
            return false;
        }
        let message = format!("a colour of `{}` is clamped to the range from 0 to 1", self.word.name);
        sink.note(Diagnostic::note(value.span, message));
        true
    }

    /// `true` or `false`; false where not given.
    pub fn flag(&self, name: &str, sink: &mut Sink) -> Result<bool, Lost> {
        match self.get(name) {
            None => Ok(false),
            Some((_, Spanned { value: Value::Flag(flag), .. })) => Ok(*flag),
            Some((parameter, value)) => Err(self.wrong(parameter, value, sink)),
        }
    }

    /// Three flags; one stands for all of them, and those that are not given are false.
    pub fn flags(&self, name: &str, sink: &mut Sink) -> Result<[bool; 3], Lost> {
        let Some((parameter, value)) = self.get(name) else { return Ok([false; 3]) };
        let flag = |item: &Spanned<'_>| match item.value {
            Value::Flag(flag) => Some(flag),
            // OpenSCAD writes flags as numbers here.
            Value::Number(number) => Some(number != 0.0),
            _ => None,
        };
        let flags = match &value.value {
            Value::List(items) if items.len() <= 3 => items.iter().map(flag).collect::<Option<Vec<_>>>(),
            _ => flag(value).map(|flag| vec![flag; 3]),
        };
        let Some(flags) = flags else { return Err(self.wrong(parameter, value, sink)) };
        Ok([0, 1, 2].map(|axis| flags.get(axis).copied().unwrap_or(false)))
    }

    /// A text that is not empty.
    pub fn text(&self, name: &str, sink: &mut Sink) -> Result<Option<&'c str>, Lost> {
        match self.get(name) {
            None => Ok(None),
            Some((_, Spanned { value: Value::Text(text), .. })) if !text.is_empty() => Ok(Some(text)),
            Some((parameter, value)) => Err(self.wrong(parameter, value, sink)),
        }
    }

    /// A text that may be empty.
    pub fn any_text(&self, name: &str, sink: &mut Sink) -> Result<Option<&'c str>, Lost> {
        match self.get(name) {
            None => Ok(None),
            Some((_, Spanned { value: Value::Text(text), .. })) => Ok(Some(text)),
            Some((parameter, value)) => Err(self.wrong(parameter, value, sink)),
        }
    }

    /// A point, or what the parameter takes in place of one: a number stands for three equal ones, two
    /// numbers for three whose last is `rest`.
    pub fn triple(&self, name: &str, rest: f64, sink: &mut Sink) -> Result<Option<DVec3>, Lost> {
        let Some((parameter, value)) = self.get(name) else { return Ok(None) };
        let takes = parameter.takes;
        let triple = match &value.value {
            Value::Number(number) if matches!(takes, Takes::FlatSize | Takes::FlatFactor) => {
                Some(DVec3::new(*number, *number, rest))
            }
            Value::Number(number) if matches!(takes, Takes::Size | Takes::Factor | Takes::Glow) => {
                Some(DVec3::splat(*number))
            }
            other => match numbers(other).as_deref() {
                Some(&[x, y]) if takes.is_flat() => Some(DVec3::new(x, y, rest)),
                Some(&[x, y, z]) if !matches!(takes, Takes::FlatSize | Takes::FlatFactor) => {
                    Some(DVec3::new(x, y, z))
                }
                _ => None,
            },
        };
        match triple {
            Some(triple) if triple.to_array().iter().all(|&number| in_range(number, takes)) => {
                Ok(Some(triple))
            }
            _ => Err(self.wrong(parameter, value, sink)),
        }
    }

    /// Two angles inside `0 < angle < 180`.
    pub fn field(&self, name: &str, sink: &mut Sink) -> Result<Option<[f64; 2]>, Lost> {
        let Some((parameter, value)) = self.get(name) else { return Ok(None) };
        match numbers(&value.value).as_deref() {
            Some(&[across, down]) if [across, down].iter().all(|&angle| in_range(angle, Takes::Field)) => {
                Ok(Some([across, down]))
            }
            _ => Err(self.wrong(parameter, value, sink)),
        }
    }

    /// A colour in linear light, and its alpha where it names one.
    pub fn color(&self, name: &str, sink: &mut Sink) -> Result<Option<(DVec3, Option<f64>)>, Lost> {
        let Some((parameter, value)) = self.get(name) else { return Ok(None) };
        match &value.value {
            Value::Text(text) => match colors::by_name(text) {
                Some(color) => Ok(Some(color)),
                None => Err(sink.report(no_color(text, value.span)).into()),
            },
            other => match numbers(other).as_deref() {
                Some(rgb @ ([_, _, _] | [_, _, _, _]))
                    if rgb.iter().all(|&share| in_range(share, Takes::Color)) =>
                {
                    Ok(Some((DVec3::new(rgb[0], rgb[1], rgb[2]), rgb.get(3).copied())))
                }
                Some(rgb @ ([_, _, _] | [_, _, _, _])) if self.is_clamped(parameter, rgb, value, sink) => {
                    let color = DVec3::new(rgb[0], rgb[1], rgb[2]).to_array().map(clamped);
                    Ok(Some((DVec3::from_array(color), rgb.get(3).copied().map(clamped))))
                }
                _ => Err(self.wrong(parameter, value, sink)),
            },
        }
    }
}

/// An error of a call of a word; where wrong parts are left out, a note that it, or what it holds, is `lost`.
pub fn refuse(word: &Word, error: Diagnostic, lost: Lost, sink: &mut Sink) -> Lost {
    let name = word.name;
    let what = match word.meaning {
        Meaning::Solid(_) | Meaning::Figure(_) | Meaning::Form(_) | Meaning::Import if sink.leaves_out() => {
            format!("`{name}` is left out")
        }
        Meaning::Map(_) if sink.leaves_out() => format!("what `{name}` holds is left out"),
        _ => return sink.report(error).into(),
    };
    sink.note(Diagnostic::note(error.span, format!("{what}: {}", error.message)).label(error.label));
    lost
}

/// The nearest share of light; of what is no number, none.
fn clamped(number: f64) -> f64 {
    if number > 0.0 { number.min(1.0) } else { 0.0 }
}

fn no_color(name: &str, place: TextSpan) -> Diagnostic {
    let error = Diagnostic::error(place, format!("there is no colour \"{}\"", quoted(name)));
    error.help(match colors::nearest_name(name) {
        Some(right) => format!("did you mean \"{right}\"?"),
        None => "write a CSS colour's name, \"#rrggbb\", or [r, g, b] from 0 to 1".into(),
    })
}

/// `$fn`, `$fa` or `$fs`: a number, or `undef` for none.
pub fn setting(
    name: &str,
    place: TextSpan,
    value: &Spanned<'_>,
    sink: &mut Sink,
) -> Result<Option<f64>, Reported> {
    if !FRAGMENT_SETTINGS.contains(&name) {
        let error = Diagnostic::error(place, format!("there is no setting `{}`", quoted(name)));
        return Err(sink.report(match nearest(name, FRAGMENT_SETTINGS) {
            Some(right) => error.help(format!("did you mean `{right}`?")),
            None => error.help("the settings are $fn, $fa and $fs"),
        }));
    }
    match value.value {
        Value::Number(number) => Ok(Some(number)),
        Value::Undef => Ok(None),
        _ => {
            let error = Diagnostic::error(value.span, format!("`{name}` takes a number"));
            Err(sink.report(error.label(format!("this is {}", value.value.describe()))))
        }
    }
}

/// The numbers of a list of numbers.
pub fn numbers(value: &Value<'_>) -> Option<Vec<f64>> {
    let Value::List(items) = value else { return None };
    let number = |item: &Spanned<'_>| match item.value {
        Value::Number(number) => Some(number),
        _ => None,
    };
    items.iter().map(number).collect()
}

fn in_range(number: f64, takes: Takes) -> bool {
    let is_allowed = match takes {
        Takes::Positive | Takes::Size | Takes::FlatSize => number > 0.0,
        Takes::NotNegative | Takes::Glow | Takes::FlatFactor | Takes::NewSize => number >= 0.0,
        Takes::Share | Takes::Color => (0.0..=1.0).contains(&number),
        Takes::Field => 0.0 < number && number < 180.0,
        Takes::Factor => number != 0.0,
        _ => true,
    };
    is_allowed && number.is_finite()
}
