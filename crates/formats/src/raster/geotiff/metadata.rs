//! Names and values, in the XML that GDAL keeps in a tag of its own (42112).

use crate::raster::Unit;

/// The document, with what the band's numbers are.
///
/// Values are escaped twice and names once: GDAL writes them so, and unescapes them as often (seen
/// with GDAL 3.10); a value that is escaped once ends at its first ampersand.
pub(super) fn to_xml(unit: Unit, metadata: &[(String, String)]) -> String {
    let mut xml = String::from("<GDALMetadata>\n");
    for (name, value) in metadata {
        let (name, value) = (escaped(name), escaped(&escaped(value)));
        xml += &format!("  <Item name=\"{name}\">{value}</Item>\n");
    }
    let of_the_band = [
        ("DESCRIPTION", "description", "time in shadow"),
        ("UNITTYPE", "unittype", unit.symbol()),
    ];
    for (name, role, value) in of_the_band {
        xml += &format!("  <Item name=\"{name}\" sample=\"0\" role=\"{role}\">{value}</Item>\n");
    }
    xml + "</GDALMetadata>"
}

/// Characters that mean something to XML as references, those that a reader would change as well,
/// and those that no XML document can hold (XML 1.0, section 2.2) as U+FFFD.
fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => xml.push_str("&amp;"),
            '<' => xml.push_str("&lt;"),
            '>' => xml.push_str("&gt;"),
            '"' => xml.push_str("&quot;"),
            '\t' => xml.push_str("&#9;"),
            '\n' => xml.push_str("&#10;"),
            '\r' => xml.push_str("&#13;"),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => xml.push('\u{fffd}'),
            c => xml.push(c),
        }
    }
    xml
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_value_breaks_out_of_its_item() {
        let entry = ("a\"<b".to_owned(), "x</Item>&\u{0}\u{1b}\r\né".to_owned());
        let xml = to_xml(Unit::Hours, &[entry]);
        let expected = "<Item name=\"a&quot;&lt;b\">x&amp;lt;/Item&amp;gt;&amp;amp;\u{fffd}\u{fffd}\
                        &amp;#13;&amp;#10;é</Item>";
        assert!(xml.contains(expected), "{xml}");
        assert!(xml.contains("role=\"unittype\">h</Item>"), "{xml}");
        assert_eq!(xml.matches("<Item").count(), 3);
    }
}
