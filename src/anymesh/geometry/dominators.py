"""Immediate dominators of an undirected graph: the node that every path from the root to another one passes last."""

from __future__ import annotations

import numpy as np
from jaxtyping import Int


def immediate_dominators(count: int, pairs: Int[np.ndarray, "m 2"], root: int) -> list[int]:
    """Return the immediate dominator of each of `count` nodes, -1 for the root and for nodes that no path reaches.

    By the iteration of Cooper, Harvey and Kennedy, "A Simple, Fast Dominance Algorithm" (2001).
    """
    beside: list[list[int]] = [[] for _ in range(count)]
    for a, b in pairs.tolist():
        if a != b:
            beside[a].append(b)
            beside[b].append(a)
    order = _postorder(beside, root)
    rank = {node: k for k, node in enumerate(order)}
    above = {root: root}
    changed = True
    while changed:
        changed = False
        for node in reversed(order[:-1]):
            known = [other for other in beside[node] if other in above]
            new = known[0]
            for other in known[1:]:
                new = _common(above, rank, new, other)
            if above.get(node) != new:
                above[node], changed = new, True
    return [above[node] if node in above and node != root else -1 for node in range(count)]


def _postorder(beside: list[list[int]], root: int) -> list[int]:
    """Return the nodes that a depth-first search from the root reaches, in the order in which it leaves them."""
    order, seen, stack = [], {root}, [(root, iter(beside[root]))]
    while stack:
        node, others = stack[-1]
        new = next((other for other in others if other not in seen), None)
        if new is None:
            order.append(node)
            stack.pop()
        else:
            seen.add(new)
            stack.append((new, iter(beside[new])))
    return order


def _common(above: dict[int, int], rank: dict[int, int], a: int, b: int) -> int:
    """Return the nearest node that dominates both of two nodes."""
    while a != b:
        while rank[a] < rank[b]:
            a = above[a]
        while rank[b] < rank[a]:
            b = above[b]
    return a
