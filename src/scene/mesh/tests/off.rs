//! OFF.

use super::{all_refused, facts};

const TETRAHEDRON: &str = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

#[test]
fn headers_and_colours_are_read_over() {
    for header in
        ["OFF\n4 4 6\n", "OFF 4 4 6\n", "COFF\n\n# a\n4 4\n", "STCNOFF 4 4 0 # b\r\n", "# a\nOFF\n4 4 0\n"]
    {
        assert!(facts("standard input", format!("{header}{TETRAHEDRON}").as_bytes()).is_solid, "{header}");
    }
    let coloured =
        TETRAHEDRON.replace("0 1 0\n", "0 1 0 255 0 0 255\n").replace("3 0 1 3", "3 0 1 3 0.5 0 0");
    assert!(facts("a.off", format!("COFF 4 4 6\n{coloured}").as_bytes()).is_solid);
}

#[test]
fn wrong_files_are_refused() {
    let texts: [(&str, &str); 27] = [
        ("", "cut off: it ends where `OFF`"),
        ("# nothing", "cut off: it ends where `OFF`"),
        ("OFF", "the numbers of corners and faces should be"),
        ("OFF\n8", "2:1: error: the file is cut off: it ends where the number of faces"),
        ("OFF\n8 6", "a corner should be"),
        ("OFF\n-8 6 0", "2:1: error: the number of corners is expected here"),
        ("OFF\n8.5 6 0", "2:1: error: the number of corners is expected here"),
        ("OFF\n8 x 0", "2:3: error: the number of faces is expected here"),
        ("OFF\n99999999999999999999999 1 0", "the number of corners is expected here"),
        ("OFF\n1000000000 1 0\n0 0 0", "3:5: error: the file is cut off: it ends where a corner"),
        ("OFF\n18446744073709551615 1 0\n0 0 0", "cut off: it ends where a corner"),
        (
            "OFF\n3 1000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
            "6:7: error: the file is cut off: it ends where a face",
        ),
        ("OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2", "3:3: error: a coordinate is expected here"),
        ("OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2", "3:5: error: a coordinate is not a finite"),
        ("OFF\n3 1 0\n0 0 inf\n1 0 0\n0 1 0\n3 0 1 2", "3:5: error: a coordinate is not a finite"),
        ("OFF\n3 1 0\n0 0 a\n1 0 0\n0 1 0\n3 0 1 2", "3:5: error: a coordinate is no number"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3", "6:7: error: a face names corner 3, which there is not"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1", "numbered from 0 to 2"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9223372036854775808", "is no number"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "it ends where the number of a corner"),
        (
            "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n3 0 1 2",
            "6:5: error: the number of a corner is expected here",
        ),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1", "6:1: error: a face has 2 corners"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2", "the number of a corner should be"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 1 1 1", "no face of the mesh has an area"),
        ("OFF\n0 0 0\n", "no triangles"),
        ("4OFF\n3 1 0\n", "corners of four or more dimensions, which ray13 does not read"),
        ("OFF BINARY\n", "1:5: error: this is binary OFF, which ray13 does not read"),
    ];
    let files: Vec<(&[u8], &str)> = texts.iter().map(|(text, says)| (text.as_bytes(), *says)).collect();
    all_refused("a.off", &files);
}
