//! Maps in both of their formats.

use ombra_city::City;
use ombra_city::heights::Heights;

use super::super::tests::{findings, tops};
use super::super::{CityOptions, read_city_bytes};

/// A court, a tower of two parts, a shed with no height, and what is broken: degrees are such that
/// 0.0001 is 11 m.
pub(in super::super) const OSM: &str = r#"<?xml version='1.0' encoding='UTF-8'?>
<osm version="0.6" generator="by hand">
 <bounds minlat="0" minlon="0" maxlat="1" maxlon="1"/>
 <node id="1" lat="0" lon="0"/><node id="2" lat="0" lon="0.0004"/>
 <node id="3" lat="0.0004" lon="0.0004"/><node id="4" lat="0.0004" lon="0"/>
 <node id="5" lat="0.0001" lon="0.0001"/><node id="6" lat="0.0001" lon="0.0003"/>
 <node id="7" lat="0.0003" lon="0.0003"/><node id="8" lat="0.0003" lon="0.0001"/>
 <node id="11" lat="0" lon="0.001"/><node id="12" lat="0" lon="0.0012"/>
 <node id="13" lat="0" lon="0.0014"/><node id="14" lat="0.0004" lon="0.0014"/>
 <node id="15" lat="0.0004" lon="0.0012"/><node id="16" lat="0.0004" lon="0.001"/>
 <node id="17" lat="5" lon="5"><tag k="place" v="far"/></node>
 <node id="18" lat="5.001" lon="5"/><node id="19" lat="5" lon="5.001"/>
 <way id="100"><nd ref="1"/><nd ref="2"/><nd ref="3"/></way>
 <way id="101"><nd ref="1"/><nd ref="4"/><nd ref="3"/></way>
 <way id="102"><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="8"/><nd ref="5"/></way>
 <way id="110"><nd ref="11"/><nd ref="13"/><nd ref="14"/><nd ref="16"/><nd ref="11"/>
  <tag k="building" v="yes"/><tag k="building:levels" v="20"/><tag k="name" v="A &amp; B"/></way>
 <way id="111"><nd ref="11"/><nd ref="12"/><nd ref="15"/><nd ref="16"/><nd ref="11"/>
  <tag k="building:part" v="yes"/><tag k="building:levels" v="3"/><tag k="roof:levels" v="1"/></way>
 <way id="112"><nd ref="12"/><nd ref="13"/><nd ref="14"/><nd ref="15"/><nd ref="12"/>
  <tag k="building:part" v="yes"/><tag k="height" v="60 m"/><tag k="min_height" v="6"/></way>
 <way id="120"><nd ref="1"/><nd ref="11"/><nd ref="16"/><nd ref="1"/><tag k="building" v="shed"/></way>
 <way id="121"><nd ref="1"/><nd ref="99"/><nd ref="16"/><nd ref="1"/>
  <tag k="building" v="yes"/><tag k="height" v="9"/></way>
 <way id="122"><nd ref="1"/><nd ref="11"/><nd ref="16"/>
  <tag k="building" v="yes"/><tag k="height" v="9"/></way>
 <way id="123"><nd ref="17"/><nd ref="18"/><nd ref="19"/><nd ref="17"/>
  <tag k="building" v="yes"/><tag k="height" v="9"/></way>
 <way id="124"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/>
  <tag k="building" v="no"/><tag k="height" v="9"/></way>
 <relation id="200"><member type="way" ref="100" role="outer"/><member type="way" ref="102" role="inner"/>
  <member type="way" ref="101" role=""/><member type="node" ref="5" role="entrance"/>
  <tag k="type" v="multipolygon"/><tag k="building" v="yes"/><tag k="height" v="12"/></relation>
 <relation id="201"><member type="relation" ref="201" role="outer"/><member type="way" ref="999" role="outer"/>
  <tag k="type" v="multipolygon"/><tag k="building" v="yes"/><tag k="height" v="12"/></relation>
</osm>
"#;

