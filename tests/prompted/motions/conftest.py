"""Test articulation with results that the questions of several tests share."""

from collections.abc import Iterator
from unittest.mock import patch

import pytest
from known import cases_once, scored_once
from made import smaller

from anymesh.prompted.motions import joints as prompted
from anymesh.prompted.motions import lines, offers


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    """Draw pictures at half the resolution, in which numbers may be half as far apart."""
    with smaller(320, 8_000), patch.object(lines, "MIN_LABEL_DISTANCE", 17.5):
        yield


@pytest.fixture
def computed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the cases of a scene and sweep their motions once, whatever is answered about them."""
    monkeypatch.setattr(prompted, "make_cases", cases_once)
    monkeypatch.setattr(offers, "scored_motions", scored_once)
