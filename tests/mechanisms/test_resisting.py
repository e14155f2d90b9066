"""Joints resist by their kind, size, mass and inertia, and nothing moves by itself."""

from pathlib import Path

import mujoco
import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of, source
from models import CONFIG, model_of, with_meshes

from anymesh.export.links import split_links
from anymesh.export.options import Base, Driven
from anymesh.formats.robot.mjcf_ import write_mjcf
from anymesh.mechanisms.resisting import KINDS, TILT, kind_of, resistances
from anymesh.physics.inertia import link_inertia
from anymesh.physics.resistance import GRAVITY, Resistance, ResistanceLevel
from anymesh.types import Asset, Part, Segmentation

LABELS = ("door", "drawer", "lid", "knob", "button", "key", "wheel", "fan", "lever", "window", "tap", "screen", "what")
PANEL = ((0.0, 0.0, 0.0), (0.4, 0.02, 0.6))


def thing(label, kind, axis, limits, shape=PANEL, origin=(0, 0, 0), name="thing") -> Asset:
    """Return a block with one part."""
    mesh, part = mesh_of([box((-0.3, -0.1, 0.0), (-0.001, 0.1, 0.6)), box(*shape)])
    parts = Segmentation(part, (Part("base", "base"), Part("part", label)))
    return Asset(name, source(), mesh, parts, (joint("moves", kind, "base", "part", origin, axis, limits),), "test")


def of(asset: Asset, level: ResistanceLevel = ResistanceLevel.TYPICAL) -> Resistance:
    inertias = {link.name: link_inertia(link.triangles, CONFIG) for link in split_links(asset)}
    return resistances(asset, inertias, level)[asset.joints[0].name]


@pytest.mark.parametrize("size", [1e-3, 0.1])
@pytest.mark.parametrize("kind", ["revolute", "continuous", "prismatic"])
def test_no_link_is_too_light_for_its_damping_or_its_friction(kind, size):
    for label in LABELS:
        limits = None if kind == "continuous" else (0.0, 1.2 * (size if kind == "prismatic" else 1))
        shape = (np.array([0, 0, 0]) * size, np.array([0.4, 0.1, 0.3]) * size)
        r = of(thing(label, kind, (0, 1, 0), limits, shape))
        assert r.damping / 60 / r.inertia <= 0.25 + 1e-9, label
        assert r.friction_range[0] <= r.friction <= r.friction_range[1] < r.effort, label
        assert r.effort > 1.5 * r.load, label
        assert np.isfinite([*r.pull.at, *r.pull.direction, r.velocity]).all()
        assert np.linalg.norm(r.pull.direction) == pytest.approx(1)


def test_pull_is_friction_and_weight_over_the_lever():
    door = of(thing("door", "revolute", (0, 0, 1), (0.0, 1.9)))
    assert np.hypot(*door.pull.at[:2]) == pytest.approx(0.4, rel=0.01)
    assert door.pull.typical * 0.4 == pytest.approx(door.friction, rel=0.01)
    np.testing.assert_allclose(door.pull.direction, (0, 1, 0), atol=0.06)
    assert (door.pull.least, door.pull.most) == pytest.approx(np.array(door.friction_range) / np.hypot(*door.pull.at[:2]))
    lid = of(thing("lid", "revolute", (0, -1, 0), (0.0, 1.5), ((0, -0.2, 0.6), (0.4, 0.2, 0.62)), (0, 0, 0.6)))
    arm = float(np.linalg.norm(lid.pull.at[[0, 2]] - (0, 0.6)))
    weight = 0.4 * 0.4 * 0.02 * 500 * GRAVITY
    assert lid.pull.typical == pytest.approx((lid.friction + weight * 0.2) / arm)
    assert lid.pull.direction[2] > 0.99
    lift = of(thing("slide", "prismatic", (0, 0, 1), (0.0, 0.3)))
    assert lift.pull.typical == pytest.approx(lift.friction + 0.4 * 0.02 * 0.6 * 500 * GRAVITY)
    knob = of(thing("knob", "continuous", (0, -1, 0), None, ((0, -0.02, 0), (0.03, 0, 0.03)), (0.015, 0, 0.015)))
    assert (knob.pull.unit, knob.pull.typical) == ("N m", knob.friction)


def test_nothing_moves_by_itself_at_rest_and_one_degree_out_of_level():
    for level in ResistanceLevel:
        upright = of(thing("door", "revolute", (0, 0, 1), (0.0, 1.9)), level)
        assert upright.friction > 1.2 * 0.4 * 0.02 * 0.6 * 500 * GRAVITY * TILT * 0.2
        drawer = of(thing("drawer", "prismatic", (0, -1, 0), (0.0, 0.4)), level)
        assert drawer.friction > 1.2 * 0.4 * 0.02 * 0.6 * 500 * GRAVITY * TILT
        oven = of(thing("door", "revolute", (1, 0, 0), (0.0, 1.5), ((0, -0.2, 0.0), (0.4, -0.18, 0.6))), level)
        assert oven.friction > 1.2 * 0.4 * 0.02 * 0.6 * 500 * GRAVITY * 0.19
        assert oven.pull.typical > 0
        assert "hold" in oven.source


