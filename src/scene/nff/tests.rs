//! Small files, and what is wrong with small files.

use super::{Reader, in_stretches};
use crate::math::DVec3;
use crate::scene::{
    Anchor, Diagnostics, FieldSpan, Format, Material, MaterialId, Primitive, ReadOptions, Scene, Shape, Solid,
};

fn read(text: &str) -> Result<Scene, Diagnostics> {
    let options = ReadOptions { format: Some(Format::Nff), ..ReadOptions::default() };
    crate::scene::read("test.nff", text.as_bytes(), &options)
}

/// The first line of what is wrong, without the file's name.
#[track_caller]
fn wrong(text: &str) -> String {
    let found = read(text).expect_err("an error").to_string();
    found.lines().next().unwrap_or_default().trim_start_matches("test.nff:").to_owned()
}

fn primitives(scene: &Scene) -> Vec<&Primitive> {
    let mut all = Vec::new();
    scene.objects.iter().for_each(|object| object.solid.visit(&mut |p| all.push(p)));
    all
}

#[test]
fn the_name_says_the_format() {
    assert_eq!(Format::of("balls.nff"), Format::Nff);
    assert_eq!(Format::of("a/B.NFF"), Format::Nff);
    assert_eq!(Format::of("nff"), Format::Language);
    assert!(crate::scene::read("x.nff", b"s 0 0 0 1", &ReadOptions::default()).is_ok());
}

