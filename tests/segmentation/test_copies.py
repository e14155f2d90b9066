"""Units: leaves stay apart, a surface that creases part moves as one; and what is taken because something must move."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import Config, SegmentationConfig
from anymesh.errors import OptionError
from anymesh.geometry.pieces import object_shape
from anymesh.segmentation import segment
from anymesh.segmentation.contacts import coplanar, find_contacts
from anymesh.segmentation.part_tree import Overlap
from anymesh.segmentation.units import Units, with_held
from anymesh.solving import Solver
from anymesh.types import Segmentation

BODY = box((0, 0.02, 0), (1, 0.5, 1))


def parts(pieces, **settings) -> Segmentation:
    return Solver(mesh_of(pieces)[0], Config(segmentation=SegmentationConfig(**settings))).parts().segmentation


@pytest.mark.parametrize(("width", "joined"), [(0.4, False), (0.12, True)])
def test_leaves_that_meet_are_two_and_planks_are_one(width: float, joined: bool) -> None:
    whole = object_shape(mesh_of([box((0, 0, 0), (width, 0.02, 0.9)), box((width, 0, 0), (2 * width, 0.02, 0.9)), BODY])[0])
    found = coplanar(find_contacts(whole, SegmentationConfig()), whole, 1e-3)
    assert ((0, 1) in found) is joined


def units(surface: list[int]) -> Units:
    """A body, a front, a tray that stands on a shelf of its own and touches the front by a line."""
    pieces = [BODY, box((0, -0.02, 0), (1, 0, 0.4)), box((0.1, 0, 0.1), (0.9, 0.3, 0.3)), box((0.1, 0, 0.08), (0.9, 0.3, 0.1))]
    contacts = find_contacts(object_shape(mesh_of(pieces)[0]), SegmentationConfig())
    return Units(contacts, np.arange(4), [""] * 4, 0, {k: [k] for k in range(4)}, np.array(surface))


def test_a_surface_that_creases_part_moves_as_one_but_not_with_the_root() -> None:
    assert with_held(units([0, 1, 1, 3]), 1) == [1, 2]
    assert 0 not in with_held(units([0, 0, 2, 3]), 1)


def no_part(overlap: Overlap, features: list[dict[str, float]]) -> tuple[np.ndarray, list[str]]:
    """Score every candidate as no part, large ones the lowest."""
    return np.array([-0.1 - row["size"] for row in features]), ["nothing"] * len(features)


def all_parts(overlap: Overlap, features: list[dict[str, float]]) -> tuple[np.ndarray, list[str]]:
    """Score every candidate as a part, small ones the highest."""
    return np.array([1 - row["size"] / 10 for row in features]), ["all"] * len(features)


@pytest.mark.parametrize("gap", [0.0, 0.01])
def test_something_stays_where_every_candidate_is_a_part(monkeypatch: pytest.MonkeyPatch, gap: float) -> None:
    monkeypatch.setattr(segment, "score_parts", all_parts)
    found = parts([box((0, 0, 0), (1, 1, 1)), box((0, 0, 1 + gap), (1, 1, 1.2))])
    assert found.parts[0].name == "base"
    assert found.faces(0).tolist() == list(range(12))  # the larger of the two


def test_something_is_taken_where_something_must_move(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(segment, "score_parts", no_part)
    nailed = [BODY, box((0.48, -0.2, 0.48), (0.52, 0.02, 0.52))]
    assert len(parts(nailed).parts) == 1
    found = parts(nailed, at_least=1)
    assert len(found.parts) == 2
    assert found.faces(1).tolist() == list(range(12, 24))
    assert found.parts[1].confidence < 0.5
    assert "stands out most" in found.parts[1].reason
    assert len(parts([BODY], at_least=1).parts) == 1  # nothing can
    with pytest.raises(OptionError, match="--at-least: found -1"):
        SegmentationConfig(at_least=-1)