def test_levels_choose_in_the_range():
    light, typical, stiff = (of(thing("drawer", "prismatic", (0, -1, 0), (0.0, 0.4)), level) for level in ResistanceLevel)
    assert light.friction_range == typical.friction_range == (light.friction, stiff.friction)
    assert light.friction < typical.friction < stiff.friction
    assert light.pull.least == light.pull.typical
    assert typical.effort == stiff.effort


def test_kinds_follow_from_words_and_types():
    def named(label, kind, name="thing"):
        asset = thing(label, kind, (0, 0, 1), None if kind == "continuous" else (0.0, 1.0), name=name)
        return kind_of(asset, asset.joints[0])

    assert named("Schublade", "prismatic") == "drawer"
    assert (named("lid", "revolute"), named("lid", "continuous")) == ("lid", "tap")
    assert named("lid", "revolute", "old_laptop") == "screen"
    assert (named("wheel", "continuous"), named("wheel", "continuous", "valve")) == ("wheel", "tap")
    assert (named("knob", "prismatic"), named("door handle", "revolute"), named("ceiling fan", "continuous")) == (
        "button", "lever", "rotor",
    )  # fmt: skip
    assert [named("xyz", kind) for kind in ("prismatic", "revolute", "continuous")] == ["slide", "hinge", "spin"]
    assert {"slide", "hinge", "spin"} <= set(KINDS)


def test_a_pendulum_is_damped_and_a_wheel_is_not():
    hanging = of(thing("bail", "revolute", (0, 1, 0), (-1.5, 1.5), ((-0.02, 0, -0.4), (0.02, 0.02, 0)), (0, 0, 0)))
    assert 4 * hanging.inertia <= hanging.damping <= 15.01 * hanging.inertia
    wheel = of(thing("wheel", "continuous", (0, 1, 0), None, ((-0.1, 0, -0.1), (0.1, 0.02, 0.1)), (0, 0, 0)))
    assert wheel.damping < 0.1 * wheel.inertia
    assert wheel.velocity >= 70


def test_the_edge_of_a_large_door_is_no_faster_than_that_of_a_small_one():
    large, small = (of(thing("door", "revolute", (0, 0, 1), (0.0, 1.9), ((0, 0, 0), (w, 0.02, 0.6)))) for w in (3.0, 0.3))
    assert (large.velocity, small.velocity) == (pytest.approx(1.0, rel=1e-3), 6.0)


def test_a_door_is_pulled_at_its_knob():
    found = resistances(cabinet(), {link.name: link_inertia(link.triangles, CONFIG) for link in split_links(cabinet())})
    np.testing.assert_allclose(found["slide"].pull.at, (0.3, -0.04, 0.8), atol=1e-3)


def car() -> Asset:
    """Return a car of 1.4 kg whose wheels are boxes, since only their joints count here."""
    places = [(x, y) for x in (-0.06, 0.06) for y in (-0.1, 0.1)]
    pieces = [box((-0.05, -0.15, 0.03), (0.05, 0.15, 0.1))]
    pieces += [box((x - 0.005, y - 0.03, 0.0), (x + 0.005, y + 0.03, 0.06)) for x, y in places]
    mesh, part = mesh_of(pieces)
    names = [f"wheel_{k}" for k in range(4)]
    hinges = [("continuous", "base", n, (x, y, 0.03), (1, 0, 0), None) for n, (x, y) in zip(names, places, strict=True)]
    parts = (Part("base", "base"), *(Part(n, "wheel") for n in names))
    joints = tuple(joint(f"{hinge[2]}_joint", *hinge) for hinge in hinges)
    return Asset("car", source(), mesh, Segmentation(part, parts), joints, "test")


def test_a_car_rolls_down(tmp_path: Path):
    model = model_of(car(), base=Base.FREE, driven=Driven.PASSIVE)
    write_mjcf(model, with_meshes(model, tmp_path), CONFIG)
    spec = mujoco.MjSpec.from_file(str(tmp_path / "car.xml"))
    for geom in spec.geoms:
        geom.contype = geom.conaffinity = 0
    for name in (f"wheel_{k}" for k in range(4)):
        spec.body(name).add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.03, 0, 0], mass=0, friction=[1.0, 0, 0], condim=3)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[100, 100, 1], friction=[1.0, 0, 0])
    compiled = spec.compile()
    compiled.opt.gravity[:] = GRAVITY * np.array([0, np.sin(np.pi / 6), -np.cos(np.pi / 6)])
    data = mujoco.MjData(compiled)
    mujoco.mj_step(compiled, data, int(2 / compiled.opt.timestep))
    base, wheels = compiled.body("base").subtreemass[0], compiled.body_inertia[2:, :].max(1).sum() / 0.03**2
    free = 0.5 * GRAVITY * 0.5 * base / (base + wheels) * 4
    assert 0.95 * free < data.qpos[1] < 1.01 * free
