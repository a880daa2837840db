//! What drawings are, without OpenSCAD to hold them against.

use super::{DrawingContent, DrawingFormat, DrawingRequest};
use crate::math::DVec2;
use crate::scene::profile::Fragments;

fn request() -> DrawingRequest {
    DrawingRequest {
        layer: String::new(),
        id: String::new(),
        origin: DVec2::ZERO,
        scale: 1.0,
        fragments: Fragments::default(),
        is_on_grid: false,
        dpi: 72.0,
        is_centred: false,
    }
}

/// The outlines of a drawing, as corners.
#[track_caller]
fn outlines(text: &str, format: DrawingFormat, request: &DrawingRequest) -> Vec<Vec<[f64; 2]>> {
    let drawing =
        DrawingContent::read(text.as_bytes(), format, request).unwrap_or_else(|fault| panic!("{fault}"));
    let outline = |outline: &Vec<DVec2>| outline.iter().map(DVec2::to_array).collect();
    drawing.shapes.iter().flatten().map(outline).collect()
}

/// A DXF file of entities, their groups in lines of their own.
fn dxf(entities: &[&str]) -> String {
    let entities: String = entities.iter().map(|groups| groups.replace([' ', ','], "\n") + "\n").collect();
    format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

#[test]
fn lines_join_from_loose_ends_on() {
    let text = dxf(&[
        "0,LINE,8,a,10,0,20,0,11,4,21,0",
        "0,LINE,8,a,10,0,20,3,11,4.0004,21,0.0004",
        "0,LINE,8,a,10,0,20,0,11,0,21,3",
        "0,LINE,8,b,10,9,20,0,11,9,21,5",
        "0,LWPOLYLINE,8,b,70,0,10,9,20,5,10,7,20,5",
        "0,LINE,8,b,10,8,20,8,11,8,21,8.0001",
    ]);
    let all = outlines(&text, DrawingFormat::Dxf, &request());
    let triangle = vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]];
    assert_eq!(all, [vec![[9.0, 0.0], [9.0, 5.0], [7.0, 5.0]], triangle]);
    let one = DrawingRequest { layer: "a".into(), origin: DVec2::new(1.0, 2.0), scale: 2.0, ..request() };
    assert_eq!(outlines(&text, DrawingFormat::Dxf, &one), [vec![[-2.0, -4.0], [6.0, -4.0], [-2.0, 2.0]]]);
    let on_grid = DrawingRequest { scale: 0.1, is_on_grid: true, ..one };
    let cells = |corner: [f64; 2]| corner.map(|x| x / 1024.0);
    let expected = [[-102.0, -205.0], [307.0, -205.0], [-102.0, 102.0]].map(cells).to_vec();
    assert_eq!(outlines(&text, DrawingFormat::Dxf, &on_grid), [expected]);
}

#[test]
fn curves_have_the_sides_of_their_share_of_a_turn() {
    let fragments = Fragments { number: 8.0, ..Fragments::default() };
    let request = DrawingRequest { fragments, ..request() };
    let count = |entity: &str| {
        outlines(&dxf(&[entity]), DrawingFormat::Dxf, &request).iter().map(Vec::len).collect::<Vec<_>>()
    };
    assert_eq!(count("0,CIRCLE,10,0,20,0,40,3"), [8]);
    // Of an open line both ends are corners.
    assert_eq!(count("0,ARC,10,0,20,0,40,3,50,350,51,80"), [3]);
    assert_eq!(count("0,ELLIPSE,10,0,20,0,11,3,21,1,40,0.5,41,0,42,3.1"), [5]);
}

#[test]
fn a_page_turns_y_up_and_gives_its_size() {
    let svg = |page: &str, shape: &str| format!("<!DOCTYPE svg><svg {page}>{shape}</svg>");
    let shape = "<g transform='translate(1,2)'><rect width='3' height='1'/></g>";
    let corners = |page: &str, request: &DrawingRequest| {
        outlines(&svg(page, shape), DrawingFormat::Svg, request).concat()
    };
    assert_eq!(corners("", &request()), [[1.0, -2.0], [4.0, -2.0], [4.0, -3.0], [1.0, -3.0]]);
    let page = "width='20mm' height='1cm' viewBox='0 0 10 5'";
    assert_eq!(corners(page, &request()), [[2.0, 6.0], [8.0, 6.0], [8.0, 4.0], [2.0, 4.0]]);
    let centred = DrawingRequest { is_centred: true, ..request() };
    assert_eq!(corners(page, &centred), [[-3.0, 1.0], [3.0, 1.0], [3.0, -1.0], [-3.0, -1.0]]);
    let dots = DrawingRequest { dpi: 25.4, ..request() };
    assert_eq!(corners("height='7'", &dots)[0], [1.0, 5.0]);
}

#[test]
fn paths_are_filled_or_as_wide_as_their_stroke() {
    let path = |data: &str| {
        let text = format!("<svg><path d='{data}' stroke-width='2' stroke-linecap='butt'/></svg>");
        outlines(&text, DrawingFormat::Svg, &request())
    };
    assert_eq!(
        path("m1 1h2v2zm5 5l1 0 0 1z"),
        [vec![[1.0, -1.0], [3.0, -1.0], [3.0, -3.0]], vec![[6.0, -6.0], [7.0, -6.0], [7.0, -7.0]],]
    );
    let [line] = &path("M0 5H9")[..] else { panic!("one outline") };
    let expected = [[0.0, -4.0], [9.0, -4.0], [9.0, -6.0], [0.0, -6.0]];
    assert!(line.len() == 4 && expected.iter().all(|corner| line.contains(corner)), "{line:?}");
    // A quarter of a circle, and a line where there is no radius.
    let [arc] = &path("M2 0A2 2 0 0 1 0 2L0 0z")[..] else { panic!("one outline") };
    assert!(
        arc.iter()
            .skip(1)
            .take(arc.len() - 2)
            .all(|[x, y]| (DVec2::new(*x, *y).length() - 2.0).abs() < 1e-12),
        "{arc:?}"
    );
    assert_eq!(path("M2 0A0 2 0 0 1 0 2L0 0z"), [vec![[2.0, 0.0], [0.0, -2.0], [0.0, 0.0]]]);
}
