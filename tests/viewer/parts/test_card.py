"""The card says how a part moves and how sure that is; names of files do no harm; messages of the page are not trusted."""

import json
from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet
from chest import TOP, chest

from anymesh.correcting import ChooseMotion, Confirm, apply
from anymesh.correcting.regions import Level
from anymesh.types import JointType
from anymesh.viewer.parts.card import Choosing, ShownMotions, choosing_card, nothing_selected, part_card, same_motion
from anymesh.viewer.parts.channel_ import MAX_MESSAGE, parse
from anymesh.viewer.parts.pictures import MotionPictures

SIDEWAYS = chest(TOP, sideways=True)


def test_a_doubted_joint_says_why_and_can_be_confirmed():
    card = part_card(SIDEWAYS, "drawer", None, None)
    assert "slides out, to the right" in card
    assert "low confidence (0.30)" in card
    assert 'data-say="confirm"' in card
    assert "Looking for its motions" in card
    assert "#f2b01e" in card  # amber: the joint itself has .9
    sure = part_card(apply(SIDEWAYS, Confirm("drawer")), "drawer", None, None)
    assert "✓ confirmed by hand" in sure
    assert 'data-say="confirm"' not in sure
    assert "low confidence" not in sure


def test_the_root_has_no_joint_and_offers_new_parts():
    card = part_card(SIDEWAYS, "base", None, None)
    assert "has no joint" in card
    assert [f'data-say="level {level}"' in card for level in Level] == [True] * 3
    assert 'data-say="lasso"' in nothing_selected(SIDEWAYS, {})


def test_a_proposal_is_one_click_from_acceptance():
    listed = nothing_selected(SIDEWAYS, {"drawer": 0.43})
    assert all(words in listed for words in ('data-say="accept drawer"', 'data-say="look drawer"', "0.43", "slides out"))
    card = part_card(SIDEWAYS, "drawer", None, None, {"drawer": 0.43})
    assert "not written: right with probability 0.43" in card
    assert card.count('data-say="confirm"') == 1
    assert "Accept" in card
    assert "Accept" not in part_card(SIDEWAYS, "drawer", None, None)


def found_of(asset, part: str) -> ShownMotions:
    joint = next(j for j in asset.joints if j.child == part)
    motion = ChooseMotion(part, JointType.PRISMATIC, (0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.3), 0.7, "r")
    other = next(j for j in apply(asset, motion).joints if j.child == part)
    copy = replace(motion, part="other")
    return ShownMotions((motion, motion), (joint, other), ("one", "two <b>"), ("data:,", "data:,"), (copy, copy))


def test_motions_are_shown_in_pictures_and_copies_are_offered():
    card = part_card(SIDEWAYS, "drawer", found_of(SIDEWAYS, "drawer"), 1)
    assert card.count("<img") == 2
    assert "two &lt;b&gt;" in card
    assert card.index("now</span>") < card.index('data-say="motion 1" aria-pressed="true"')
    assert 'data-say="take"' in card
    assert "The same for its 2 copies" in card
    assert "No free motion" in part_card(SIDEWAYS, "drawer", ShownMotions(), None)


def test_a_new_part_is_made_once_faces_are_chosen():
    assert 'data-say="make"' not in choosing_card(Choosing(Level.PIECE), {})
    card = choosing_card(Choosing(Level.PIECE, lasso=True), {"b<ase": 1200})
    assert "1,200 faces of b&lt;ase" in card
    assert 'data-say="make"' in card
    assert 'data-say="seen" aria-pressed="true"' in card


def test_motions_are_the_same_if_they_move_alike():
    hinge, slide = cabinet().joints[0], cabinet().joints[1]
    assert same_motion(hinge, replace(hinge, origin=hinge.origin + hinge.axis))
    assert not same_motion(hinge, replace(hinge, axis=-hinge.axis))
    assert not same_motion(hinge, replace(hinge, origin=hinge.origin + 0.1))
    assert same_motion(slide, replace(slide, origin=slide.origin + 0.1))
    assert not same_motion(hinge, slide)


@pytest.mark.parametrize(
    "message",
    [
        "", "{", "[]", "null", '{"say": 3}', '{"lasso": 3}', '{"lasso": [[0, 0], [1, 0]]}', '{"lasso": [[0, 0], [1, 0], [1]]}',
        '{"lasso": [[0, 0], [1, 0], ["a", 1]]}', '{"lasso": [[0, 0], [1, 0], [NaN, 1]]}', "[" * 15_000,
        '{"lasso": [[0, 0], [1, 0], [1e9, 1]]}', json.dumps({"lasso": [[0, 0]] * 600}), json.dumps({"say": "x" * MAX_MESSAGE}),
    ],
)  # fmt: skip
def test_messages_that_are_none_are_dropped(message):
    assert parse(message) is None


def test_messages_are_read():
    assert parse('{"say": "motion 2", "count": "1"}') == "motion 2"
    outline = [[0, 0.5], [1, 0], [1, 1]]
    assert parse(json.dumps({"lasso": outline, "take": True})) == ([tuple(map(float, p)) for p in outline], True)


def test_a_picture_shows_the_part_where_the_motion_takes_it():
    from base64 import b64decode
    from io import BytesIO

    from PIL import Image

    asset = chest(TOP)
    out, side = asset.joints[0], SIDEWAYS.joints[0]
    urls = MotionPictures(asset, "drawer").of((out, side))
    seen = [np.asarray(Image.open(BytesIO(b64decode(u.partition(",")[2]))).convert("RGB")).astype(int) for u in urls]
    orange = [np.argwhere((p[..., 0] - p[..., 2] > 90) & (p[..., 1] > 40)) for p in seen]
    assert all(len(o) > 200 for o in orange)
    assert orange[1][:, 1].mean() > orange[0][:, 1].mean() + 10  # to the right in the picture, which shows the front
