//! Lamps in the midst of what they shine on: rays run to them from all sides.

use ray13::math::Size;

use crate::support::same::same;

// Found by an attack: where rays of a tile came to the lamp from opposite sides, what stood before it was
// passed over by those that ran against the axis of the tile's shadow packet, and light leaked through.
#[test]
fn a_lamp_in_a_ball_over_a_floor_and_one_between_balls() {
    let texts = [
        "camera(eye = [0, -3, 40], target = [0, 0, 0], field = [60, 60]); light(at = [0, 0, 1]);
            sphere(at = [0, 0, 1], semi = 0.1); cube(at = [0, 0, -0.5], semi = [20, 20, 0.5]);",
        "camera(eye = [1, -9, 6], target = [0, 0, 0], field = [60, 60]); light(at = [0, 0, 0]); light(at = [0.4, 0, 1]);
            balls",
    ];
    for (k, text) in texts.into_iter().enumerate() {
        let text = text.replace("balls", &balls());
        let name = format!("lamps{k}.scene");
        for dots in [Size::new(33, 33), Size::new(160, 100)] {
            same(&name, &text, dots, &[]);
        }
    }
}

/// Balls all around the origin, small and large.
fn balls() -> String {
    let places = (-2..=2).flat_map(|i| (-2..=2).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
    let ball = |[i, j, k]: [i32; 3]| {
        let size = 0.1 + 0.06 * f64::from((7 * i + 3 * j + 5 * k).rem_euclid(7));
        format!("sphere(at = [{i}, {j}, {k}], semi = {size});\n")
    };
    places.filter(|&place| place != [0, 0, 0]).map(ball).collect()
}