#[test]
fn all_entities_are_read_wherever_lines_break() {
    let text = "b .1 .2 .3 # sky\nv\nfrom 0 -5 0 at 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 512 512\n\
        l 1 2\n3 l 4 5 6 .5 .25 0\nf 1 .5 0 .5 .25 30 0 0\ns 1 2 3 4 p\n3\n0 0 0 1\n0 0 0 1 0\n\
        c 0 0 0 2 0 0 4 1 pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n";
    let scene = read(text).unwrap();
    assert_eq!(scene.world.background, DVec3::new(0.1, 0.2, 0.3));
    let camera = &scene.views[0];
    assert_eq!((camera.eye, camera.target, camera.up), (DVec3::Y * -5.0, DVec3::ZERO, DVec3::Z));
    assert_eq!((camera.field, camera.span), ([45.0; 2], FieldSpan::Centers));
    let solids = primitives(&scene);
    assert_eq!(solids.len(), 4);
    assert_eq!(solids[0].map.transform_point3(DVec3::X), DVec3::new(5.0, 2.0, 3.0));
    let Shape::Face(corners) = &solids[1].shape else { panic!("a face") };
    assert_eq!(corners[..], [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(solids[2].shape, Shape::Tube { bottom: 1.0, top: 0.5 });
    assert_eq!(solids[2].map.transform_point3(DVec3::Z), DVec3::new(0.0, 0.0, 4.0));
    let Shape::Patch(corners) = &solids[3].shape else { panic!("a patch") };
    assert_eq!((corners[2].place, corners[2].normal), (DVec3::Y, DVec3::Z));
    // Kd is in the colour.
    let fill =
        Material { color: DVec3::new(0.5, 0.25, 0.0), kd: 1.0, ks: 0.25, n: 30.0, ..Material::default() };
    assert_eq!(scene.materials, [Material { kr: 0.25, kt: 0.0, index: 1.0, ..fill }]);
}

#[test]
fn lights_without_intensity_share_by_the_rule_of_the_format() {
    let scene = read("l 0 0 1 l 0 0 2 l 0 0 3 l 0 0 4 2 1 0 s 0 0 0 1").unwrap();
    assert_eq!(scene.world.ambient, DVec3::splat(0.25));
    let lights: Vec<_> = scene.lights.iter().map(|l| (l.anchor, l.intensity, l.color)).collect();
    assert_eq!(lights[0], (Anchor::World(DVec3::Z), 0.25, DVec3::ONE));
    assert_eq!(lights[3], (Anchor::World(DVec3::Z * 4.0), 2.0, DVec3::new(1.0, 0.5, 0.0)));
    let dark = read("s 0 0 0 1").unwrap();
    assert_eq!((dark.lights.len(), dark.world.ambient), (0, Scene::default().world.ambient));
}

/// All of `mount` was burnt out: its glass with a Kd of 0.1 had half of white from ambient light, once for
/// each surface behind another.
#[test]
fn a_surface_scatters_of_ambient_light_what_it_scatters_of_lamps() {
    let scene = read("l 0 0 9 f 1 .5 .2 .1 .1 101 .9 1.5 s 0 0 0 1 f 1 1 1 0 1 9 0 0 s 4 0 0 1").unwrap();
    let [glass, mirror] = &scene.materials[..] else { panic!("two materials") };
    assert_eq!((glass.color, glass.kd), (DVec3::new(0.1, 0.05, 0.2 * 0.1), 1.0));
    assert_eq!(scene.world.ambient * glass.color, 0.1 * DVec3::new(0.5, 0.25, 0.1));
    // What scatters nothing is asked for no light.
    assert_eq!((mirror.color, mirror.kd), (DVec3::ZERO, 0.0));
}

#[test]
fn what_other_programs_add_is_ignored_with_a_word() {
    let scene = read(
        "v from 0 -5 0 at 0 0 0 up 0 0 1 angle 45 hither 1 yon 100 resolution 9 9\n\
         tess 4\n\
         f 1 1 1 1 0 1 0 0 ./../3d wood.jpg s 0 0 0 1\n\
         f 1 1 1 1 0 1 0 0 0.2\n\
         f 1 1 1 1 0 1 0 0 .2 tiles # of marble\n\
         shader sky.png\n\
         tess 2",
    )
    .unwrap();
    assert_eq!((scene.objects.len(), scene.views.len(), scene.materials.len()), (1, 1, 1));
    assert_eq!(
        scene.notes,
        [
            "line 1: `yon` is ignored: what is far away is seen too",
            "line 2: `tess` is ignored (2 times, of which this is the first): what is round is shown round",
            "line 3: a texture is ignored (3 times, of which this is the first): the surface has the colour of \
             its `f`",
            "line 4: the ninth number of `f` is ignored (2 times, of which this is the first): the share of \
             ambient light is Kd",
        ]
    );
}

#[test]
fn faces_with_textures_are_faces() {
    let scene = read(
        "tt wood.jpg\n0 0 0 0 0 1 0 0 1 0 0 1 0 1 1\n\
         ttp s\n0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 1 0 0 0 1 1 1\n\
         tpp 3\n0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 1 0 0 0 1\n1\n1",
    )
    .unwrap();
    let [Shape::Face(face), Shape::Patch(triangle), Shape::Patch(patch)] =
        &primitives(&scene).iter().map(|p| p.shape.clone()).collect::<Vec<_>>()[..]
    else {
        panic!("a face and two patches")
    };
    assert_eq!(face[..], [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(triangle, patch);
    assert_eq!((patch[2].place, patch[2].normal), (DVec3::Y, DVec3::Z));
    assert_eq!(scene.notes.len(), 1);
}

#[test]
fn a_light_of_enff_has_its_intensity_before_its_colour() {
    let scene = read("l 0 0 1 2 1 .5 .25 s 0 0 0 1").unwrap();
    assert_eq!((scene.lights[0].intensity, scene.lights[0].color), (2.0, DVec3::new(1.0, 0.5, 0.25)));
}

#[test]
fn shapes_of_other_programs_are_left_out_where_that_is_asked_for() {
    let text = "dod 0 0 0 5\ns 0 0 0 1\npb 1 1 0 0 0 1 0 0 0 1 0 1 1 0\ns 2 0 0 1";
    assert_eq!(
        wrong(text),
        "1:1: error: `dod`, a dodecahedron, is not of NFF but of other programs: \
        this is left out with --skip-unsupported"
    );
    let options = ReadOptions { skip_unsupported: true, ..ReadOptions::default() };
    let scene = crate::scene::read("test.nff", text.as_bytes(), &options).unwrap();
    assert_eq!(scene.objects.len(), 2);
    let note = "line 1: a shape that other programs know is ignored (2 times, of which this is the first): it is \
                left out";
    assert_eq!(scene.notes, [note]);
}

#[test]
fn a_scene_of_which_nothing_is_left_says_why() {
    let found = read("p 3 0 0 0 1 1 1 2 2 2").unwrap_err().to_string();
    let why = "test.nff:1:1: note: a face has no area and is left out";
    assert_eq!(
        found,
        format!("test.nff: error: nothing is left of the scene: all that it shows is left out\n{why}")
    );
}

#[test]
fn the_other_nff_is_named() {
    for text in [
        "nff\nversion 2.0\nviewpos 0 0 0\ncube\n8\n0 0 0\n",
        "// a room for 'WTK'\n\n// and more\nNFF version 2.1",
    ] {
        let message = wrong(text);
        assert!(message.contains("this is another format that is called NFF: that of Sense8's"), "{message}");
    }
    assert!(wrong("// nff").contains("NFF has no such entity"));
}

#[test]
fn equal_fills_are_one_material() {
    let (red, blue) = ("f 1 0 0 1 0 0 0 0\n", "f 0 0 1 1 0 0 0 0\n");
    let scene = read(&format!("s 0 0 0 1 {red} s 2 0 0 1 {blue} s 4 0 0 1 {red} s 6 0 0 1")).unwrap();
    let used: Vec<_> = primitives(&scene).iter().map(|p| p.material).collect();
    assert_eq!(used, [0, 1, 2, 1].map(MaterialId));
    assert_eq!(scene.materials[0], Material::default());
}

#[test]
fn faces_without_area_are_left_out_with_one_note() {
    let scene = read(
        "s 0 0 0 1\np 3 0 0 0 1 1 1 2 2 2\np 4 0 0 0 0 0 0 1 0 0 0 0 0\npp 3 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 1",
    )
    .unwrap();
    assert_eq!(scene.objects.len(), 1);
    let note = "line 2: 3 faces, of which this is the first, have no area and are left out";
    assert_eq!(scene.notes, [note]);
    let repeated = read("p 5 0 0 0 1 0 0 1 0 0 0 1 0 0 0 0").unwrap();
    let Solid::Primitive(Primitive { shape: Shape::Face(corners), .. }) = &repeated.objects[0].solid else {
        panic!("a face")
    };
    assert_eq!((corners.len(), repeated.notes.len()), (3, 0));
}

#[test]
fn each_fault_has_its_place_and_its_words() {
    for (text, expected) in [
        ("s 0 0 0", "1:1: error: the file ends within `s`: the radius is missing"),
        ("s 0 0", "1:1: error: the file ends within `s`: z of the centre is missing"),
        ("\n s 0 0 x 1", "2:8: error: z of the centre of `s` is no number: this is `x`"),
        ("s 0 0 nan 1", "1:7: error: z of the centre of `s` is no number: this is `nan`"),
        ("s 0 0 1\ns 0 0 0 1", "2:1: error: `s` ends too early: the radius is missing: here `s` begins"),
        (
            "s 0 0 1e999 1",
            "1:7: error: z of the centre of `s` is beyond the largest number that there is: this is `1e999`",
        ),
        ("s 0 0 0 0", "1:9: error: `s`: the radius is above 0: this is 0"),
        ("s 0 0 0 -1", "1:9: error: `s`: the radius is above 0: this is -1"),
        ("s 1e308 0 0 1e308", "1:1: error: `s`: it reaches farther than 1e305 from the origin"),
        ("s 0 0 0 1e-320", "1:9: error: `s`: it is smaller than a 64-bit float holds: this is 1e-320"),
        ("s 0 0 0 1 2", "1:11: error: a number stands where an entity begins: this is `2`"),
        ("sphere 0 0 0 1", "1:1: error: NFF has no such entity: this is `sphere`"),
        ("p 2 0 0 0 1 1 1", "1:3: error: `p`: the number of corners is a whole number, 3 or more: this is 2"),
        ("p -3", "1:3: error: `p`: the number of corners is a whole number, 3 or more: this is -3"),
        ("p 3.5 0 0 0", "1:3: error: `p`: the number of corners is a whole number, 3 or more: this is 3.5"),
        ("p x", "1:3: error: the number of corners of `p` is no number: this is `x`"),
        ("p", "1:1: error: the file ends within `p`: the number of corners is missing"),
        (
            "p 4000000000 0 0 0",
            "1:1: error: the file ends within `p`: room for 4000000000 corners is missing",
        ),
        ("p 1e300 0 0 0", "1:1: error: the file ends within `p`: room for 1e300 corners is missing"),
        ("p 3 0 0 0 1 1 1 200 100", "1:1: error: the file ends within `p`: z of corner 3 of 3 is missing"),
        (
            "p 4 0 0 0 1 0 0 1 1 0\ns 0 0 0 1",
            "2:1: error: `p` ends too early: x of corner 4 of 4 is missing: here `s` begins",
        ),
        (
            "pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 x 1",
            "1:38: error: y of the normal of corner 3 of 3 of `pp` is no number: this is `x`",
        ),
        ("c 0 0 0 1 0 0 0 1", "1:1: error: `c`: base and apex are the same point"),
        ("c 0 0 0 0 0 0 1 0", "1:9: error: `c`: one of the radii is above 0: this is 0"),
        ("c 0 0 0 -1 0 0 1 0", "1:9: error: `c`: a radius is 0 or more: this is -1"),
        ("f 1 1 2 1 0 1 0 0 s 0 0 0 1", "1:7: error: `f`: colour, Kd, Ks and T are in 0 to 1: this is 2"),
        ("f 1 1 1 1 0 -1 0 0 s 0 0 0 1", "1:13: error: `f`: Shine and index are 0 or more: this is -1"),
        ("f 1 1 1 1 0 1 .5 0 s 0 0 0 1", "1:18: error: `f`: where T is above 0 the index is too: this is 0"),
        ("b 0 -1 0 s 0 0 0 1", "1:5: error: `b`: a colour is not negative: this is -1"),
        ("v from 0 0 0 at 0 0", "1:1: error: the file ends within `v`: z of `at` is missing"),
        ("v from 0 0 0 at 0 0 1", "1:1: error: the file ends within `v`: `up` is missing"),
        ("v from 0 0 0 up 0 0 1 angle 45 s 0 0 0 1", "1:1: error: `v`: `at` is missing"),
        (
            "v from 0 0 0 at 0 0 1 up 0 1 0 angle 180",
            "1:38: error: `v`: the angle is between 0 and 180 degrees, both excluded: this is 180",
        ),
        (
            "v from 0 0 0 at 0 0 0 up 0 1 0 angle 45",
            "1:1: error: `v`: `from` and `at` are the same point: there is no direction to look in",
        ),
        ("shader\nsky.png", "1:1: error: `shader`: the texture's name is missing on this line"),
        ("tt\ns\n0 0 0", "1:1: error: `tt`: the texture's name is missing on this line"),
        (
            "tt sky\n0 0 0 0 s",
            "2:9: error: `tt` ends too early: v of corner 1 of 3 is missing: here `s` begins",
        ),
        ("tess s", "1:6: error: `tess` ends too early: the number of divisions is missing: here `s` begins"),
        ("f 1 1 1 1 0 1 0 0 .2 9", "1:22: error: a number stands where an entity begins: this is `9`"),
        (
            "l 0 0 0 1e200 1e200 1 1",
            "1:1: error: `l`: intensity and colour multiply to more than a 64-bit float holds",
        ),
        ("v resolution 512 -1", "1:18: error: `v`: the resolution is two whole numbers above 0: this is -1"),
        ("", " error: the scene is empty: there is nothing to see in it"),
        ("# nothing", " error: the scene is empty: there is nothing to see in it"),
        ("f 1 1 1 1 0 1 0 0", " error: the scene is empty: there is nothing to see in it"),
    ] {
        assert_eq!(wrong(text), expected, "{text}");
    }
}

#[test]
fn reading_goes_on_with_the_next_entity() {
    let found = read("s 0 0 x 1 junk 5\np 2 1 1 1\ns 0 0 0 -2\ns 0 0 0 1 q 1 2 3\ns 0 0 0 1").unwrap_err();
    assert_eq!(found.list.len(), 4, "{found}");
    let many = read(&"s 0 0 0 0\n".repeat(100)).unwrap_err();
    assert!(many.stopped);
}

#[test]
fn a_mirror_has_no_more_than_glass_leaves() {
    let scene = read("f 1 1 1 0 0.7 20 0.6 1.5 s 0 0 0 1 f 1 1 1 0 0.1 20 0.9 1.5 s 2 0 0 1").unwrap();
    let shares: Vec<_> = scene.materials.iter().map(|m| (m.ks, m.kr, m.kt)).collect();
    assert_eq!(shares, [(0.7, 0.4, 0.6), (0.1, 0.1, 0.9)]);
    assert_eq!(scene.notes, ["line 1: where Ks + T is above 1, only 1 - T is mirrored"]);
}

/// Entities of every kind, some with a remark, one after the other in an order of their own.
fn long_text(lines: usize) -> String {
    const LINES: [&str; 17] = [
        "s 0 0 0 1",
        "f 1 .5 0 .5 .25 30 0 0",
        "c 0 0 0 2 # s 1 1 1 1\n  0 0 4 1",
        "l 1 2\n 3",
        "p 3 0 0 0 1 0 0\n 0 1 0",
        "# s s s\n",
        "f 0 .5 1 .5 .75 30 .5 1",
        "b .1 .2 .3",
        "l 1 2 3 .5 .5 .5 s 5 5 5 1",
        "p 3 0 0 0 1 0 0 2 0 0",
        "v from 0 -5 0 at 0 0 0 up 0 0 1 angle 45",
        "pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1",
        "tt s\n 0 0 0 0 0 1 0 0\n 1 0 0 1 0 1 1",
        "tess 4",
        "f 0 .5 1 .5 .75 30 .5 1 .1 a texture",
        "shader s",
        "tpp 3 0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 1 0 0 0 1 1 1",
    ];
    // 5 and 17 have no common factor; the third power mixes the order from round to round.
    (0..lines).map(|i| format!("{}\n", LINES[(5 * i + i * i * i / 17) % LINES.len()])).collect()
}

#[test]
fn a_text_read_in_stretches_means_the_same() {
    for lines in [1, 40, 300] {
        let text = long_text(lines);
        let whole = Reader::of(&text, 0..text.len(), &ReadOptions::default()).finish("test", &text).unwrap();
        for bytes in [1, 10, 100, 1000] {
            let Some(read) = in_stretches(&text, bytes, &ReadOptions::default()) else {
                assert!(lines == 1 || text.len() < 2 * bytes, "{bytes} of {}", text.len());
                continue;
            };
            assert_eq!(read.finish("test", &text).unwrap(), whole, "{lines} lines by {bytes} bytes");
        }
    }
}

#[test]
fn errors_of_a_long_text_are_those_of_one_thread() {
    for wrong in ["s 0 0 0", "s 0 0 0 -1", "5", "s 0 0 x 1", "q"] {
        let text = format!("{0}{wrong}\n{0}{wrong}\n{0}", long_text(50));
        assert!(in_stretches(&text, 100, &ReadOptions::default()).is_none());
        let found = Reader::of(&text, 0..text.len(), &ReadOptions::default()).finish("test.nff", &text);
        assert_eq!(read(&text), found);
        assert!(found.is_err());
    }
}
