"""Test that candidates, regions and answers about marks cannot be changed, and are compared by identity."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from assets import assert_fixed
from test_part_candidates import BODY, HANDLE, LEAF, candidates
from test_small_groundings import Scripted, asking, scene

from anymesh.config import Config
from anymesh.segmentation.ask_marks import MarkAnswers
from anymesh.segmentation.grounded_parts import GroundedParts, SampledObject, ShownViews
from anymesh.segmentation.part_candidates import Overlap
from anymesh.segmentation.part_features import FeatureInputs
from anymesh.segmentation.propose import Proposal
from anymesh.segmentation.regions import Marks

MARKS, NONE, WHO = Marks(np.array([1])), np.zeros(1, bool), Scripted(np.zeros(1, np.int64), {})


def sampled() -> SampledObject:
    one = scene(False)[0]
    return SampledObject(one.mesh, one.whole, one.cloud)


MAKERS = {
    "overlap": lambda: Overlap(np.ones((1, 3)), np.eye(1)),
    "tree": lambda: candidates([BODY, *LEAF, HANDLE]),
    "features": lambda: FeatureInputs(candidates([BODY, HANDLE]), Config(), np.ones((2, 1))),
    "proposal": lambda: Proposal(0, np.ones((2, 2), np.int64), (1,)),
    "sampled object": sampled,
    "views": lambda: ShownViews([], [], NONE),
    "parts": lambda: GroundedParts(np.zeros(1, np.int64), NONE, (), (), (), frozenset()),
    "questioner": lambda: asking(WHO, scene(False)[2], "door"),
    "answers": lambda: MarkAnswers(MARKS, (), frozenset()),
}


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_a_result_cannot_be_changed_and_equals_itself_only(make: Callable[[], Any]) -> None:
    assert_fixed(make)
