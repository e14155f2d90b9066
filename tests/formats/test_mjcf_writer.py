"""Test MJCF in MuJoCo: it compiles and steps, and its drives behave as specified."""

import shutil
from dataclasses import replace
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
from assets import cabinet, slanted
from models import CONFIG, desk, model_of, with_meshes

from anymesh.errors import OutputError
from anymesh.export.model import WITHIN, Exclusion, drives
from anymesh.export.options import Base, Driven
from anymesh.formats.robot.mjcf_ import write_mjcf
from anymesh.types import Hull, Material


def load(model, folder):
    write_mjcf(model, with_meshes(model, folder), CONFIG)
    return mujoco.MjModel.from_xml_path(str(folder / f"{model.asset.name}.xml"))


@pytest.mark.parametrize("base", Base)
@pytest.mark.parametrize("make", [cabinet, slanted, desk])
def test_it_steps_without_a_warning(make, base, tmp_path):
    read = load(model_of(make(), base=base), tmp_path)
    data = mujoco.MjData(read)
    for _ in range(200):
        mujoco.mj_step(read, data)
    assert not any(w.number for w in data.warning)
    assert np.isfinite(data.qpos).all()
    if base is Base.FREE:
        assert data.qpos[2] < -0.5  # it falls under gravity


def test_the_file_moves_with_its_folder(tmp_path):
    load(model_of(desk()), tmp_path)
    shutil.copytree(tmp_path, tmp_path / "elsewhere")
    mujoco.MjModel.from_xml_path(str(tmp_path / "elsewhere" / "desk.xml"))
    root = ElementTree.parse(tmp_path / "desk.xml").getroot()
    files = [str(e.get("file")) for e in root.iter() if e.get("file")]
    assert all(f.startswith("meshes/") for f in files)
    assert not [f for f in files if f.endswith(".jpg")]


def stronger(model):
    """Return the model with joints strong enough for their load."""
    return replace(model, resistances={name: replace(r, effort=1e5) for name, r in model.resistances.items()})


@pytest.mark.parametrize("make", [cabinet, slanted, desk])
def test_drives_lead_to_the_limits_no_faster_than_the_joint_may_and_hold_there(make, tmp_path):
    model = stronger(model_of(make()))
    read = load(model, tmp_path)
    read.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    data = mujoco.MjData(read)
    limited = [j for j in model.asset.joints if j.limits is not None]
    for j in limited:
        data.actuator(j.name).ctrl = j.limits[1] if j.limits[1] > 0 else j.limits[0]
    velocity = {name: r.velocity for name, r in model.resistances.items()}
    seconds = max((j.limits[1] - j.limits[0]) / velocity[j.name] for j in limited)
    fastest = {j.name: 0.0 for j in limited}
    for _ in range(int(8 * seconds / read.opt.timestep)):
        mujoco.mj_step(read, data)
        fastest = {name: max(v, abs(float(data.joint(name).qvel[0]))) for name, v in fastest.items()}
    for j in limited:
        span = j.limits[1] - j.limits[0]
        goal = j.limits[1] if j.limits[1] > 0 else j.limits[0]
        assert abs(float(data.joint(j.name).qpos[0]) - goal) < 1.5 * WITHIN * span, j.name
        assert fastest[j.name] < 1.1 * velocity[j.name] + 0.05, j.name


def test_drives_are_at_least_critically_damped():
    for asset in (cabinet(), slanted(), desk()):
        model = model_of(asset)
        for j in asset.joints:
            if j.name in drives(model):
                drive = drives(model)[j.name]
                span = 2 * np.pi if j.limits is None else j.limits[1] - j.limits[0]
                assert drive.damping / drive.stiffness == pytest.approx(max(span / model.resistances[j.name].velocity, 0.1))
                assert drive.stiffness * WITHIN * span >= model.resistances[j.name].friction


def test_the_drives_can_be_switched_off_as_a_group(tmp_path):
    read = load(model_of(cabinet()), tmp_path)
    read.opt.gravity[:] = 0
    read.opt.disableactuator = 1 << 1
    data = mujoco.MjData(read)
    data.ctrl[:] = 1
    mujoco.mj_forward(read, data)
    assert not data.actuator_force.any()


def test_an_asset_is_passive_unless_position_drives_are_asked_for(tmp_path):
    model = model_of(cabinet(), driven=Driven.PASSIVE)
    read = load(model, tmp_path)
    data = mujoco.MjData(read)
    data.joint("slide").qpos = 0.1
    mujoco.mj_forward(read, data)
    assert not data.actuator_force.any()  # the open drawer is not moved
    data.ctrl[:] = 1e9
    mujoco.mj_forward(read, data)
    np.testing.assert_allclose(np.sort(data.actuator_force), sorted(r.effort for r in model.resistances.values()))


def test_excluded_pairs_do_not_touch_and_others_do_whether_the_base_is_fixed_or_free(tmp_path):
    for base in Base:
        for exclusions in ((), (Exclusion("base", "door", "they share a wall"),)):
            folder = tmp_path / f"{base}{len(exclusions)}"
            folder.mkdir()
            read = load(model_of(cabinet(), base=base, exclusions=exclusions), folder)
            data = mujoco.MjData(read)
            data.joint("hinge").qpos = -0.1  # into the case
            mujoco.mj_forward(read, data)
            pairs = {frozenset(read.body(read.geom_bodyid[g]).name for g in c.geom) for c in data.contact[: data.ncon]}
            assert (frozenset(("base", "door")) in pairs) == (not exclusions)


def test_a_hull_that_mujoco_refuses_is_an_error_of_ours(tmp_path):
    model = model_of(cabinet())
    flat = Hull(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    model = replace(model, bodies=(replace(model.bodies[0], shapes=(flat,)), *model.bodies[1:]))
    with pytest.raises(OutputError, match="MuJoCo cannot compile cabinet"):
        load(model, tmp_path)


def test_a_material_of_one_triangle_compiles(tmp_path):
    """MuJoCo refuses meshes of fewer than four corners, and gets one for each material of a link."""
    asset = cabinet()
    mesh = asset.mesh
    materials = (*mesh.materials, Material("sticker"), Material("rest"))
    number = np.full(len(mesh.faces), len(materials) - 1)
    number[0] = len(materials) - 2
    read = load(model_of(replace(asset, mesh=replace(mesh, materials=materials, face_material=number))), tmp_path)
    assert "base_visual_1" in {read.mesh(k).name for k in range(read.nmesh)}  # one mesh for each material
