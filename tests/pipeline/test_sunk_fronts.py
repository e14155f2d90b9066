"""Test fronts that are sunk into closed bodies: found, moved out and stopped where they are truly blocked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box
from made import X, Y, context_of, slide
from sunk import Sunk, chest, cupboard, objects, oven

from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.rank_motions import fits_label
from anymesh.names import GIVEN as GIVEN_NAME
from anymesh.pipeline.solving import Solver
from anymesh.types import JointType

GIVEN = {
    "plain": chest(grid=(2, 1), handle=""),
    "deep": chest(grid=(2, 1), sunk=0.38, handle=""),
    "oven": oven(knobs=2),
    "doors": cupboard(sunk=0.03, proud=0.02),
}
NAMED = {"plain"}  # slabs without a handle, which may also be panels that slide sideways: their names decide
FOUND = {"topped": chest((0.5, 0.45, 0.5), (2, 1), 0.03, 0.02, "", extra="legs, top")}


@pytest.mark.parametrize("bare", [False, True], ids=["closed", "without hidden faces"])
@pytest.mark.parametrize("name", list(GIVEN))
def test_given_parts_move_out(name: str, bare: bool) -> None:
    thing = GIVEN[name]
    mesh, parts = thing.mesh(bare=bare)
    if name in NAMED:
        parts = replace(parts, parts=tuple(replace(p, label=p.name.partition("_")[0], reason=GIVEN_NAME) for p in parts.parts))
    joints = Solver(mesh).joints(parts).joints
    assert [j.child for j in joints if not thing.is_right(j.child, j)] == []


@pytest.mark.parametrize("name", list(FOUND))
def test_parts_are_found_and_move_out(name: str) -> None:
    thing = FOUND[name]
    mesh, truth = thing.mesh(bare=True)
    solver = Solver(mesh)
    parts = solver.parts().segmentation
    joints = {j.child: j for j in solver.joints(parts).joints}
    for k, part in enumerate(truth.parts[1:], start=1):
        own = np.bincount(parts.face_part[truth.face_part == k]).argmax()
        assert own > 0
        assert thing.is_right(part.name, joints[parts.parts[own].name])


@pytest.mark.parametrize("bare", [False, True], ids=["closed", "without hidden faces"])
def test_the_knobs_of_drawers_are_handles(bare: bool) -> None:
    mesh, truth = chest(grid=(2, 1)).mesh(bare=bare)
    parts = Solver(mesh).parts().segmentation
    assert len(parts.parts) == len(truth.parts) == 3
    for k in (1, 2):  # with its knob
        assert len(np.unique(parts.face_part[truth.face_part == k])) == 1


@pytest.mark.slow
def test_nearly_all_sunk_parts_are_found_and_right() -> None:
    """Of 174 parts of the objects, closed and without hidden faces, 153 are right, and 115 were before they were drawn out."""
    count = right = 0
    for thing in objects().values():
        for bare in (False, True):
            mesh, truth = thing.mesh(bare=bare)
            solver = Solver(mesh)
            parts = solver.parts().segmentation
            joints = {j.child: j for j in solver.joints(parts).joints}
            for k, part in enumerate(truth.parts[1:], start=1):
                own = np.bincount(parts.face_part[truth.face_part == k]).argmax()
                count += 1
                right += bool(own) and thing.is_right(part.name, joints[parts.parts[own].name])
    assert right >= 0.85 * count


def named(thing: Sunk, word: str) -> dict[str, JointType]:
    mesh, _ = thing.mesh({name: "case" if name == "base" else f"{word}_{n}" for n, name in enumerate(thing.scene)})
    solver = Solver(mesh)
    joints = solver.joints(solver.parts("nodes").segmentation).joints
    assert all(thing.is_right(part, j) for part, j in zip(list(thing.scene)[1:], joints, strict=True))
    return {j.child: j.type for j in joints}


@pytest.mark.parametrize("word", ["drawer_top", "Schublade"])
def test_what_is_named_a_drawer_slides_out(word: str) -> None:
    assert set(named(chest(grid=(2, 1), handle=""), word).values()) == {JointType.PRISMATIC}


def test_the_name_decides_over_the_score() -> None:
    """The same fronts are doors by their handles, and drawers by their names."""
    thing = cupboard((1.0, 0.5, 0.8), 2, 0.03, 0.02, "knob")
    assert set(named(thing, "door").values()) == {JointType.REVOLUTE}
    assert set(named(Sunk(thing.scene, dict.fromkeys(thing.moves, "out")), "drawer").values()) == {JointType.PRISMATIC}


FRONT = [box((0.1, -0.02, 0.1), (0.9, 0.05, 0.4))]
BODY = [box((0, 0, 0), (1, 0.5, 1))]


def test_the_overlap_at_rest_blocks_no_way_out_and_every_other_way() -> None:
    context = context_of(FRONT, BODY)
    out, into = sweep_candidates(context, [("slide", slide(-Y))])
    along, _ = sweep_candidates(context, [("slide", slide(X))])
    assert out.opening_sweep.clear_forward
    assert not into.opening_sweep.clear_forward
    assert into.opening * context.tolerance_length < 0.01
    assert max(along.opening, along.closing) * context.tolerance_length < 0.03


def test_what_stands_before_a_sunk_front_stops_it() -> None:
    context = context_of(FRONT, [*BODY, box((0, -0.3, 0), (1, -0.2, 1))])
    out, _ = sweep_candidates(context, [("slide", slide(-Y))])
    assert out.opening * context.tolerance_length == pytest.approx(0.18, abs=0.01)


def test_motions_that_fit_a_label() -> None:
    context = context_of(FRONT, BODY)
    both = sweep_candidates(context, [("slide", slide(-Y)), ("slide", slide(X))])
    assert fits_label("drawer", both).tolist() == [True, False, False, False]
    assert fits_label("slider", both).all()
    assert fits_label("door", both).all()  # no motion is one of a door
    assert fits_label("part", both).all()
