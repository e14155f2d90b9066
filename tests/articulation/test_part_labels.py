"""Test the label of a part from its motion; a part that hardly moves has none."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.articulation.estimate import choose_motion, motion_questions
from anymesh.articulation.rank_motions import label_of
from anymesh.config import Config
from anymesh.segmentation.divide import object_shape
from anymesh.types import Part, Segmentation


def chest(stop: bool) -> list:
    """Return a case with one drawer and its handle, and optionally a bar in front that stops it."""
    walls = [box((0, 0, 0), (0.6, 0.4, 0.02)), box((0, 0, 0.28), (0.6, 0.4, 0.3)), box((0.02, 0.38, 0.02), (0.58, 0.4, 0.28))]
    walls += [box((x, 0, 0.02), (x + 0.02, 0.4, 0.28)) for x in (0, 0.58)]
    front = [box((0.025, 0, 0.025), (0.575, 0.02, 0.275)), box((0.2, -0.03, 0.14), (0.4, 0, 0.15))]
    tray = [box((0.03, 0.02, 0.03), (0.57, 0.35, 0.04)), box((0.03, 0.34, 0.04), (0.57, 0.35, 0.2))]
    bar = [box((0, -0.005, 0.2), (0.6, -0.004, 0.3)), box((0, -0.004, 0.285), (0.6, 0, 0.295))]
    return [*walls, *front, *tray, *(bar if stop else [])]


def label(solids: list, moving: list[int]) -> str:
    """Return the label of one part of an object."""
    mesh, number = mesh_of(solids)
    segmentation = Segmentation(np.isin(number, moving).astype(np.int64), (Part("base", "base"), Part("it", "part")))
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    _, _, context, question = next(iter(motion_questions(whole, segmentation, Config())))
    return label_of(context, choose_motion(context, question)[1])


@pytest.mark.parametrize(("stop", "expected"), [(False, "drawer"), (True, "")])
def test_a_drawer_comes_out_or_is_none(stop: bool, expected: str) -> None:
    assert label(chest(stop), [5, 6, 7, 8]) == expected


def test_a_plate_on_top_is_a_lid() -> None:
    walls = [box((0, 0, 0), (1, 0.6, 0.02)), box((0, 0, 0.02), (1, 0.02, 0.4)), box((0, 0.58, 0.02), (1, 0.6, 0.4))]
    walls += [box((x, 0.02, 0.02), (x + 0.02, 0.58, 0.4)) for x in (0, 0.98)]
    assert label([*walls, box((0, 0, 0.402), (1, 0.6, 0.42))], [5]) == "lid"
