//! Numbers in groups, by counting: what is found by looking only at few others, of very many.

/// Numbers that belong to groups, those of a group side by side.
pub struct Groups {
    /// By group: where its numbers end.
    ends: Vec<u32>,
    numbers: Vec<u32>,
}

impl Groups {
    /// So many groups of these numbers, each given with its group; fewer than 2³² of them. Within a group
    /// they stand in the order in which they are given.
    pub fn new(groups: usize, given: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        // The places of a group's numbers end where those of the next begin.
        let mut ends = vec![0_u32; groups + 1];
        for (group, _) in given.clone() {
            ends[group as usize + 1] += 1;
        }
        for group in 1..ends.len() {
            ends[group] += ends[group - 1];
        }
        let mut numbers = vec![0; ends[groups] as usize];
        for (group, number) in given {
            let place = &mut ends[group as usize];
            numbers[*place as usize] = number;
            *place += 1;
        }
        ends.pop();
        Self { ends, numbers }
    }

    /// Each group's numbers, to be sorted or looked at, in the order of the groups.
    pub fn each(&mut self, mut look: impl FnMut(u32, &mut [u32])) {
        let mut rest = &mut self.numbers[..];
        let mut start = 0;
        for (group, &end) in self.ends.iter().enumerate() {
            let (own, others) = rest.split_at_mut((end - start) as usize);
            look(group as u32, own);
            (rest, start) = (others, end);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_order_in_their_groups() {
        let given = [(2, 7), (0, 5), (2, 6), (3, 9), (0, 4)];
        let mut seen = Vec::new();
        Groups::new(5, given.into_iter()).each(|group, numbers| seen.push((group, numbers.to_vec())));
        let expected = [(0, vec![5, 4]), (1, vec![]), (2, vec![7, 6]), (3, vec![9]), (4, vec![])];
        assert_eq!(seen, expected);
        Groups::new(0, std::iter::empty()).each(|_, _| unreachable!());
    }
}
