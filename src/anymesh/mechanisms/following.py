"""Joints that follow others, by a mimic or because of closed loops: which joints lead, and where the others are then."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from jaxtyping import Float

from anymesh.geometry.kinematics import Position, link_transforms
from anymesh.mechanisms.closing import closed, giving_way, loop_error, loop_gap
from anymesh.types import Asset, JointType
from anymesh.types.motion import leaders, led

STEP = 1e-5  # [rad or m] of a joint, to see what it does to the loops
FREE_RATIO = 1e-6  # of the largest singular value: below it, a direction of motion is free
OPEN = 1e-3  # share of the diagonal: a loop that misses by more is open
SAMPLES = 33  # of a leader's range


@lru_cache(maxsize=4)
def leading(asset: Asset) -> tuple[str, ...]:
    """Return the joints on loops that move by themselves: a joint to which those after it leave a choice leads."""
    joints, size = giving_way(asset), asset.mesh.diagonal
    rest, heads, rank = _error(asset, {}), [], 0
    turns = [list(STEP * np.eye(3)) if j.type is JointType.BALL else [STEP] for j in joints]
    ways = [[(_error(asset, {j.name: at}) - rest) / size / STEP for at in some] for j, some in zip(joints, turns, strict=True)]
    for k in reversed(range(len(joints))):
        values = np.linalg.svd(np.stack([way for some in ways[k:] for way in some], 1), compute_uv=False)
        now = int((values > FREE_RATIO * max(values[0], 1.0)).sum())
        heads, rank = [joints[k].name, *heads] if now == rank else heads, now
    return tuple(heads)


def _error(asset: Asset, positions: Mapping[str, Position]) -> Float[np.ndarray, " n"]:
    at, size = link_transforms(asset, positions), asset.mesh.diagonal
    return np.concatenate([np.zeros(0), *(loop_error(loop, at, size) for loop in asset.loops)])


def followers(asset: Asset) -> set[str]:
    """Return the names of the joints that do not move by themselves."""
    return {*leaders(asset.joints), *(j.name for j in giving_way(asset))} - {*leading(asset)}


def together(asset: Asset, positions: Mapping[str, float]) -> dict[str, Position]:
    """Return positions of joints, those that loops place by what leads; positions given for them have no effect."""
    placed = followers(asset)
    return closed(asset, {name: at for name, at in positions.items() if name not in placed})


def follower_tables(asset: Asset) -> dict[str, tuple[str, list[float]]]:
    """Return for each joint that follows its leader, and its positions at SAMPLES positions of that over its span.

    A loop that cannot close there leaves its joints where they were last. A ball is left out.
    """
    tables, heads = dict[str, tuple[str, list[float]]](), {*leading(asset), *(m.joint for m in leaders(asset.joints).values())}
    names = followers(asset) - {j.name for j in asset.joints if j.type is JointType.BALL}
    for joint in (j for j in asset.joints if j.name in heads - names):
        rows = _over_span(asset, joint.name, np.linspace(*joint.span, SAMPLES))
        for name in (j.name for j in asset.joints if j.name in names - tables.keys()):
            values = [float(row.get(name, 0.0)) for row in rows]
            if np.ptp(values) > OPEN * np.ptp(joint.span):
                tables[name] = joint.name, values
    return tables


def _over_span(asset: Asset, name: str, amounts: np.ndarray) -> list[Mapping[str, Position]]:
    """Return the positions of all joints that follow where one that leads has these amounts, from rest both ways."""
    rows, start = dict[float, Mapping[str, Position]](), int(np.abs(amounts).argmin())
    for way in (amounts[start:], amounts[:start][::-1]):
        last, closes = led(asset.joints, {name: 0.0}), True
        for amount in way.tolist():
            now = closed(asset, {name: amount}) if closes else {}
            closes = closes and loop_gap(asset, link_transforms(asset, now)) < OPEN
            rows[amount] = last = led(asset.joints, now) if closes else last
    return [rows[amount] for amount in amounts.tolist()]
