//! XML as files of models and drawings have it: elements and their text, with the place of each. Nothing is
//! expanded: entities of a document type are an error.

use std::borrow::Cow;
use std::ops::Range;

use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesEnd, BytesStart, Event};

/// Elements are nested no deeper: models have ten levels, drawings some dozens.
const DEEPEST: usize = 256;

/// What is wrong with a text.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum XmlFault {
    /// It is no XML.
    #[error("this is no XML: {0}")]
    NoXml(String),
    /// It has what is not read.
    #[error("{0}, which ray13 does not read")]
    Unsupported(String),
    /// It ends too soon.
    #[error("the file is cut off: it ends where {0} should be")]
    CutOff(String),
    /// Something else stands here.
    #[error("{0} is expected here")]
    Unexpected(String),
    /// A number that is none.
    #[error("{0} is no number")]
    NoNumber(String),
    /// A number that is infinite, or none.
    #[error("{0} is not a finite number")]
    NotFinite(String),
}

/// What is wrong with a text, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct XmlError {
    /// Bytes of the text; none where it is all of it.
    pub place: Option<Range<usize>>,
    /// What it is.
    pub fault: XmlFault,
}

impl XmlFault {
    fn at(self, place: Range<usize>) -> XmlError {
        XmlError { place: Some(place), fault: self }
    }
}

/// What comes next in a text.
#[derive(Clone, Debug)]
pub enum XmlEvent<'a> {
    /// An element begins.
    Open(XmlElement<'a>),
    /// The innermost element ends.
    Close(XmlEnd<'a>),
    /// Text without blanks around it.
    Text(Cow<'a, str>),
    /// The end of the text.
    End,
}

/// An element that begins.
#[derive(Clone, Debug)]
pub struct XmlElement<'a> {
    tag: BytesStart<'a>,
    /// Its place in the text.
    pub place: Range<usize>,
}

/// The end of an element.
#[derive(Clone, Debug)]
pub struct XmlEnd<'a>(BytesEnd<'a>);

/// The events of a text.
pub struct XmlText<'a> {
    reader: Reader<&'a [u8]>,
    depth: usize,
    /// The name of the outermost element, where that is known and it has not come yet.
    root: Option<&'static str>,
    /// Whether a document type is passed over.
    passes_doctype: bool,
    /// The place of the event before.
    pub place: Range<usize>,
}

impl<'a> XmlText<'a> {
    /// Those of a text.
    pub fn new(bytes: &'a [u8]) -> Result<Self, XmlError> {
        let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let at = error.valid_up_to();
            XmlFault::Unexpected("UTF-8 text".to_owned()).at(at..at + 1)
        })?;
        let mut reader = Reader::from_str(text);
        let config = reader.config_mut();
        config.expand_empty_elements = true;
        config.trim_text(true);
        Ok(Self { reader, depth: 0, root: None, passes_doctype: false, place: 0..0 })
    }

    /// Those of a text whose outermost element has this name; without it, it is an error.
    pub fn rooted(bytes: &'a [u8], root: &'static str) -> Result<Self, XmlError> {
        Ok(Self { root: Some(root), ..Self::new(bytes)? })
    }

    /// The same where a document type is passed over. What it defines is not known: where that is used, it is
    /// an error.
    #[must_use]
    pub fn passing_doctype(self) -> Self {
        Self { passes_doctype: true, ..self }
    }

    /// The next event.
    pub fn next(&mut self) -> Result<XmlEvent<'a>, XmlError> {
        loop {
            let start = self.reader.buffer_position() as usize;
            let event = self.reader.read_event().map_err(|error| {
                let at = self.reader.error_position() as usize;
                XmlFault::NoXml(error.to_string()).at(at..at + 1)
            })?;
            self.place = start..(self.reader.buffer_position() as usize).max(start + 1);
            match event {
                Event::Start(tag) => {
                    self.depth += 1;
                    if self.depth > DEEPEST {
                        let what = format!("elements are nested deeper than {DEEPEST}");
                        return Err(XmlFault::Unsupported(what).at(self.place.clone()));
                    }
                    let element = XmlElement { tag, place: self.place.clone() };
                    if let Some(root) = self.root.take().filter(|root| *root != element.name()) {
                        return Err(no_root(root).at(element.place));
                    }
                    return Ok(XmlEvent::Open(element));
                }
                Event::End(tag) => {
                    self.depth = self.depth.saturating_sub(1);
                    return Ok(XmlEvent::Close(XmlEnd(tag)));
                }
                Event::Text(text) => return Ok(XmlEvent::Text(text.xml_content(XmlVersion::Implicit1_0))),
                Event::CData(text) => return Ok(XmlEvent::Text(text.xml_content(XmlVersion::Implicit1_0))),
                Event::GeneralRef(name) => {
                    let character = name.resolve_char_ref().ok().flatten();
                    if let Some(character) = character {
                        return Ok(XmlEvent::Text(Cow::Owned(character.to_string())));
                    }
                    match resolve_predefined_entity(&name) {
                        Some(text) => return Ok(XmlEvent::Text(Cow::Borrowed(text))),
                        None => return Err(self.no_entity(&name)),
                    }
                }
                Event::DocType(_) if !self.passes_doctype => {
                    let what = "a document type, which may define entities".to_owned();
                    return Err(XmlFault::Unsupported(what).at(self.place.clone()));
                }
                // Empty elements come as a start and an end.
                Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::Empty(_) | Event::DocType(_) => {}
                Event::Eof if self.depth > 0 => {
                    return Err(XmlFault::CutOff("the end of an element".to_owned()).at(self.place.clone()));
                }
                Event::Eof => match self.root {
                    Some(root) => return Err(XmlError { place: None, fault: no_root(root) }),
                    None => return Ok(XmlEvent::End),
                },
            }
        }
    }

    fn no_entity(&self, name: &str) -> XmlError {
        XmlFault::Unsupported(format!("an entity `{name}`")).at(self.place.clone())
    }
}

