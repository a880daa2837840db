mod brute;
#[test]
fn x() {}
