"""Learned scores of candidates: boosted trees on named features, and networks that see all candidates of an object together.

Both are evaluated from arrays; no training library is needed. In a network, each candidate is a token with its own features. In
each layer, a token takes up what it needs from the others (multi-head attention, Vaswani et al., 2017), with a bias per pair of
candidates that depends on how the two lie to each other.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Float32, Int16, Int32

from anymesh.types import Brief

HEADS = 4  # of the attention in each layer
PAIRS = 8000  # candidates' pairs that a network sees at once, which fit in a processor's cache
DIGITS = 3  # of a score; fewer than the digits in which the linear algebra of processors differs
PLACE_SCALES = (2.0, 3.0, 1.0, 1.0)  # of center, half extents, opening direction and thin axis as inputs
EPSILON = np.float32(1e-5)  # added to variances
LIMIT = np.float32(1.7)  # largest scaled feature; a uniform distribution up to it has a variance of 1
NO_FEATURE = -1  # value in `feature` of a leaf
REASONS = 3  # maximum number of notes in a reason
Note = tuple[float, float, str]  # least and greatest value of a feature for which the words hold
NO_NOTE: Note = (np.inf, -np.inf, "")
MIN_CONFIDENCE, MAX_CONFIDENCE = 0.05, 0.99  # range of confidences
MISSING = -9.0  # value of a feature that does not apply to a candidate
TREES, NETWORK = "trees", "network"  # how the names of arrays in a file begin; networks are numbered from 0


@runtime_checkable
class KindPrior(Protocol):
    """Adds to log-odds what is known of the moving parts of an object's kind (`anymesh.kinds.moving_parts`)."""

    def part_scores(self, score: np.ndarray, place: np.ndarray, clash: np.ndarray) -> Float[np.ndarray, " n"]: ...
    def motions(self, context: Any, motions: Any) -> Any: ...


