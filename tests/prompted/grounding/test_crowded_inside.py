"""Test marks of a closed case with more things inside than one picture has numbers for."""

from __future__ import annotations

from functools import cache

import numpy as np
from assets import box, mesh_of
from made import smaller
from test_small_groundings import CASE, DOOR, Scripted, asking

from anymesh.config import Config
from anymesh.prompted.grounding.ground import ground_exactly
from anymesh.prompted.grounding.mark_questions import MAX_MARKS_PER_PICTURE
from anymesh.prompted.grounding.regrounding import ground_again
from anymesh.prompted.grounding.views import SampledObject, sample_object
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.prompting import PartFit
from anymesh.segmentation.divide import object_shape
from anymesh.types import Part, Segmentation

ROWS, FIRST = 7, 6  # things in a row; piece number of the first
THINGS = [
    box((0.1 + 0.12 * i, 0.4, 0.1 + 0.12 * k), (0.18 + 0.12 * i, 0.5, 0.18 + 0.12 * k))
    for i in range(ROWS)
    for k in range(ROWS)
]
NUMBERS = list(range(FIRST, FIRST + len(THINGS)))


@cache
def crowd() -> tuple[SampledObject, np.ndarray, VisualPrompts]:
    mesh, piece = mesh_of([*CASE, DOOR, *THINGS])
    config = Config(viewpoints="4@15+30,1@50+30")
    return sample_object(mesh, object_shape(mesh), config), piece, VisualPrompts(mesh, config)


def test_close_ups_of_the_inside_show_the_inside_with_all_its_marks() -> None:
    with smaller(240, 8_000):
        sampled, piece, prompts = crowd()
        who = Scripted(piece, {("bottle", 1): NUMBERS})
        found = ground_exactly(sampled, asking(who, prompts, "bottle"), None, lambda _: lambda *_: True, lambda *_: None)
    assert len(THINGS) > MAX_MARKS_PER_PICTURE
    assert set(NUMBERS) <= set[int]().union(*(who.pieces(k) for k in range(len(who.asked))))
    assert who.asked[0].inside
    assert set(piece[found.face_part == 1]) == set(NUMBERS)


def test_what_is_too_much_of_a_crowded_inside_is_asked_about_again_and_let_go() -> None:
    with smaller(240, 8_000):
        sampled, piece, prompts = crowd()
        before = Segmentation(np.isin(piece, NUMBERS).astype(np.int64), (Part("base", "base"), Part("rack", "rack")))
        who = Scripted(piece, {("rack", 1): NUMBERS[ROWS:]})
        found = ground_again(sampled, asking(who, prompts, "rack"), before, {"rack": PartFit.TOO_MUCH}, None)
    assert found is not None
    assert set(NUMBERS) <= who.pieces(0)
    assert set(piece[found.face_part == 1]) == set(NUMBERS[ROWS:])
