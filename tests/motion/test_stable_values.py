"""Test that what is read off a part does not depend on chance: on which points of its surface are sampled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import CABINET, box
from geometry.rigid import shape_of

from anymesh.config import ArticulationConfig
from anymesh.geometry.triangle_set import body_obb
from anymesh.motion.part_context import MIN_LEAD, PartContext, best_direction

SEEDS = range(5)


def seeded(part: list, others: list, seed: int) -> PartContext:
    corners = np.concatenate([v for v, _ in [*part, *others]])
    low, high = corners.min(0), corners.max(0)
    own, rest = (replace(shape_of(*pieces), seed=seed) for pieces in (part, others))
    diagonal = float(np.linalg.norm(high - low))
    return PartContext(own, rest, rest, None, rest, (), diagonal, (low + high) / 2, ArticulationConfig())


@pytest.mark.parametrize("seed", SEEDS)
def test_a_knob_of_a_thousandth_of_the_surface_is_a_handle(seed: int) -> None:
    knob = box((0.05, -0.032, 0.3), (0.062, -0.02, 0.312))
    around = seeded([*CABINET["door"], knob], CABINET["base"], seed)
    assert shape_of(knob).area < 1.2e-3 * around.part.area
    assert around.handle is not None
    assert around.handle.size == pytest.approx(0.012 / around.body_obb.diagonal, rel=0.05)


@pytest.mark.parametrize(("height", "found"), [(0.014, True), (0.009, False)], ids=["ring", "moulding"])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_handle_is_at_least_a_fifth_as_high_as_it_is_wide(seed: int, height: float, found: bool) -> None:
    low = box((0.04, -0.02 - height, 0.28), (0.1, -0.02, 0.35))
    assert (seeded([*CABINET["door"], low], CABINET["base"], seed).handle is not None) is found


@pytest.mark.parametrize("seed", SEEDS)
def test_the_outline_of_a_plate_is_seen_along_its_thickness(seed: int) -> None:
    """None of its outlines is round, so that which is the roundest is chance."""
    plate = [box((0, -0.02, 0), (0.6, 0, 0.5)), box((0.2, -0.022, 0.2), (0.4, -0.02, 0.3))]
    outline = seeded(plate, [box((0, 0, 0), (0.6, 0.4, 0.5))], seed).outline
    assert abs(outline.axis[1]) == pytest.approx(1)
    assert outline.height == pytest.approx(0.022)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_part_that_is_open_to_both_sides_opens_to_the_positive_one(seed: int) -> None:
    leaf, posts = [box((0, -0.02, 0), (0.6, 0.02, 1))], [box((x, -0.05, 0), (x + 0.1, 0.05, 1)) for x in (-0.1, 0.6)]
    assert seeded(leaf, posts, seed).opening_direction == pytest.approx([0, 1, 0])


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_part_that_is_open_to_both_sides_opens_away_from_the_middle(seed: int, side: int) -> None:
    """As a thin door in its frame, with a box of the object's on one side of it."""
    leaf, posts = [box((0, -0.02, 0), (0.6, 0.02, 1))], [box((x, -0.05, 0), (x + 0.1, 0.05, 1)) for x in (-0.1, 0.6)]
    step = box((-0.1, -0.05 - 0.02 * side, -0.1), (0.7, 0.05 - 0.02 * side, 0))
    assert seeded(leaf, [*posts, step], seed).opening_direction == pytest.approx([0, side, 0])


def test_a_direction_must_clearly_lead_over_the_opposite_one() -> None:
    scores, outwards = np.array([0.1, 0.2, 0.8, 0.8 + 0.9 * MIN_LEAD, 0.5, 0.4]), np.zeros(6)
    assert best_direction(scores, outwards) == 2  # in the middle the positive one
    outwards[2:4] = -0.1, 0.1
    assert best_direction(scores, outwards) == 3
    outwards[2:4] = 0.1, -0.1
    assert best_direction(scores, outwards) == 2
    scores[3] = 0.8 + 1.1 * MIN_LEAD
    assert best_direction(scores, outwards) == 3
    scores[4] = scores[3] + 0.1 * MIN_LEAD  # along another axis, no lead is needed
    assert best_direction(scores, outwards) == 4


@pytest.mark.parametrize("seed", SEEDS)
def test_a_pin_is_a_protrusion_whatever_is_sampled(seed: int) -> None:
    """Its surface is .02 % of the key's, less than one of its 3000 samples."""
    key = [box((0, 0, 0), (0.02, 0.02, 0.006)), box((0.00995, 0.00995, 0.006), (0.01005, 0.01005, 0.0066))]
    part = replace(shape_of(*key), seed=seed)
    assert sorted(body_obb(part).half) == pytest.approx([0.003, 0.01, 0.01])


@pytest.mark.parametrize("seed", SEEDS)
def test_the_centroid_is_exact(seed: int) -> None:
    shape = replace(shape_of(box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (4, 1, 1))), seed=seed)
    assert shape.centroid == pytest.approx([(6 * 0.5 + 10 * 3) / 16, 0.5, 0.5])
