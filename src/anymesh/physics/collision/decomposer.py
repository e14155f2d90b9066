"""Decomposition in child processes.

A crash, hang or excessive memory use affects the method for one component, and not the run.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from anymesh.isolation import DECOMPOSER, ChildError, ChildPool, Failure
from anymesh.physics.collision.convex import hull_of
from anymesh.physics.collision.decompose import Component, Method, Resolution, component_shapes
from anymesh.physics.collision.primitives import shifted
from anymesh.physics.collision.store import content_key, load_shapes, save_shapes
from anymesh.types import Shape

DIGITS = 30  # binary digits of the coordinates of a component, so that copies at different places become equal
TINY = 1e-12  # [m] minimum size of a component
BATCH_FACES = 2000  # faces of small components per call
PER_FACE = 2e-5  # [s] added to the limit of a call per face, since simplifying millions of faces takes longer than the division
ONE_BY_ONE = 64  # number of components up to which each has its own call, so that the child processes share the slow ones


@dataclass(frozen=True)
class Fallback:
    """A component whose division failed: what failed and why, and the method used instead."""

    reasons: tuple[str, ...]
    used: str


@dataclass(frozen=True, eq=False)
class Divided:
    """The shapes of a component.

    fallback: None unless the first method failed.
    """

    shapes: tuple[Shape, ...]
    fallback: Fallback | None = None


@dataclass(frozen=True, eq=False)
class Decomposer:
    """Divides components in the child processes of a pool; results are cached in `cache` by content.

    seconds: processor time per call [s], plus PER_FACE for every face.
    """

    pool: ChildPool
    cache: Path | None
    seconds: float
    methods: tuple[Method, ...] = tuple(Method)

    def divide(self, components: Sequence[Component], resolution: Sequence[Resolution]) -> list[Divided]:
        """Return the shapes of each component, in their order. Failures of child processes never raise.

        Components that differ by a shift only are divided once.
        """
        low = [c.triangles.reshape(-1, 3).min(0) for c in components]
        local = [_at_origin(c, corner) for c, corner in zip(components, low, strict=True)]
        keys = [content_key(c.triangles, c.solid, f.gap, f.wall, f.max_pieces) for c, f in zip(local, resolution, strict=True)]
        divided_by_key = {key: Divided(shapes) for key in set(keys) if (shapes := load_shapes(self.cache, key)) is not None}
        todo = {key: k for k, key in reversed(list(enumerate(keys))) if key not in divided_by_key}
        order = sorted(todo.values())
        calls = [
            [(local[order[n]], resolution[order[n]]) for n in batch]
            for batch in _batches([len(local[k].triangles) for k in order])
        ]
        with ThreadPoolExecutor(self.pool.size) as threads:
            made = [d for some in threads.map(self._divide_batch, calls) for d in some]
        for k, divided in zip(order, made, strict=True):
            divided_by_key[keys[k]] = divided
            if divided.fallback is None:
                save_shapes(self.cache, keys[k], divided.shapes)
        return [
            Divided(tuple(shifted(s, corner) for s in divided_by_key[key].shapes), divided_by_key[key].fallback)
            for key, corner in zip(keys, low, strict=True)
        ]

    def _divide_batch(self, batch: list[tuple[Component, Resolution]]) -> list[Divided]:
        """Divide a batch in one call, or one by one if that fails, so that one component does not affect the others."""
        try:
            return [Divided(shapes) for shapes in self._call(batch, self.methods[0])]
        except ChildError as error:
            if len(batch) > 1:
                return [d for pair in batch for d in self._divide_batch([pair])]
            slow = error.failure is Failure.TIME  # cleaning does not help if the division takes too long
            methods = self.methods[-1:] if slow else self.methods[1:]
            return [self._fall_back(*batch[0], methods, f"{self.methods[0].value}: {error}")]

    def _fall_back(self, component: Component, resolution: Resolution, methods: Sequence[Method], reason: str) -> Divided:
        reasons = [reason]
        for method in methods:
            try:
                (shapes,) = self._call([(component, resolution)], method)
                return Divided(shapes, Fallback(tuple(reasons), method.value))
            except ChildError as error:
                reasons.append(f"{method.value}: {error}")
        hull = hull_of(component.triangles.reshape(-1, 3), resolution.wall)
        return Divided(() if hull is None else (hull,), Fallback(tuple(reasons), "one convex hull"))

    def _call(self, batch: list[tuple[Component, Resolution]], method: Method) -> list[tuple[Shape, ...]]:
        arguments = {"batch": batch, "method": method}
        seconds = self.seconds + PER_FACE * sum(len(component.triangles) for component, _ in batch)
        return self.pool.run(DECOMPOSER, "divide_here", arguments, seconds=seconds)


def _at_origin(component: Component, corner: np.ndarray) -> Component:
    """Return the component with a corner of its bounds at 0, rounded, so that copies become equal."""
    moved = component.triangles - corner
    step = float(np.exp2(np.floor(np.log2(max(float(moved.max()), TINY))) - DIGITS))
    return Component(np.round(moved / step) * step, component.solid)


def divide_here(batch: list[tuple[Component, Resolution]], method: Method) -> list[tuple[Shape, ...]]:
    """Divide components in this process; runs in the child processes."""
    return [component_shapes(component, resolution, method) for component, resolution in batch]


def _batches(sizes: Sequence[int]) -> list[range]:
    """Return consecutive indices whose sizes add up to about BATCH_FACES; larger ones, and few ones, are separate."""
    if len(sizes) <= ONE_BY_ONE:
        return [range(k, k + 1) for k in range(len(sizes))]
    total = np.cumsum(np.minimum(sizes, BATCH_FACES))
    ends = np.flatnonzero(np.diff(total // BATCH_FACES)) + 1
    return [range(int(a), int(b)) for a, b in pairwise([0, *ends, len(sizes)])]