/// The same map as PBF, its blobs not packed, or packed.
pub(in super::super) fn pbf(xml: &str, is_packed: bool) -> Vec<u8> {
    use super::element::{Element, Kind};

    let mut strings: Vec<String> = vec![String::new()];
    let mut index = |text: &str| {
        let found = strings.iter().position(|known| known == text);
        found.unwrap_or_else(|| {
            strings.push(text.to_owned());
            strings.len() - 1
        }) as u64
    };
    let zigzag = |number: i64| ((number << 1) ^ (number >> 63)) as u64;
    let deltas = |numbers: &[i64]| {
        let mut last = 0;
        let mut bytes = Vec::new();
        for &number in numbers {
            varint(&mut bytes, zigzag(number - last));
            last = number;
        }
        bytes
    };
    let row = |numbers: &[u64]| {
        let mut bytes = Vec::new();
        numbers
            .iter()
            .for_each(|&number| varint(&mut bytes, number));
        bytes
    };
    let mut group = Vec::new();
    let [mut ids, mut longitudes, mut latitudes] = [vec![], vec![], vec![]];
    for kind in [Kind::Node, Kind::Way, Kind::Relation] {
        let mut element = |element: Element<'_>| {
            let mut message = Vec::new();
            match element {
                Element::Node { id, place } => {
                    let [x, y] = place.map(|degrees| (degrees * 1e7).round() as i64);
                    // The last one is not among the dense ones.
                    if id == 19 {
                        number(&mut message, 1, zigzag(id));
                        number(&mut message, 8, zigzag(y));
                        number(&mut message, 9, zigzag(x));
                        field(&mut group, 1, &message);
                    } else {
                        ids.push(id);
                        longitudes.push(x);
                        latitudes.push(y);
                    }
                }
                Element::Way { id, nodes, tags } => {
                    number(&mut message, 1, id as u64);
                    let keys: Vec<u64> = tags.iter().map(|tag| index(&tag.0)).collect();
                    let values: Vec<u64> = tags.iter().map(|tag| index(&tag.1)).collect();
                    field(&mut message, 2, &row(&keys));
                    field(&mut message, 3, &row(&values));
                    field(&mut message, 8, &deltas(nodes));
                    field(&mut group, 3, &message);
                }
                Element::Relation { id, members, tags } => {
                    number(&mut message, 1, id as u64);
                    let keys: Vec<u64> = tags.iter().map(|tag| index(&tag.0)).collect();
                    let values: Vec<u64> = tags.iter().map(|tag| index(&tag.1)).collect();
                    field(&mut message, 2, &row(&keys));
                    field(&mut message, 3, &row(&values));
                    let role = |is_inner| if is_inner { "inner" } else { "outer" };
                    let roles: Vec<u64> = members.iter().map(|m| index(role(m.is_inner))).collect();
                    let ids: Vec<i64> = members.iter().map(|m| m.id).collect();
                    let kinds: Vec<u64> = members.iter().map(|m| m.kind as u64).collect();
                    field(&mut message, 8, &row(&roles));
                    field(&mut message, 9, &deltas(&ids));
                    field(&mut message, 10, &row(&kinds));
                    field(&mut group, 4, &message);
                }
            }
            Ok(())
        };
        super::xml::each(xml.as_bytes(), kind, &mut element).unwrap();
    }
    let mut dense = Vec::new();
    field(&mut dense, 1, &deltas(&ids));
    field(&mut dense, 8, &deltas(&latitudes));
    field(&mut dense, 9, &deltas(&longitudes));
    field(&mut group, 2, &dense);
    let mut table = Vec::new();
    strings
        .iter()
        .for_each(|text| field(&mut table, 1, text.as_bytes()));
    let mut block = Vec::new();
    field(&mut block, 1, &table);
    field(&mut block, 2, &group);
    let mut header = Vec::new();
    field(&mut header, 4, b"OsmSchema-V0.6");
    field(&mut header, 4, b"DenseNodes");
    let mut file = blob("OSMHeader", &header, is_packed);
    file.extend(blob("OSMData", &block, is_packed));
    file
}

pub(in super::super) fn blob(kind: &str, content: &[u8], is_packed: bool) -> Vec<u8> {
    let mut data = Vec::new();
    if is_packed {
        let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
        std::io::Write::write_all(&mut packed, content).unwrap();
        number(&mut data, 2, content.len() as u64);
        field(&mut data, 3, &packed.finish().unwrap());
    } else {
        field(&mut data, 1, content);
    }
    let mut header = Vec::new();
    field(&mut header, 1, kind.as_bytes());
    number(&mut header, 3, data.len() as u64);
    let mut file = (header.len() as u32).to_be_bytes().to_vec();
    file.extend(header);
    file.extend(data);
    file
}

