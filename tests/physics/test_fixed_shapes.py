"""Test that results and settings of collision shapes cannot be changed, and the order of their lengths."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import FrozenInstanceError, fields
from typing import Any

import numpy as np
import pytest
from assets import assert_fixed, box
from test_decomposer import FINE, FakePool, bracket
from test_shapes import collision_of, sliding

from anymesh.physics.clear import ComponentShapes, ContactScene, Fault, Faults, LinkSurface, clear
from anymesh.physics.collision import CollisionConfig
from anymesh.physics.contacts_ import ContactBench
from anymesh.physics.decompose import Component, Decomposer, Divided, Method, Resolution, _Around, split_components
from anymesh.physics.solids_ import _pieces
from anymesh.physics.split import patch_of
from anymesh.types import Box


def solid(*corners) -> np.ndarray:
    v, f = box(*corners)
    return v[f]


def scene() -> ContactScene:
    return ContactScene({"a": LinkSurface(solid((0, 0, 0), (1, 1, 1)))}, [{"a": np.eye(4)}], 1e-4, 1e-3)


def contact() -> Any:
    cube = Box(np.zeros(3), np.eye(3), np.ones(3))
    return ContactBench({"a": [cube], "b": [cube]}).contacts(dict.fromkeys("ab", np.eye(4)), 0.0)[0]


def solid_piece() -> Any:
    from manifold3d import Manifold

    return _pieces(Manifold.cube((1.0, 1.0, 1.0)))[0]


def around() -> _Around:
    return _Around(np.eye(4), np.zeros(3), np.ones(3))


POOL = FakePool()
IDENTITY = {
    "component": lambda: split_components(solid((0, 0, 0), (1, 1, 1)), 0.0)[0],
    "hull of a component": around,
    "component with shapes": lambda: ComponentShapes("a", Component(solid((0, 0, 0), (1, 1, 1)), True), 0, ()),
    "false contact": lambda: Fault((0, 0), (1, 0), 0.1, np.ones(3), {}),
    "false contacts": lambda: scene().faults([]),
    "scene": scene,
    "cleared": lambda: clear(scene(), [], lambda some, levels: [], levels=1, rounds=1),
    "contact": contact,
    "patch": lambda: patch_of(solid((0, 0, 0), (1, 1, 1)), 0.01),
    "piece of a solid": solid_piece,
    "decomposer": lambda: Decomposer(POOL, None, 5.0),
    "divided": lambda: Divided(()),
}


@pytest.mark.parametrize("make", IDENTITY.values(), ids=IDENTITY)
def test_a_result_cannot_be_changed_and_equals_itself_only(make: Callable[[], Any]) -> None:
    assert_fixed(make)


def fallback() -> Any:
    return Decomposer(FakePool(Method.SOLID), None, 5.0).divide([bracket()], [FINE])[0].fallback


@pytest.mark.parametrize("make", [CollisionConfig, lambda: Resolution(0.1, 0.01, 3), fallback])
def test_settings_are_equal_by_value_and_cannot_be_changed(make: Callable[[], Any]) -> None:
    one, other = make(), make()
    assert len({one, other}) == 1
    for field in fields(one):
        with pytest.raises(FrozenInstanceError):
            setattr(one, field.name, getattr(other, field.name))


def test_the_collision_of_an_asset_is_fixed_too() -> None:
    found = collision_of(sliding(0.002), rounds=0, gaps=(0.3,), pieces=(8,))
    assert len({found}) == 1
    with pytest.raises(FrozenInstanceError):
        found.tight = ()


def test_lengths_are_small_shares_of_the_object_in_a_known_order() -> None:
    """Walls are thicker than contacts and thinner than real collisions; finer shapes are closer and of more pieces."""
    c = CollisionConfig()
    assert 0 < c.contact < c.wall < c.crossing < c.gaps[1] < c.gaps[0] < 0.05
    assert 0 < c.wall_most < 0.01
    assert len(c.gaps) == len(c.pieces) == 2
    assert c.pieces[0] < c.pieces[1]


def test_no_components_give_no_faults() -> None:
    assert scene().faults([]).found == []
    assert scene().faults([]).poses == ()
    assert Faults([], ()).found == []
