"""A history undoes and redoes exactly, and its log makes the same asset again."""

import json
from dataclasses import fields

import numpy as np
import pytest
from assets import cabinet
from hypothesis import given
from hypothesis import strategies as st

from anymesh.correcting import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    CorrectionError,
    FaceSet,
    FlipSign,
    History,
    HistoryEntry,
    MergeParts,
    MoveFaces,
    Relabel,
    Rename,
    SetAxis,
    SetLimits,
    SplitComponents,
    SplitPart,
)
from anymesh.correcting.log import KINDS, describe, pack_log, unpack_log
from anymesh.types import JointType

ONE_OF_EACH = (
    ChangeType("door", JointType.CONTINUOUS),
    SetLimits("door", -0.25, 1.5),
    FlipSign("door"),
    SetAxis("door", (0.0, 0.6, 0.8), (0.1, 0.2, 0.3), "snapped to an edge"),
    ChooseMotion("drawer", JointType.PRISMATIC, (0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.3), 0.4, "slides outwards"),
    SplitPart("door", FaceSet(((72, 74),)), "tab", "tab"),
    MoveFaces(FaceSet(((74, 76), (77, 78))), "tab"),
    ChangeParent("knob", "door"),
    Relabel("tab", "Griff ü"),
    Rename("tab", "grip"),
    MergeParts("drawer", "base"),
    MergeParts("knob", "door"),
    SplitComponents("door"),
)


def entries(corrections):
    return tuple(HistoryEntry(c, f"2024-05-0{1 + i % 9}T12:00:00+00:00", "Ada") for i, c in enumerate(corrections))


def same(a, b) -> None:
    assert a.segmentation.parts == b.segmentation.parts
    np.testing.assert_array_equal(a.segmentation.face_part, b.segmentation.face_part)
    assert a.warnings == b.warnings
    for x, y in zip(a.joints, b.joints, strict=True):
        for field in fields(x):
            np.testing.assert_array_equal(getattr(x, field.name), getattr(y, field.name))


def test_every_kind_is_tried_here():
    assert {type(c) for c in ONE_OF_EACH} == set(KINDS.values())
    assert all(describe(c) for c in ONE_OF_EACH)


def test_the_log_replays_to_the_same_asset_bit_for_bit():
    history = History.of(cabinet(), entries(ONE_OF_EACH))
    text = json.dumps(pack_log(history.done), allow_nan=False)
    log = unpack_log(json.loads(text))
    assert log == history.done
    same(History.of(cabinet(), log).asset, history.asset)


@given(st.integers(0, len(ONE_OF_EACH)), st.integers(0, len(ONE_OF_EACH)))
def test_undo_is_exact_and_redo_brings_back(done, undone):
    history = start = History.of(cabinet(), entries(ONE_OF_EACH[:done]))
    for _ in range(min(undone, done)):
        history = history.undo()
    assert history.asset is start.states[done - min(undone, done)]
    for _ in range(min(undone, done)):
        history = history.redo()
    same(history.asset, start.asset)
    assert history.done == start.done


def test_a_new_correction_ends_what_could_be_redone():
    history = History.of(cabinet(), entries(ONE_OF_EACH[:2])).undo().do(*entries([FlipSign("door")]))
    assert history.undone == ()
    with pytest.raises(CorrectionError, match="nothing to redo"):
        history.redo()


def test_a_correction_that_is_refused_changes_nothing():
    history = History.of(cabinet())
    with pytest.raises(CorrectionError):
        history.do(*entries([FlipSign("nothing")]))
    assert history.done == ()
    with pytest.raises(CorrectionError, match="nothing to undo"):
        history.undo()


@pytest.mark.parametrize(
    "record",
    [{"correction": "explode"}, {}, {"correction": "flip_sign", "time": "", "author": ""}, {"correction": "change_type",
     "part": "door", "type": "wobbly", "time": "", "author": ""}],
)  # fmt: skip
def test_a_log_that_cannot_be_read_is_refused(record):
    with pytest.raises(CorrectionError):
        unpack_log([record])
