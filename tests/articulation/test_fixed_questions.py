"""Test that questions about joints and their results cannot be changed, and are compared by identity."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from assets import assert_fixed, box, mesh_of
from known import QUICK, true_answers, visual_prompts

from anymesh.articulation.prompted import PromptedJoints, Questions, _ChosenMotions
from anymesh.types import Part, Segmentation

MESH, PIECE = mesh_of([box((0, 0, 0), (1, 1, 1))])
SEGMENTATION = Segmentation(PIECE, (Part("base", "base"),))
WHO = true_answers(MESH, SEGMENTATION, ())

MAKERS = {
    "joints": lambda: PromptedJoints((), SEGMENTATION),
    "questions": lambda: Questions(visual_prompts(MESH), WHO, QUICK),
    "chosen motions": lambda: _ChosenMotions([], {}, SEGMENTATION),
}


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_a_result_cannot_be_changed_and_equals_itself_only(make: Callable[[], Any]) -> None:
    assert_fixed(make)
