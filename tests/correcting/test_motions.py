"""The ranked motions of a part hold the one it was built with, and each can be chosen."""

import numpy as np
import pytest
from assets import cabinet

from anymesh.correcting import CorrectionError, apply, ranked_motions
from anymesh.correcting.motions import made_ready
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
