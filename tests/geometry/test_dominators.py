"""Dominators against their definition: without its dominator, a node cannot be reached from the root."""

import numpy as np
import pytest

from anymesh.geometry.dominators import immediate_dominators
from anymesh.geometry.topology import label_connected


def reached(count: int, pairs: np.ndarray, root: int, without: int = -1) -> set[int]:
    kept = pairs[(pairs != without).all(1)]
    label = label_connected(count, kept)
    return {k for k in range(count) if label[k] == label[root] and k != without}


@pytest.mark.parametrize("seed", range(12))
def test_dominators_are_the_nodes_that_cut_others_off(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count, root = 14, int(rng.integers(14))
    pairs = rng.integers(0, count, (int(rng.integers(10, 24)), 2))
    found = immediate_dominators(count, pairs, root)
    all_reached = reached(count, pairs, root)
    dominators = {node: {node} for node in all_reached}
    for cut in all_reached - {root}:
        for node in all_reached - reached(count, pairs, root, cut):
            dominators[node].add(cut)
    for node in range(count):
        if node == root or node not in all_reached:
            assert found[node] == -1
        else:
            strict = dominators[node] - {node} | {root}
            assert found[node] == max(strict, key=lambda d: len(dominators[d] | {root}))


def test_a_chain_of_very_many_nodes() -> None:
    pairs = np.stack([np.arange(4999), np.arange(1, 5000)], 1)
    assert immediate_dominators(5000, pairs, 0) == [-1, *range(4999)]
