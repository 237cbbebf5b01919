//! OpenStreetMap XML (<https://wiki.openstreetmap.org/wiki/OSM_XML>).

use std::borrow::Cow;

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::element::{Element, Kind, Member, Tag, Visit};
use crate::error::{Fault, FormatError, Place, one_line, quoted};

/// Whether the first element is `osm`.
pub(super) fn is_osm(bytes: &[u8]) -> bool {
    // What comes before it is short.
    const MOST: usize = 4096;
    let head = &bytes[..bytes.len().min(MOST)];
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    if !head.trim_ascii_start().starts_with(b"<") {
        return false;
    }
    let head = String::from_utf8_lossy(head);
    let mut reader = Reader::from_str(&head);
    loop {
        match reader.read_event() {
            Ok(Event::Start(element) | Event::Empty(element)) => {
                return element.name().as_ref() == "osm";
            }
            Ok(Event::Eof) | Err(_) => return false,
            Ok(_) => {}
        }
    }
}

/// Visits all elements of a kind, those left out that are marked as deleted.
pub(super) fn each(bytes: &[u8], kind: Kind, visit: Visit<'_>) -> Result<(), FormatError> {
    let text = str::from_utf8(bytes)
        .map_err(|error| broken(error.valid_up_to() as u64, "text is not UTF-8"))?;
    let mut reader = Reader::from_str(text);
    let mut depth = 0_usize;
    let mut open = None;
    loop {
        let at = reader.buffer_position();
        match reader.read_event() {
            Ok(Event::Start(element)) => {
                depth += 1;
                begin(&mut open, &element, kind).map_err(|what| broken(at, &what))?;
            }
            Ok(Event::Empty(element)) => {
                begin(&mut open, &element, kind).map_err(|what| broken(at, &what))?;
                end(&mut open, element.name().as_ref(), visit)
                    .map_err(|error| error.at(Place::Byte(at)))?;
            }
            Ok(Event::End(element)) => {
                depth = depth.saturating_sub(1);
                end(&mut open, element.name().as_ref(), visit)
                    .map_err(|error| error.at(Place::Byte(at)))?;
            }
            Ok(Event::Eof) if depth > 0 => {
                return Err(broken(at, "the file is cut short: </osm> is missing"));
            }
            Ok(Event::Eof) => return Ok(()),
            Ok(_) => {}
            Err(error) => return Err(broken(reader.error_position(), &error.to_string())),
        }
    }
}

/// The node, way or relation that what is read lies in.
struct Open<'a> {
    kind: Kind,
    id: i64,
    place: Option<[f64; 2]>,
    is_deleted: bool,
    nodes: Vec<i64>,
    members: Vec<Member>,
    tags: Vec<Tag<'a>>,
}

fn kind_of(name: &str) -> Option<Kind> {
    match name {
        "node" => Some(Kind::Node),
        "way" => Some(Kind::Way),
        "relation" => Some(Kind::Relation),
        _ => None,
    }
}

fn begin<'a>(
    open: &mut Option<Open<'a>>,
    element: &BytesStart<'a>,
    wanted: Kind,
) -> Result<(), String> {
    let name = element.name();
    let name = name.as_ref();
    if let Some(kind) = kind_of(name) {
        if kind != wanted {
            return Ok(());
        }
        let [id, latitude, longitude, action, visible] =
            attributes(element, ["id", "lat", "lon", "action", "visible"])?;
        let degrees = |text: Option<Cow<'_, str>>| text?.trim().parse().ok();
        let place = degrees(longitude).zip(degrees(latitude));
        *open = Some(Open {
            kind,
            id: number(id, "id")?,
            place: place.map(|(longitude, latitude)| [longitude, latitude]),
            is_deleted: action.is_some_and(|a| a == "delete")
                || visible.is_some_and(|v| v == "false"),
            nodes: Vec::new(),
            members: Vec::new(),
            tags: Vec::new(),
        });
        return Ok(());
    }
    let Some(open) = open else { return Ok(()) };
    match name {
        "nd" => {
            let [node] = attributes(element, ["ref"])?;
            open.nodes.push(number(node, "ref")?);
        }
        "member" => {
            let [kind, id, role] = attributes(element, ["type", "ref", "role"])?;
            if let Some(kind) = kind.and_then(|kind| kind_of(&kind)) {
                open.members.push(Member {
                    kind,
                    id: number(id, "ref")?,
                    is_inner: role.is_some_and(|role| role == "inner"),
                });
            }
        }
        "tag" => {
            if let [Some(key), Some(value)] = attributes(element, ["k", "v"])? {
                open.tags.push((key, value));
            }
        }
        _ => {}
    }
    Ok(())
}

fn end(open: &mut Option<Open<'_>>, name: &str, visit: Visit<'_>) -> Result<(), FormatError> {
    let Some(open) = open.take_if(|open| Some(open.kind) == kind_of(name)) else {
        return Ok(());
    };
    if open.is_deleted {
        return Ok(());
    }
    let (id, tags) = (open.id, &open.tags[..]);
    match (open.kind, open.place) {
        (Kind::Node, Some(place)) => visit(Element::Node { id, place }),
        // A node that is nowhere is not there.
        (Kind::Node, None) => Ok(()),
        (Kind::Way, _) => visit(Element::Way {
            id,
            nodes: &open.nodes,
            tags,
        }),
        (Kind::Relation, _) => visit(Element::Relation {
            id,
            members: &open.members,
            tags,
        }),
    }
}

/// The values of some attributes, the first of each name.
fn attributes<'a, const N: usize>(
    element: &BytesStart<'a>,
    names: [&str; N],
) -> Result<[Option<Cow<'a, str>>; N], String> {
    let mut found = [const { None }; N];
    let mut attributes = element.attributes();
    // To look for names that repeat takes the square of their number.
    for attribute in attributes.with_checks(false) {
        let attribute = attribute.map_err(|error| error.to_string())?;
        let index = names
            .iter()
            .position(|name| attribute.key.as_ref() == *name);
        if let Some(index) = index
            && found[index].is_none()
        {
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            let value = value.map_err(|error| error.to_string())?;
            found[index] = Some(Cow::Owned(value.into_owned()));
        }
    }
    Ok(found)
}

fn number(text: Option<Cow<'_, str>>, name: &str) -> Result<i64, String> {
    let text = text.ok_or_else(|| format!("{name} is missing"))?;
    let number = text.trim().parse();
    number.map_err(|_| {
        format!(
            "{name} is {}, which is no whole number",
            quoted(text.as_bytes())
        )
    })
}

fn broken(at: u64, what: &str) -> FormatError {
    let fault = Fault::InDocument {
        place: "XML".to_owned(),
        message: one_line(what),
    };
    FormatError::new(Place::Byte(at), fault)
}
