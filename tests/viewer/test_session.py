"""A person at work on one asset, without a page: rays meet what is shown, previews change nothing, what is gone is let go."""

import numpy as np
import pytest
from correctable import write_output

from anymesh.correcting import CorrectionError, FlipSign, MergeParts, SetLimits, StaleError
from anymesh.viewer.session import Session

NOW = "2024-05-01T12:00:00+00:00"
FRONT, BACK = np.array([0.3, -5.0, 0.3]), np.array([0.0, 1.0, 0.0])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_output(tmp_path_factory.mktemp("session") / "out")


def opened(folder) -> Session:
    return Session(folder, "Ada", lambda: NOW)


def part_hit(session: Session, origin=FRONT, way=BACK) -> str | None:
    hit = session.hit(np.asarray(origin, float), np.asarray(way, float))
    return None if hit is None else session.asset.segmentation.parts[hit.part].name


def test_a_ray_meets_what_is_shown_where_it_is_shown(folder):
    session = opened(folder)
    assert part_hit(session) == "door"
    assert part_hit(session, (5, -5, 5)) is None
    session.positions = {"hinge": 1.6}
    assert part_hit(session) == "base"  # the door stands open
    hit = session.hit(np.array([0.61, -0.3, 0.3]) - 3 * np.array([-1.0, 0, 0]), np.array([-1.0, 0, 0]))
    assert hit is not None
    assert session.asset.segmentation.parts[hit.part].name == "door"
    corners = session.asset.mesh.triangles[hit.face]
    assert np.abs((hit.point - corners[0]) @ np.cross(corners[1] - corners[0], corners[2] - corners[0])) < 1e-6


def test_a_preview_is_shown_and_is_no_correction(folder):
    session = opened(folder)
    session.preview = SetLimits("door", 0.0, 0.5)
    assert session.shown.joints[0].limits == (0.0, 0.5)
    assert session.asset.joints[0].limits == (0.0, 1.9)
    assert not session.unsaved


def test_what_is_gone_is_let_go(folder):
    session = opened(folder)
    session.selected, session.positions = "knob", {"hinge": 1.8, "turn": 2.0}
    session.chosen = np.array([1, 2])
    session.correct(MergeParts("knob", "drawer"))
    assert session.selected is None
    assert len(session.chosen) == 0
    session.correct(SetLimits("door", 0.0, 1.0))
    assert session.positions == {"hinge": 1.0, "slide": 0.0}
    session.undo()
    session.undo()
    assert not session.unsaved
    with pytest.raises(CorrectionError):
        session.undo()


def test_motions_are_of_the_part_that_is_selected(folder):
    session = opened(folder)
    with pytest.raises(CorrectionError, match="select a part"):
        session.motions()
    session.selected = "drawer"
    assert {m.part for m in session.motions()} == {"drawer"}


def test_two_people_do_not_overwrite_each_other(tmp_path):
    folder = write_output(tmp_path / "out")
    mine, theirs = opened(folder), opened(folder)
    theirs.correct(SetLimits("door", 0.0, 1.0))
    theirs.save()
    mine.correct(FlipSign("door"))
    with pytest.raises(StaleError):
        mine.save()
    assert mine.unsaved
    mine = opened(folder)
    assert mine.asset.joints[0].limits == (0.0, 1.0)
