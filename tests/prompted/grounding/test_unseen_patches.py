"""Test patches that no view shows: a drawer keeps its box, a door does not gain the cavity behind it."""

import numpy as np
from assets import box, mesh_of

from anymesh.articulation.estimate import stays_free
from anymesh.config import Config
from anymesh.geometry.patches import ObjectShape
from anymesh.pipeline.solving import Solver
from anymesh.prompted.grounding.faces import join_unseen
from anymesh.types import JointType

WALLS = [box((0, 0, 0), (1, 1, 0.02)), box((0, 0, 0.98), (1, 1, 1)), box((0, 0, 0.02), (0.02, 1, 0.98)),
         box((0.98, 0, 0.02), (1, 1, 0.98)), box((0.02, 0.98, 0.02), (0.98, 1, 0.98))]  # fmt: skip
FRONT = box((0.05, -0.05, 0.05), (0.95, -0.002, 0.95))
BIN = box((0.1, -0.002, 0.1), (0.9, 0.8, 0.9))  # behind the panel, touching nothing else


def pieces(*more) -> tuple[ObjectShape, np.ndarray]:
    """Return the shape and the part of each of its patches.

    The panel is part 1, and patches behind it are unseen.
    """
    mesh, piece = mesh_of([*WALLS, FRONT, *more])
    whole = Solver(mesh).geometry.whole
    of = np.zeros(int(whole.mesh_patch.max()) + 1, int)
    of[whole.mesh_patch] = piece
    return whole, np.where(of < 5, 0, np.where(of == 5, 1, -1))


def test_a_part_gains_what_it_holds_unless_it_is_less_free_with_it() -> None:
    whole, part = pieces(BIN)
    asked = []

    def stays_free(without: np.ndarray, joined: np.ndarray, k: int) -> bool:
        asked.append((k, set(without[joined != without].tolist()), set(joined[joined != without].tolist())))
        return len(asked) == 1

    for expected in (1, 0):
        found = join_unseen(whole, part, Config(), stays_free)
        assert found[part < 0].tolist() == [expected]
        assert (found[part >= 0] == part[part >= 0]).all()
    assert asked == [(1, {0}, {1})] * 2
    assert join_unseen(whole, part, Config())[part < 0].tolist() == [1]


def test_a_drawer_slides_as_far_with_its_box_and_a_door_does_not_turn_with_it() -> None:
    whole, part = pieces(BIN)
    config = Config().articulation
    joined, alone = np.where(part < 0, 1, part)[whole.patch], np.maximum(part, 0)[whole.patch]
    assert stays_free(whole, config, alone, joined, 1, JointType.PRISMATIC)
    assert not stays_free(whole, config, alone, joined, 1, JointType.REVOLUTE)
    assert stays_free(whole, config, alone, joined, 1)  # without a recognized motion it may be a drawer
