//! Names and values, in the XML that GDAL keeps in a tag of its own (42112).

use super::Band;

/// The document, with what the numbers of the bands are.
///
/// Values are escaped twice and names once: GDAL writes them so, and unescapes them as often (seen
/// with GDAL 3.10); a value that is escaped once ends at its first ampersand.
pub(super) fn to_xml(bands: &[Band<'_>], metadata: &[(String, String)]) -> String {
    let mut xml = String::from("<GDALMetadata>\n");
    for (name, value) in metadata {
        let (name, value) = (escaped(name), escaped(&escaped(value)));
        xml += &format!("  <Item name=\"{name}\">{value}</Item>\n");
    }
    for (sample, band) in bands.iter().enumerate() {
        let of_the_band = [
            ("DESCRIPTION", "description", escaped(&escaped(band.name))),
            (
                "UNITTYPE",
                "unittype",
                band.raster.unit().symbol().to_owned(),
            ),
        ];
        for (name, role, value) in of_the_band {
            xml += &format!(
                "  <Item name=\"{name}\" sample=\"{sample}\" role=\"{role}\">{value}</Item>\n"
            );
        }
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
    use ombra_city::{Crs, Grid, Origin};

    use super::*;
    use crate::raster::{Raster, Unit};

    #[test]
    fn no_value_breaks_out_of_its_item() {
        let entry = ("a\"<b".to_owned(), "x</Item>&\u{0}\u{1b}\r\né".to_owned());
        let origin = Origin::new(Crs::wgs84(), [4.36, 52.01]).unwrap();
        let grid = Grid {
            corner: [0.0, 0.0],
            cell: 1.0,
            width: 1,
            height: 1,
        };
        let raster = Raster::new(&origin, grid, Unit::Hours, &[1.0]).unwrap();
        let name = "time in shadow";
        let xml = to_xml(&[Band { name, raster }], &[entry]);
        let expected = "<Item name=\"a&quot;&lt;b\">x&amp;lt;/Item&amp;gt;&amp;amp;\u{fffd}\u{fffd}\
                        &amp;#13;&amp;#10;é</Item>";
        assert!(xml.contains(expected), "{xml}");
        assert!(xml.contains("role=\"unittype\">h</Item>"), "{xml}");
        assert_eq!(xml.matches("<Item").count(), 3);
    }
}
