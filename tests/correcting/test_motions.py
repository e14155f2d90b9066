"""The ranked motions of a part hold the one it was built with, and each can be chosen."""

from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet

from anymesh.correcting import ChooseMotion, CorrectionError, SetMimic, apply, ranked_motions
from anymesh.correcting.motions import made_ready, motion_faults, motion_words, told_apart
from anymesh.types import JointType


@pytest.fixture(scope="module")
def ready():
    asset = cabinet()
    return asset, made_ready(asset)


def test_the_hinge_of_the_door_is_among_its_motions(ready):
    asset, made = ready
    found = ranked_motions(asset, "door", ready=made)
    shares = [m.confidence for m in found]
    assert shares == sorted(shares, reverse=True)
    assert 0 < sum(shares) <= 1 + 1e-9
    hinges = [m for m in found if m.type is JointType.REVOLUTE and abs(m.axis[2]) > 0.99]
    assert min(abs(m.origin[0] - 0.6) for m in hinges) < 0.02  # it was built there
    for motion in found:
        assert motion.reason
        joint = next(j for j in apply(asset, motion).joints if j.child == "door")
        np.testing.assert_allclose(joint.axis, motion.axis)
        assert joint.limits == motion.limits


def test_the_drawer_slides_out_first(ready):
    first = ranked_motions(ready[0], "drawer", ready=ready[1])[0]
    assert first.type is JointType.PRISMATIC
    np.testing.assert_allclose(first.axis, (0, -1, 0), atol=1e-6)
    assert first.limits[1] > 0.1


def test_a_dense_asset_has_the_same_first_motion(ready, monkeypatch):
    asset = cabinet()
    monkeypatch.setattr("anymesh.correcting.motions.DENSE", 100)
    first, dense = ranked_motions(asset, "drawer", ready=ready[1])[0], ranked_motions(asset, "drawer")[0]
    assert dense.type is first.type
    np.testing.assert_allclose(dense.axis, first.axis, atol=1e-3)


def test_the_root_has_no_motions(ready):
    with pytest.raises(CorrectionError, match="root"):
        ranked_motions(ready[0], "base", ready=ready[1])


def test_motions_are_described_by_what_a_person_sees():
    asset = cabinet()
    words = {j.child: motion_words(asset, j) for j in asset.joints}
    assert words["door"] == "hinge right, vertical"
    assert words["drawer"] == "slides out, to the front"
    assert words["knob"] == "turns endlessly, axis front to back"


SEEN = [
    ("revolute", (1, 0, 0), (0.3, -0.02, 0.025), (0.0, 1.5), "flap, hinge at the bottom"),
    ("revolute", (-1, 0, 0), (0.3, -0.02, 0.6), (0.0, 1.5), "flap, hinge at the top"),
    ("revolute", (0, 0, 1), (0.3, -0.01, 0.3), (-1.0, 1.0), "turns, axis vertical"),
    ("prismatic", (-1, 0, 0), (0.3, -0.01, 0.3), (0.0, 0.2), "slides out, to the left"),
    ("prismatic", (0, 0, 1), (0.3, -0.01, 0.3), (-0.1, 0.1), "slides, up and down"),
    ("prismatic", (0, 1, 0), (0.3, -0.01, 0.3), (0.0, 0.01), "is pushed in, to the back"),
    ("prismatic", (0, 1, 0), (0.3, -0.01, 0.3), (0.0, 1.0), "slides out, to the back"),  # as a drawer behind a door
    ("prismatic", (0, -1, 1), (0.3, -0.01, 0.3), (0.0, 0.1), "slides, up and to the front"),
    ("fixed", (0, 0, 1), (0.3, -0.01, 0.3), None, "does not move"),
]


@pytest.mark.parametrize(("kind", "axis", "origin", "limits", "words"), SEEN)
def test_words_of_motions_of_a_front(kind, axis, origin, limits, words):
    asset = cabinet()
    door = replace(
        asset.joints[0],
        type=JointType(kind),
        axis=np.array(axis) / np.linalg.norm(axis),
        origin=np.array(origin),
        limits=limits,
    )
    assert motion_words(asset, door) == words


def test_motions_with_the_same_words_are_told_apart_by_what_differs():
    asset = cabinet()
    at = {"part": "door", "type": JointType.REVOLUTE, "confidence": 0.5, "reason": "r"}
    a = ChooseMotion(axis=(0.0, 0.0, 1.0), origin=(0.595, -0.02, 0.3), limits=(0.0, 1.5), **at)
    b = replace(a, axis=(0.0, 0.0, -1.0))
    c = replace(a, limits=(0.0, 0.7))
    d = replace(a, origin=(0.595, 0.0, 0.3))
    assert told_apart(asset, (a, b)) == (
        "hinge right, vertical, opens to the front",
        "hinge right, vertical, opens to the back",
    )
    assert told_apart(asset, (a, c)) == ("hinge right, vertical, 0..86°", "hinge right, vertical, 0..40°")
    assert told_apart(asset, (a, d)) == ("hinge right, vertical", "hinge right, vertical, 2.0 cm further to the back")
    assert len(set(told_apart(asset, (a, a, b, c, d)))) == 5


def test_a_follower_that_runs_into_what_carries_it_is_told():
    asset = cabinet()
    assert motion_faults(asset, {"door", "drawer"}) == {}
    lead = next(j for j in asset.joints if j.child == "drawer")
    follows = apply(asset, SetMimic("door", "drawer", -1.9 / lead.limits[1]))
    assert "the other way is free" in motion_faults(follows, {"door"})["door"]
