//! Stacks of what is to be walked, the nearest last.

/// Puts an item on a stack, before those from `first` on that are to be popped sooner: those of a lower rank.
#[inline(always)]
pub(super) fn push_ranked<T, R: PartialOrd>(
    stack: &mut Vec<T>,
    first: usize,
    item: T,
    rank: impl Fn(&T) -> R,
) {
    let mut place = stack.len();
    stack.push(item);
    while place > first && rank(&stack[place - 1]) < rank(&stack[place]) {
        stack.swap(place - 1, place);
        place -= 1;
    }
}
