"""Evaluation of small networks that score all candidates of an object at once; no training library is needed.

Each candidate is a token with its own features. In each layer, a token takes up what it needs from the others (multi-head
attention, Vaswani et al., 2017), with a bias per pair of candidates that depends on how the two lie to each other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32

HEADS = 4  # of the attention in each layer
DIGITS = 3  # of a score; fewer than the digits in which the linear algebra of processors differs
PLACE_SCALES = (2.0, 3.0, 1.0, 1.0)  # of center, half extents, opening direction and thin axis as inputs
EPSILON = np.float32(1e-5)  # added to variances


@dataclass(frozen=True, eq=False)
class SetNetwork:
    """A network with its input scales.

    knots: (q, k) quantiles of each own feature, which map it to -LIMIT..LIMIT; weights: arrays by name, of
    `Linear`s as "NAME.weight" (out, in) and "NAME.bias" (out,), and of layer norms.
    """

    knots: Float32[np.ndarray, "q k"]
    weights: Mapping[str, np.ndarray]

    def score(
        self, own: Float[np.ndarray, "n k"], place: Float[np.ndarray, "n 12"], relations: Float[np.ndarray, "n n r"]
    ) -> Float[np.ndarray, " n"]:
        """Return the log-odds of each candidate.

        own: features, scaled by the knots; place: as from `PartContext.place`; relations: features of each pair.
        """
        if len(own) == 0:
            return np.zeros(0)
        tokens = np.concatenate([scaled(own, self.knots), place_tokens(place)], 1, dtype=np.float32)
        pairs = np.concatenate([relations, place_pairs(place)], 2, dtype=np.float32)
        state = self._linear("second", _relu(self._linear("first", tokens)))
        bias = self._linear("pair_second", _relu(self._linear("pair_first", pairs)))
        for k, layer in enumerate(self._layers):
            state = self._attend(layer, state, bias[..., k * HEADS : (k + 1) * HEADS])
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
        self, layer: str, state: Float32[np.ndarray, "n d"], bias: Float32[np.ndarray, "n n h"]
    ) -> Float32[np.ndarray, "n d"]:
        count, width = state.shape
        mixed = self._linear(f"{layer}.mix", self._norm(f"{layer}.norm", state))
        query, key, value = mixed.reshape(count, 3, HEADS, width // HEADS).transpose(1, 2, 0, 3)
        logits = query @ key.transpose(0, 2, 1) / np.float32(np.sqrt(width // HEADS)) + bias.transpose(2, 0, 1)
        likely = np.exp(logits - logits.max(2, keepdims=True))
        taken = (likely / likely.sum(2, keepdims=True)) @ value
        state = state + self._linear(f"{layer}.out", taken.transpose(1, 0, 2).reshape(count, width))
        inner = _relu(self._linear(f"{layer}.up", self._norm(f"{layer}.norm_up", state)))
        return state + self._linear(f"{layer}.down", inner)

    def _linear(self, name: str, x: Float32[np.ndarray, "... i"]) -> Float32[np.ndarray, "... o"]:
        return x @ self.weights[f"{name}.weight"].T + self.weights[f"{name}.bias"]

    def _norm(self, name: str, x: Float32[np.ndarray, "n d"]) -> Float32[np.ndarray, "n d"]:
        off = x - x.mean(1, keepdims=True)
        unit = off / np.sqrt((off * off).mean(1, keepdims=True) + EPSILON)
        return unit * self.weights[f"{name}.weight"] + self.weights[f"{name}.bias"]


LIMIT = np.float32(1.7)  # largest scaled feature; a uniform distribution up to it has a variance of 1


def scaled(own: Float[np.ndarray, "n k"], knots: Float[np.ndarray, "q k"]) -> Float32[np.ndarray, "n k"]:
    """Return features mapped to -LIMIT..LIMIT by their quantiles; a value that has several quantiles to their mean."""
    levels = np.linspace(-LIMIT, LIMIT, len(knots))
    columns = []
    for values, known in zip(own.T, knots.T, strict=True):
        steps, of = np.unique(known, return_inverse=True)
        mean = np.bincount(of, levels) / np.bincount(of)
        columns.append(np.interp(values, steps, mean) if len(steps) > 1 else np.zeros(len(values)))
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


def place_pairs(place: Float[np.ndarray, "n 12"]) -> Float[np.ndarray, "n n 4"]:
    """Return the offset of the second candidate's center from the first's, and the cosine of their opening directions."""
    center, opening = place[:, :3], place[:, 6:9]
    return np.concatenate([center[None] - center[:, None], (opening @ opening.T)[..., None]], 2)


def _relu(x: np.ndarray) -> np.ndarray:
    return np.maximum(x, 0)
