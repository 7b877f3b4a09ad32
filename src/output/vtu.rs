//! points.vtu: the points as VTK's XML unstructured grid of vertices, which ParaView opens.
//!
//! Arrays are base64 of a 64-bit byte count and little-endian values
//! (<https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>).

use std::io::{self, Write};
use std::path::Path;

use super::OutputError;
use super::file::{check, write_whole};
use crate::snapshot::{Column, Snapshot};

/// VTK's cell type of a single point.
const VERTEX: u8 = 1;

/// Writes all points with their fields; third components are zero.
///
/// # Errors
/// A value that is not finite, a field of the wrong length, errors of the file system.
pub fn write(path: &Path, snapshot: &Snapshot) -> Result<(), OutputError> {
    check(snapshot)?;
    write_whole(path, |file| document(file, snapshot).map_err(OutputError::io(path)))
}

fn document(out: &mut impl Write, snapshot: &Snapshot) -> io::Result<()> {
    let points = snapshot.position.len() as u64;
    let triples = |vectors: &[glam::DVec2]| -> Vec<u8> {
        vectors.iter().flat_map(|v| [v.x, v.y, 0.0]).flat_map(f64::to_le_bytes).collect()
    };
    let columns = snapshot.columns();
    let scalars = columns.iter().find(|column| matches!(column, Column::Scalar { .. })).map_or("", Column::name);
    let vectors = columns.iter().find(|column| matches!(column, Column::Vector { .. })).map_or("", Column::name);
    let count = |from: u64| -> Vec<u8> { (from..from + points).flat_map(u64::to_le_bytes).collect() };

    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(out, r#"<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#)?;
    writeln!(out, "<UnstructuredGrid>\n<FieldData>")?;
    writeln!(
        out,
        r#"<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{:?}</DataArray>"#,
        snapshot.time
    )?;
    writeln!(out, "</FieldData>")?;
    writeln!(out, r#"<Piece NumberOfPoints="{points}" NumberOfCells="{points}">"#)?;
    writeln!(out, "<Points>")?;
    array(out, "Float64", "points", 3, &triples(&snapshot.position))?;
    writeln!(out, "</Points>\n<Cells>")?;
    array(out, "Int64", "connectivity", 1, &count(0))?;
    array(out, "Int64", "offsets", 1, &count(1))?;
    array(out, "UInt8", "types", 1, &vec![VERTEX; snapshot.position.len()])?;
    writeln!(out, "</Cells>")?;
    writeln!(out, r#"<PointData Scalars="{scalars}" Vectors="{vectors}">"#)?;
    for column in &columns {
        match column {
            Column::Scalar { name, values, .. } => {
                let bytes: Vec<u8> = values.iter().copied().flat_map(f64::to_le_bytes).collect();
                array(out, "Float64", name, 1, &bytes)?;
            }
            Column::Vector { name, values, .. } => array(out, "Float64", name, 3, &triples(values))?,
        }
    }
    writeln!(out, "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

fn array(out: &mut impl Write, kind: &str, name: &str, components: u8, data: &[u8]) -> io::Result<()> {
    writeln!(out, r#"<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="binary">"#)?;
    let mut bytes = (data.len() as u64).to_le_bytes().to_vec();
    bytes.extend_from_slice(data);
    out.write_all(&base64(&bytes))?;
    writeln!(out, "\n</DataArray>")
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> Vec<u8> {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = Vec::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |k: usize| u32::from(chunk.get(k).copied().unwrap_or(0));
        let group = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let padding = k > chunk.len();
            text.push(if padding { b'=' } else { ALPHABET[(group >> (18 - 6 * k) & 63) as usize] });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::points::tests::awkward;

    #[test]
    fn base64_gives_the_published_vectors() {
        for (plain, text) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy"), ("\u{ff}>?", "w78+Pw==")]
        {
            assert_eq!(String::from_utf8(base64(plain.as_bytes())).unwrap(), text);
        }
    }

    fn decode(text: &str) -> Vec<u8> {
        let value = |c: u8| match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            other => panic!("{other} is not base64"),
        };
        let plain: Vec<u8> = text.trim_end_matches('=').bytes().map(value).collect();
        let bits = |k: usize| u32::from(plain.get(k).copied().unwrap_or(0));
        (0..plain.len() * 6 / 8)
            .map(|byte| {
                let k = byte / 3 * 4;
                let group = bits(k) << 18 | bits(k + 1) << 12 | bits(k + 2) << 6 | bits(k + 3);
                (group >> (16 - 8 * (byte % 3))) as u8
            })
            .collect()
    }

    /// Tag names with attributes and the text that follows, after checking that tags nest.
    fn parse(document: &str) -> Vec<(String, String)> {
        let (mut open, mut found) = (Vec::new(), Vec::new());
        for piece in document.split('<').skip(1) {
            let (tag, text) = piece.split_once('>').unwrap();
            if let Some(name) = tag.strip_prefix('/') {
                assert_eq!(open.pop().as_deref(), Some(name));
            } else if !tag.starts_with('?') {
                open.push(tag.split(' ').next().unwrap().to_owned());
                found.push((tag.to_owned(), text.trim().to_owned()));
            }
        }
        assert!(open.is_empty(), "{open:?} are not closed");
        found
    }

    #[test]
    fn a_parser_gets_back_counts_and_values() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("points.vtu");
        let snapshot = awkward();
        write(&path, &snapshot).unwrap();
        let elements = parse(&std::fs::read_to_string(&path).unwrap());
        assert!(elements.iter().any(|(tag, _)| tag == r#"Piece NumberOfPoints="20" NumberOfCells="20""#));

        let data = |name: &str| -> Vec<u8> {
            let (_, text) = elements.iter().find(|(tag, _)| tag.contains(&format!("Name=\"{name}\""))).unwrap();
            let bytes = decode(text);
            let (header, data) = bytes.split_at(8);
            assert_eq!(u64::from_le_bytes(header.try_into().unwrap()), data.len() as u64);
            data.to_vec()
        };
        let floats = |name: &str| -> Vec<f64> {
            data(name).chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
        };
        let integers = |name: &str| -> Vec<i64> {
            data(name).chunks_exact(8).map(|b| i64::from_le_bytes(b.try_into().unwrap())).collect()
        };
        let triples = |v: &[glam::DVec2]| v.iter().flat_map(|v| [v.x, v.y, 0.0]).collect::<Vec<_>>();
        assert_eq!(floats("points"), triples(&snapshot.position));
        assert_eq!(floats("velocity"), triples(&snapshot.velocity));
        assert_eq!(floats("pressure"), snapshot.pressure);
        assert_eq!(integers("connectivity"), (0..20).collect::<Vec<_>>());
        assert_eq!(integers("offsets"), (1..=20).collect::<Vec<_>>());
        assert_eq!(data("types"), [VERTEX; 20]);
        assert!(elements.iter().any(|(tag, text)| tag.contains("TimeValue") && text == "2.5"));
    }
}