fn no_root(name: &str) -> XmlFault {
    XmlFault::Unexpected(format!("an element `{name}`"))
}

impl XmlEnd<'_> {
    /// The name of the element, without a prefix.
    pub fn name(&self) -> &str {
        local(self.0.name().0)
    }
}

fn local(name: &str) -> &str {
    name.rsplit_once(':').map_or(name, |(_, local)| local)
}

impl XmlElement<'_> {
    /// Its name, without a prefix.
    pub fn name(&self) -> &str {
        local(self.tag.name().0)
    }

    /// The value of an attribute by its name without a prefix; the first of several.
    pub fn attribute(&self, name: &str) -> Result<Option<Cow<'_, str>>, XmlError> {
        let wrong = |why: &dyn std::fmt::Display| XmlFault::NoXml(why.to_string()).at(self.place.clone());
        for attribute in self.tag.attributes().with_checks(false) {
            let attribute = attribute.map_err(|error| wrong(&error))?;
            if attribute.key.local_name().as_ref() == name {
                let value =
                    attribute.normalized_value(XmlVersion::Implicit1_0).map_err(|error| wrong(&error))?;
                return Ok(Some(value));
            }
        }
        Ok(None)
    }

    /// The finite number that an attribute must be.
    pub fn number(&self, name: &str) -> Result<f64, XmlError> {
        number(&self.needed(name)?, name).map_err(|fault| fault.at(self.place.clone()))
    }

    /// The whole number that an attribute must be.
    pub fn index(&self, name: &str) -> Result<i64, XmlError> {
        index(&self.needed(name)?, name).map_err(|fault| fault.at(self.place.clone()))
    }

    fn needed(&self, name: &str) -> Result<Cow<'_, str>, XmlError> {
        let missing = || XmlFault::Unexpected(format!("an attribute `{name}`")).at(self.place.clone());
        self.attribute(name)?.ok_or_else(missing)
    }
}

/// The finite number that a word is.
pub fn number(word: &str, what: &str) -> Result<f64, XmlFault> {
    match word.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(XmlFault::NotFinite(format!("`{what}`"))),
        Err(_) => Err(XmlFault::NoNumber(format!("`{what}`"))),
    }
}

/// The whole number that a word is.
pub fn index(word: &str, what: &str) -> Result<i64, XmlFault> {
    word.trim().parse().map_err(|_| XmlFault::NoNumber(format!("`{what}`")))
}

/// The name of the outermost element of a text that begins as XML does; none of any other.
pub fn outermost(bytes: &[u8]) -> Option<String> {
    // So far reach a declaration and comments.
    let head = &bytes[..bytes.len().min(4096)];
    if !head.trim_ascii_start().starts_with(b"<") && !head.starts_with("\u{feff}".as_bytes()) {
        return None;
    }
    let whole = match std::str::from_utf8(head) {
        Ok(_) => head,
        Err(error) => &head[..error.valid_up_to()],
    };
    let mut text = XmlText::new(whole).ok()?;
    match text.next() {
        Ok(XmlEvent::Open(element)) => Some(element.name().to_owned()),
        _ => None,
    }
}
