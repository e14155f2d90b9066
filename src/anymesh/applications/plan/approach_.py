"""Collision-free path of the arm between two postures: RRT-Connect of OMPL, then shortcutting."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.errors import MissingExtraError, pip_install

Valid = Callable[[Float[np.ndarray, " J"]], bool]
STRIDE = 0.03  # [rad] between postures that are checked for collision
SHORTCUTS = 120  # attempts to shorten the path
CHECKS = 30_000  # postures that are checked for collision before the search gives up


def free_path(
    start: Float[np.ndarray, " J"],
    goal: Float[np.ndarray, " J"],
    low: Float[np.ndarray, " J"],
    high: Float[np.ndarray, " J"],
    valid: Valid,
    *,
    seed: int,
    checks: int = CHECKS,
) -> Float[np.ndarray, "k J"] | None:
    """Compute a collision-free path of straight segments from start to goal; None if `checks` postures do not give one.

    low, high: (J,) limits [rad]. The path depends only on the seed.
    Raise MissingExtraError if OMPL is not installed.
    """
    if straight_is_free(start, goal, valid):
        return np.stack([start, goal])
    try:
        from ompl import base, geometric, util
    except ImportError:
        raise MissingExtraError(f"ompl is missing; install it with {pip_install('plan')}") from None
    path = _rrt(base, geometric, util, (start, goal, low, high), valid, seed, checks)
    return None if path is None else _shortcut(path, valid, np.random.default_rng(seed))


def _rrt(
    base: Any, geometric: Any, util: Any, problem: tuple[np.ndarray, ...], valid: Valid, seed: int, checks: int
) -> np.ndarray | None:
    start, goal, low, high = problem
    count = len(start)
    util.noOutputHandler()
    util.RNG.setSeed(seed + 1)  # seeds every generator created afterwards; 0 would mean the clock
    space = base.RealVectorStateSpace(count)
    bounds = base.RealVectorBounds(count)
    for k in range(count):
        bounds.setLow(k, float(min(low[k], start[k], goal[k])))
        bounds.setHigh(k, float(max(high[k], start[k], goal[k])))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)
    done = 0

    def is_valid(state: Any) -> bool:
        nonlocal done
        done += 1
        return bool(valid(np.array([state[k] for k in range(count)])))

    setup.setStateValidityChecker(is_valid)
    information = setup.getSpaceInformation()
    information.setStateValidityCheckingResolution(STRIDE / space.getMaximumExtent())
    ends = [space.allocState(), space.allocState()]
    for state, posture in zip(ends, (start, goal), strict=True):
        for k in range(count):
            state[k] = float(posture[k])
    setup.setStartAndGoalStates(*ends)
    planner = geometric.RRTConnect(information)
    planner.setRange(0.6)
    setup.setPlanner(planner)
    setup.solve(base.PlannerTerminationCondition(lambda: done >= checks))
    if not setup.haveExactSolutionPath():
        return None
    return np.array([[state[k] for k in range(count)] for state in setup.getSolutionPath().getStates()])


def straight_is_free(a: Float[np.ndarray, " J"], b: Float[np.ndarray, " J"], valid: Valid) -> bool:
    """Return whether the straight segment between two postures is collision-free, ends included."""
    count = max(2, int(np.ceil(np.linalg.norm(b - a) / STRIDE)) + 1)
    order = np.argsort([_bits(k) for k in range(count)])  # the middle first, where collisions are most likely
    return all(valid(a + (b - a) * k / (count - 1)) for k in order)


def _bits(k: int) -> float:
    """Return element `k` of the van der Corput sequence in base 2."""
    value, scale = 0.0, 0.5
    while k:
        value, k, scale = value + scale * (k & 1), k >> 1, scale / 2
    return value


def _shortcut(path: np.ndarray, valid: Valid, rng: np.random.Generator) -> np.ndarray:
    """Replace detours of a path by straight segments where these are collision-free."""
    for _ in range(SHORTCUTS):
        if len(path) < 3:
            break
        i, j = sorted(rng.integers(0, len(path), 2))
        if j - i >= 2 and straight_is_free(path[i], path[j], valid):
            path = np.concatenate([path[: i + 1], path[j:]])
            continue
        i = int(rng.integers(0, len(path) - 2))
        t, s = rng.random(2)
        a, b = path[i] + t * (path[i + 1] - path[i]), path[i + 1] + s * (path[i + 2] - path[i + 1])
        if straight_is_free(a, b, valid):
            path = np.concatenate([path[: i + 1], a[None], b[None], path[i + 2 :]])
    return path