@dataclass(frozen=True, eq=False)
class Classifier:
    """Classifier of candidates.

    trees: score each candidate by itself; networks: score all candidates of an object together, none for a classifier of
    trees alone; names: features in the order of columns; manifest: training data, settings, and the calibration of confidences,
    which is fitted to kinds left out of training.
    """

    trees: BoostedTrees
    networks: tuple[SetNetwork, ...]
    names: tuple[str, ...]
    manifest: dict[str, Any]

    @classmethod
    def read(cls, package: str, file: str) -> Classifier:
        """Read an .npz file of a package."""
        with (files(package) / file).open("rb") as opened:
            arrays = dict(np.load(opened))
        manifest = json.loads(bytes(arrays["manifest"]).decode())
        count = sum(name.startswith(NETWORK) and name.endswith(".knots") for name in arrays)
        networks = tuple(SetNetwork.from_arrays(f"{NETWORK}{k}", arrays) for k in range(count))
        return cls(BoostedTrees.from_arrays(TREES, arrays), networks, tuple(manifest["features"]), manifest)

    def table(self, features: Sequence[Mapping[str, float]]) -> Float[np.ndarray, "n k"]:
        """Return the features of all candidates in the order of columns."""
        return np.array([[row[name] for name in self.names] for row in features]).reshape(-1, len(self.names))

    def score(self, own: Float[np.ndarray, "n k"]) -> Float[np.ndarray, " n"]:
        """Return the log-odds of each candidate by itself."""
        return self.trees.score(own)

    def score_together(
        self, own: Float[np.ndarray, "n k"], place: Float[np.ndarray, "n 12"], relations: Float[np.ndarray, "n n r"]
    ) -> Float[np.ndarray, " n"]:
        """Return the log-odds of each candidate among all of its object, by the networks, the mean over four quarter turns.

        place: as from `PartContext.place`; relations: features of each pair.
        """
        ways = [(way, pair_inputs(way, relations)) for way in (turned(place, quarters) for quarters in range(4))]
        return np.mean([network.score(own, way, pairs) for network in self.networks for way, pairs in ways], axis=0)

    def probability(self, log_odds: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Return the probability that each candidate with these log-odds is right."""
        calibration = self.manifest["confidence"]
        return 1 / (1 + np.exp(-calibration["slope"] * log_odds - calibration["offset"]))

    def confidence(self, log_odds: float) -> float:
        """Return the probability that a choice with these log-odds is right, within the range of confidences."""
        return float(np.clip(self.probability(np.array([log_odds]))[0], MIN_CONFIDENCE, MAX_CONFIDENCE))

    def reasons(self, own: Float[np.ndarray, "n k"], notes: Mapping[str, Note]) -> list[str]:
        """Return up to three notes on each candidate, on the features that raised its score by the trees the most."""
        return [self._reason(row, g, notes) for row, g in zip(own, self.trees.contributions(own), strict=True)]

    def _reason(self, row: Float[np.ndarray, " k"], gain: Float[np.ndarray, " k"], notes: Mapping[str, Note]) -> str:
        words = list[str]()
        for k in np.argsort(-gain, kind="stable"):
            least, greatest, text = notes.get(self.names[k], NO_NOTE)
            if gain[k] > 0 and least <= row[k] <= greatest and text not in words:
                words.append(text)
        return ", ".join(words[:REASONS]) or "shaped and placed like other such parts"


@dataclass(frozen=True, eq=False)
class SetNetwork(Brief):
    """A network with its input scales.

    knots: (q, k) quantiles of each own feature, which map it to -LIMIT..LIMIT; weights: arrays by name, of
    `Linear`s as "NAME.weight" (out, in) and "NAME.bias" (out,), and of layer norms.
    """

    knots: Float32[np.ndarray, "q k"]
    weights: Mapping[str, np.ndarray]

    def score(
        self, own: Float[np.ndarray, "n k"], place: Float[np.ndarray, "n 12"], pairs: Float32[np.ndarray, "n n p"]
    ) -> Float[np.ndarray, " n"]:
        """Return the log-odds of each candidate.

        own: features, scaled by the knots; place: as from `PartContext.place`; pairs: as from `pair_inputs`.
        """
        if len(own) == 0:
            return np.zeros(0)
        tokens = np.concatenate([scaled(own, self.knots), place_tokens(place)], 1, dtype=np.float32)
        state = self._two("first", "second", tokens)
        step = max(1, PAIRS // len(own))
        blocks = (pairs[k : k + step].reshape(-1, pairs.shape[2]) for k in range(0, len(own), step))
        bias = np.concatenate([self._two("pair_first", "pair_second", some).T for some in blocks], 1)
        bias = bias.reshape(-1, len(own), len(own))  # for each head of each layer
        for k, layer in enumerate(self._layers):
            state = self._attend(layer, state, bias[k * HEADS : (k + 1) * HEADS])
        return np.round(self._linear("score", self._norm("norm", state))[:, 0].astype(float), DIGITS)

    def arrays(self, name: str) -> dict[str, np.ndarray]:
        """Return the arrays by the names that `from_arrays` uses, weights in half precision."""
        stored = {f"{name}.{key}": value.astype(np.float16) for key, value in self.weights.items()}
        return stored | {f"{name}.knots": self.knots}

    @classmethod
    def from_arrays(cls, name: str, arrays: Mapping[str, np.ndarray]) -> SetNetwork:
        """Build the network from the result of `arrays`, for instance from an .npz file."""
        start = f"{name}."
        weights = {key.removeprefix(start): value.astype(np.float32) for key, value in arrays.items() if key.startswith(start)}
        return cls(weights.pop("knots"), weights)

    @property
    def _layers(self) -> list[str]:
        return sorted({name.split(".")[0] for name in self.weights if name.startswith("layer")})

    def _attend(
        self, layer: str, state: Float32[np.ndarray, "n d"], bias: Float32[np.ndarray, "h n n"]
    ) -> Float32[np.ndarray, "n d"]:
        count, width = state.shape
        mixed = self._linear(f"{layer}.mix", self._norm(f"{layer}.norm", state))
        query, key, value = mixed.reshape(count, 3, HEADS, width // HEADS).transpose(1, 2, 0, 3)
        taken = np.empty((HEADS, count, width // HEADS), np.float32)
        for h in range(HEADS):
            likely = query[h] @ key[h].T
            likely /= np.float32(np.sqrt(width // HEADS))
            likely += bias[h]
            likely -= likely.max(1, keepdims=True)
            np.exp(likely, out=likely)
            likely /= likely.sum(1, keepdims=True)
            taken[h] = likely @ value[h]
        state = state + self._linear(f"{layer}.out", taken.transpose(1, 0, 2).reshape(count, width))
        return state + self._two(f"{layer}.up", f"{layer}.down", self._norm(f"{layer}.norm_up", state))

    def _two(self, first: str, second: str, x: Float32[np.ndarray, "n i"]) -> Float32[np.ndarray, "n o"]:
        inner = self._linear(first, x)
        return self._linear(second, np.maximum(inner, 0, out=inner))

    def _linear(self, name: str, x: Float32[np.ndarray, "n i"]) -> Float32[np.ndarray, "n o"]:
        out = x @ self.weights[f"{name}.weight"].T
        out += self.weights[f"{name}.bias"]
        return out

    def _norm(self, name: str, x: Float32[np.ndarray, "n d"]) -> Float32[np.ndarray, "n d"]:
        off = x - x.mean(1, keepdims=True)
        unit = off / np.sqrt((off * off).mean(1, keepdims=True) + EPSILON)
        return unit * self.weights[f"{name}.weight"] + self.weights[f"{name}.bias"]


def scaled(own: Float[np.ndarray, "n k"], knots: Float[np.ndarray, "q k"]) -> Float32[np.ndarray, "n k"]:
    """Return features mapped to -LIMIT..LIMIT by their quantiles; a value that has several quantiles to their mean."""
    levels, rises = np.linspace(-LIMIT, LIMIT, len(knots)), np.diff(knots, axis=0, prepend=-np.inf) > 0
    columns = []
    for values, known, first in zip(own.T, knots.T, rises.T, strict=True):
        of = np.cumsum(first) - 1
        mean = np.bincount(of, levels) / np.bincount(of)
        columns.append(np.interp(values, known[first], mean) if len(mean) > 1 else np.zeros(len(values)))
    return np.stack(columns, 1).astype(np.float32)


def turned(place: Float[np.ndarray, "n 12"], quarters: int, *, mirrored: bool = False) -> Float[np.ndarray, "n 12"]:
    """Return the places in an object that is turned by quarter turns about the upright axis, then mirrored along x."""
    vectors = place.reshape(-1, 4, 3).copy()
    for _ in range(quarters):
        vectors[..., 0], vectors[..., 1] = -vectors[..., 1], vectors[..., 0].copy()
    if mirrored:
        vectors[..., 0] *= -1
    vectors[:, 1] = np.abs(vectors[:, 1])  # extents
    largest = np.take_along_axis(vectors[:, 3], np.abs(vectors[:, 3]).argmax(1)[:, None], 1)
    vectors[:, 3] *= np.where(largest < 0, -1, 1)
    return vectors.reshape(-1, 12)


def place_tokens(place: Float[np.ndarray, "n 12"]) -> Float[np.ndarray, "n 12"]:
    """Return the place of each candidate as inputs of similar size."""
    return place * np.repeat(PLACE_SCALES, 3)


def pair_inputs(place: Float[np.ndarray, "n 12"], relations: Float[np.ndarray, "n n r"]) -> Float32[np.ndarray, "n n p"]:
    """Return the features of pairs, the offset of the second's center from the first's, and the cosine of their openings."""
    center, opening = place[:, :3], place[:, 6:9]
    offset = center[None] - center[:, None]
    return np.concatenate([relations, offset, (opening @ opening.T)[..., None]], 2, dtype=np.float32)


@dataclass(frozen=True, eq=False)
class BoostedTrees(Brief):
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