fn varint(bytes: &mut Vec<u8>, mut number: u64) {
    while number >= 0x80 {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}

fn number(bytes: &mut Vec<u8>, field: u64, number: u64) {
    varint(bytes, field << 3);
    varint(bytes, number);
}

fn field(bytes: &mut Vec<u8>, field: u64, content: &[u8]) {
    varint(bytes, field << 3 | 2);
    varint(bytes, content.len() as u64);
    bytes.extend(content);
}

fn read(bytes: &[u8]) -> Result<City, String> {
    read_city_bytes("city", bytes, &CityOptions::default()).map_err(|error| error.to_string())
}

fn check(city: &City) {
    let names: Vec<_> = city
        .buildings
        .iter()
        .filter_map(|b| b.id.as_deref())
        .collect();
    assert_eq!(names, ["relation/200", "way/110"]);
    assert_eq!(tops(city), [12.0, 60.0]);
    let ranges: Vec<_> = city.buildings[1]
        .parts
        .iter()
        .map(|part| part.range())
        .collect();
    assert_eq!(
        ranges,
        [[0.0, 12.0], [6.0, 60.0]],
        "parts in place of 20 levels"
    );
    let ombra_city::Part::Prism(court) = &city.buildings[0].parts[0] else {
        panic!("an outline makes a prism");
    };
    assert_eq!(court.outline.holes.len(), 1);
    // 44.5 m by 44.2 m at the equator, and a quarter of it off.
    assert!((court.outline.area() - 0.75 * 44.53 * 44.23).abs() < 10.0);
    assert_eq!(
        findings(city),
        [
            "relation 201: is a member of itself: not followed",
            "relation 201: 1 way is not in the file: its ring is left out",
            "relation 201: has no closed outline: left out",
            "way 120: no usable height: left out (--default-height gives one)",
            "way 121: 1 node is not in the file: left out",
            "way 122: outline is not closed: left out",
            "way 123: lies over 60 km off the others: left out",
        ]
    );
}

#[test]
fn a_map_is_the_same_in_both_formats() {
    check(&read(OSM.as_bytes()).unwrap());
    check(&read(&pbf(OSM, false)).unwrap());
    check(&read(&pbf(OSM, true)).unwrap());
    let mut marked = b"\xef\xbb\xbf".to_vec();
    marked.extend(OSM.as_bytes());
    check(&read(&marked).unwrap());
}

#[test]
fn a_height_may_be_assumed() {
    let heights = Heights {
        default: Some(4.0),
        ..Heights::default()
    };
    let options = CityOptions {
        heights,
        ..CityOptions::default()
    };
    let city = read_city_bytes("city", OSM.as_bytes(), &options).unwrap();
    assert_eq!(tops(&city), [12.0, 60.0, 4.0]);
}

#[test]
fn an_outline_that_is_tagged_itself_is_no_second_building() {
    let way = "<way id=\"102\">";
    let tags = "<tag k=\"building\" v=\"yes\"/><tag k=\"height\" v=\"3\"/>";
    // The inner one is a building of its own, the outer one is not.
    let text = OSM.replace(way, &format!("{way}{tags}"));
    assert_eq!(tops(&read(text.as_bytes()).unwrap()), [12.0, 3.0, 60.0]);
    let text = text.replace("role=\"inner\"", "role=\"outer\"");
    assert_eq!(tops(&read(text.as_bytes()).unwrap()), [12.0, 60.0]);
    // What the relation does not tell, its outline does.
    let text = text.replace("<tag k=\"height\" v=\"12\"/></relation>", "</relation>");
    assert_eq!(tops(&read(text.as_bytes()).unwrap()), [3.0, 60.0]);
}

#[test]
fn broken_xml_says_where() {
    for (from, to, told) in [
        (
            "id=\"17\"",
            "id=\"x\"",
            "id is \"x\", which is no whole number",
        ),
        ("id=\"17\"", "", "id is missing"),
        ("</way>", "</wey>", "XML: "),
        ("</osm>", "", "cut short"),
        ("&amp;", "&nix;", "XML: "),
        ("<osm ", "<svg ", "unknown kind of file"),
    ] {
        let error = read(OSM.replacen(from, to, 1).as_bytes()).unwrap_err();
        assert!(error.contains(told), "{to}: {error}");
        assert!(!error.contains('\n'));
    }
    let mut bytes = OSM.as_bytes().to_vec();
    let at = OSM.find("far").unwrap();
    bytes[at] = 0xff;
    let error = read(&bytes).unwrap_err();
    assert_eq!(error, format!("city: byte {at}: XML: text is not UTF-8"));
}

#[test]
fn deleted_elements_are_not_there() {
    let text = OSM.replace(
        "<relation id=\"200\"",
        "<relation id=\"200\" action=\"delete\"",
    );
    assert_eq!(tops(&read(text.as_bytes()).unwrap()), [60.0]);
}

#[test]
fn hostile_blobs_are_refused() {
    let good = pbf(OSM, false);
    let with = |blob: Vec<u8>| [&good[..], &blob].concat();
    let error = |bytes: &[u8]| read(bytes).unwrap_err();
    let at = good.len();
    assert_eq!(
        error(&with(vec![0, 1])),
        format!("city: byte {at}: blob 3: unexpected end of file: 4 bytes should follow, 2 do")
    );
    assert!(error(&with(vec![0xff; 8])).contains("blob 3: header of 4294967295 bytes"));
    let announced = |size: u64| {
        let mut header = Vec::new();
        field(&mut header, 1, b"OSMData");
        number(&mut header, 3, size);
        [&(header.len() as u32).to_be_bytes()[..], &header].concat()
    };
    assert!(error(&with(announced(1 << 30))).contains("blob 3: content of 1073741824 bytes"));
    assert!(error(&with(announced(u64::MAX))).contains("blob 3: content of -1 bytes"));
    assert!(error(&with(announced(1 << 20))).contains("1048576 bytes should follow, 0 do"));
    // 40 MB that pack to 40 kB.
    let bomb = blob("OSMData", &vec![0; 40 << 20], true);
    assert!(error(&with(bomb)).contains("unpacks to more than 33554432 bytes"));
    // Sixteen million empty nodes in one block that is allowed are gone through and are nothing.
    let mut group = Vec::new();
    field(&mut group, 2, &b"\x0a\x00".repeat(15 << 20));
    check(&read(&with(blob("OSMData", &group, true))).unwrap());
    // A way of thirty million corners may be there, but not two.
    let mut way = Vec::new();
    number(&mut way, 1, 7);
    field(&mut way, 2, &[1]);
    field(&mut way, 3, &[2]);
    field(&mut way, 8, &vec![0; 15 << 20]);
    let [mut table, mut group, mut block] = [vec![], vec![], vec![]];
    for text in ["", "building", "yes"] {
        field(&mut table, 1, text.as_bytes());
    }
    field(&mut group, 3, &way);
    field(&mut block, 1, &table);
    field(&mut block, 2, &group);
    field(&mut block, 2, &group);
    let error = error(&with(blob("OSMData", &block, true)));
    assert!(error.contains("map: more than 16777216 corners"), "{error}");
}

#[test]
fn what_this_reader_cannot_do_is_named() {
    let mut header = Vec::new();
    field(&mut header, 4, b"HistoricalInformation");
    let error = read(&blob("OSMHeader", &header, false)).unwrap_err();
    assert!(
        error.contains("\"HistoricalInformation\" is needed"),
        "{error}"
    );
    let mut file = blob("OSMHeader", &[], false);
    let unknown = blob("OSMNews", b"whatever", false);
    file.extend(unknown);
    assert!(read(&file).unwrap_err().contains("no building"));
    let last = file.len();
    file.extend(blob("OSMData", b"abcd", false));
    // The field of what is not packed becomes that of Zstandard.
    let at = file.len() - 6;
    assert_eq!(file[at], 0x0a);
    file[at] = 7 << 3 | 2;
    let error = read(&file).unwrap_err();
    let told = format!("byte {last}: blob 3: is packed by Zstandard");
    assert!(error.contains(&told), "{error}");
}

#[test]
fn chicago_has_the_elements_that_its_list_says() {
    use super::element::{Element, Kind, value};

    let Some(path) = super::super::tests::outside_data("city/osm/chicago_loop.osm.pbf") else {
        return;
    };
    let bytes = std::fs::read(path).unwrap();
    let file = super::File::recognised(&bytes).unwrap();
    let limits = crate::Limits::default();
    let mut nodes = 0;
    let [mut buildings, mut parts, mut heights, mut levels] = [0; 4];
    for kind in [Kind::Node, Kind::Way, Kind::Relation] {
        let mut count = |element: Element<'_>| {
            let tags = match element {
                Element::Node { .. } => {
                    nodes += 1;
                    return Ok(());
                }
                Element::Way { tags, .. } | Element::Relation { tags, .. } => tags,
            };
            let is_building = value(tags, "building").is_some();
            let is_part = value(tags, "building:part").is_some();
            buildings += usize::from(is_building);
            parts += usize::from(is_part);
            if is_building || is_part {
                heights += usize::from(value(tags, "height").is_some());
                levels += usize::from(value(tags, "building:levels").is_some());
            }
            Ok(())
        };
        file.each(kind, &limits, &mut count).unwrap();
    }
    assert_eq!((nodes, buildings, parts), (163_293, 1594, 395));
    assert_eq!((heights, levels), (300, 1062));
}
