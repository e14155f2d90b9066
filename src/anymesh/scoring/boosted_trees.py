"""Evaluation of gradient-boosted decision trees stored as arrays; no training library is needed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32, Int16, Int32

NO_FEATURE = -1  # value in `feature` of a leaf


@dataclass(frozen=True, eq=False)
class BoostedTrees:
    """Trees with numeric splits. Nodes of all trees are concatenated; root: first node of each tree.

    feature: (N,) column that a node splits on, NO_FEATURE for a leaf; threshold: (N,) rows up to and including it go left, as
    does NaN; left, right: (N,) next node; value: (N,) score of a leaf, or the mean of its leaves for an inner node.
    """

    feature: Int16[np.ndarray, " N"]
    threshold: Float32[np.ndarray, " N"]
    left: Int32[np.ndarray, " N"]
    right: Int32[np.ndarray, " N"]
    value: Float32[np.ndarray, " N"]
    root: Int32[np.ndarray, " T"]

    def score(self, rows: Float[np.ndarray, "n k"]) -> Float[np.ndarray, " n"]:
        """Return the sum of the leaf values that each row reaches: the log-odds of the positive class."""
        rows = np.ascontiguousarray(rows, np.float32)
        reached = np.tile(self.root, len(rows))  # the node of each row in each tree
        going, node = np.arange(len(reached)), reached.copy()
        first = np.repeat(np.arange(len(rows)) * rows.shape[1], len(self.root))  # of the row's values
        next_nodes = np.stack([self.left, self.right], 1).reshape(-1)
        while True:
            column = self.feature[node]
            inner = np.flatnonzero(column != NO_FEATURE)
            if len(inner) == 0:
                return self.value[reached].reshape(len(rows), len(self.root)).astype(np.float64).sum(1)
            going, node, first, column = going[inner], node[inner], first[inner], column[inner]
            above = rows.reshape(-1)[first + column] > self.threshold[node]
            node = next_nodes[2 * node + above]
            reached[going] = node

    @classmethod
    def mean(cls, models: Sequence[BoostedTrees]) -> BoostedTrees:
        """Return trees whose score is the mean of the models' scores."""
        start = np.cumsum([0, *(len(m.feature) for m in models[:-1])], dtype=np.int32)

        def joined(field: str, shift: bool = False) -> np.ndarray:
            return np.concatenate([getattr(m, field) + (at if shift else 0) for m, at in zip(models, start, strict=True)])

        left, right, root = (joined(field, shift=True) for field in ("left", "right", "root"))
        value = joined("value") / np.float32(len(models))
        return cls(joined("feature"), joined("threshold"), left, right, value, root)

    def contributions(self, rows: Float[np.ndarray, "n k"]) -> Float[np.ndarray, "n k"]:
        """Return the contribution of each feature to the score of each row.

        These are the changes of value at the splits on the feature (Saabas, 2014).
        """
        rows = np.asarray(rows, np.float32)
        contributions = np.zeros(rows.shape)
        node = np.repeat(self.root[None], len(rows), 0)
        at = np.arange(len(rows))[:, None].repeat(len(self.root), 1)
        while (inner := self.feature[node] != NO_FEATURE).any():
            column = np.maximum(self.feature[node], 0)
            new = np.where(inner, np.where(rows[at, column] > self.threshold[node], self.right[node], self.left[node]), node)
            np.add.at(contributions, (at, column), np.where(inner, self.value[new] - self.value[node], 0.0))
            node = new
        return contributions

    def arrays(self, name: str) -> dict[str, np.ndarray]:
        """Return the arrays by the names that `from_arrays` uses."""
        return {f"{name}.{key}": value for key, value in vars(self).items()}

    @classmethod
    def from_arrays(cls, name: str, arrays: Mapping[str, np.ndarray]) -> BoostedTrees:
        """Build the trees from the result of `arrays`, for instance from an .npz file."""
        fields = ("feature", "threshold", "left", "right", "value", "root")
        return cls(*(arrays[f"{name}.{key}"] for key in fields))
