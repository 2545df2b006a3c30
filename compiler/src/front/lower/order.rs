//! The order in which definitions that use each other can be lowered, and the cycles that allow none.

/// Result of [`order`].
#[derive(Clone, Debug, Default)]
pub(crate) struct Order {
    /// For each item its position: an item comes after all that it uses, unless it is cyclic.
    pub(crate) rank: Vec<usize>,
    /// Whether an item needs itself.
    pub(crate) cyclic: Vec<bool>,
    /// The cycles, each as the items in the order of use.
    pub(crate) cycles: Vec<Vec<usize>>,
}

/// Depth-first search without recursion; `uses[i]` are the items that item i uses.
pub(crate) fn order(uses: &[Vec<usize>]) -> Order {
    let n = uses.len();
    let mut result = Order { rank: vec![n; n], cyclic: vec![false; n], cycles: Vec::new() };
    let (mut open, mut visited, mut done) = (vec![false; n], vec![false; n], 0);
    for root in 0..n {
        let mut path: Vec<(usize, usize)> = Vec::new();
        if !visited[root] {
            path.push((root, 0));
            (visited[root], open[root]) = (true, true);
        }
        while let Some((item, next)) = path.last_mut() {
            let item = *item;
            let Some(&used) = uses[item].get(*next) else {
                (result.rank[item], open[item]) = (done, false);
                done += 1;
                path.pop();
                continue;
            };
            *next += 1;
            if used >= n {
                continue;
            }
            if open[used] {
                let start = path.iter().position(|&(item, _)| item == used).unwrap_or(0);
                let cycle: Vec<usize> = path.iter().skip(start).map(|&(item, _)| item).collect();
                // Every cycle marks its members, but one message is enough for those known already.
                if cycle.iter().any(|&item| !result.cyclic[item]) {
                    cycle.iter().for_each(|&item| result.cyclic[item] = true);
                    result.cycles.push(cycle);
                }
            } else if !visited[used] {
                (visited[used], open[used]) = (true, true);
                path.push((used, 0));
            }
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_used_comes_first() {
        let uses = vec![vec![1, 2], vec![2], vec![], vec![0]];
        let order = order(&uses);
        for (item, used) in uses.iter().enumerate().flat_map(|(item, used)| used.iter().map(move |&u| (item, u))) {
            assert!(order.rank[used] < order.rank[item]);
        }
        assert!(order.cycles.is_empty());
    }

    #[test]
    fn cycles_are_found_and_named_in_order() {
        let order = order(&[vec![1], vec![2], vec![0], vec![3], vec![0]]);
        assert_eq!(order.cycles, [vec![0, 1, 2], vec![3]]);
        assert_eq!(order.cyclic, [true, true, true, true, false]);
    }

    #[test]
    fn long_chains_do_not_overflow() {
        let n = 200_000;
        let uses: Vec<Vec<usize>> = (0..n).map(|i| if i + 1 < n { vec![i + 1] } else { vec![] }).collect();
        assert_eq!(order(&uses).rank[0], n - 1);
    }
}
