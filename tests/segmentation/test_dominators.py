"""Immediate dominators, compared with their definition: a dominator is a node without which the root does not reach another."""

import numpy as np
import pytest

from anymesh.segmentation.dominators import NONE, immediate_dominators


def reached(successors: list[list[int]], root: int, without: int = NONE) -> set[int]:
    seen, stack = set(), [root]
    while stack:
        node = stack.pop()
        if node != without and node not in seen:
            seen.add(node)
            stack += successors[node]
    return seen


def by_definition(successors: list[list[int]], root: int) -> list[int]:
    count, all_ = len(successors), reached(successors, root)
    strict = {n: {d for d in all_ - {n} if n not in reached(successors, root, d)} for n in all_}
    # the immediate dominator is the one that all other strict dominators dominate
    last = {n: max(strict[n], key=lambda d: len(strict[d]), default=NONE) for n in all_}
    return [last.get(n, NONE) for n in range(count)]


@pytest.mark.parametrize("seed", range(60))
def test_dominators_of_random_graphs(seed: int) -> None:
    random = np.random.default_rng(seed)
    count = int(random.integers(1, 14))
    edges = random.integers(0, count, (int(random.integers(0, 3 * count)), 2)).tolist()
    if seed % 2:
        edges += [[b, a] for a, b in edges]
    successors = [sorted({b for a, b in edges if a == node}) for node in range(count)]
    root = int(random.integers(count))
    assert immediate_dominators(successors, root) == by_definition(successors, root)


def test_a_long_chain_needs_no_recursion() -> None:
    count = 20_000
    successors = [[n for n in (k - 1, k + 1) if 0 <= n < count] for k in range(count)]
    assert immediate_dominators(successors, 0) == [NONE, *range(count - 1)]
