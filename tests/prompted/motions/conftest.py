"""Test articulation with results that the questions of several tests share."""

import pytest
from known import cases_once, scored_once

from anymesh.prompted.motions import joints as prompted
from anymesh.prompted.motions import offers


@pytest.fixture
def computed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the cases of a scene and sweep their motions once, whatever is answered about them."""
    monkeypatch.setattr(prompted, "make_cases", cases_once)
    monkeypatch.setattr(offers, "scored_motions", scored_once)
