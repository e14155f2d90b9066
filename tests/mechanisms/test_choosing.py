"""Mechanisms do in MuJoCo what asset.json says of them."""

import importlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from assets import Asset, Part, Segmentation, box, joint, mesh_of, source
from models import CONFIG, model_of, with_meshes

from anymesh.errors import OptionError
from anymesh.export.asset_json import asset_record
from anymesh.export.model import Model
from anymesh.export.options import Base, Driven, ExportOptions, Format
from anymesh.formats.robot.mjcf_ import write_mjcf
from anymesh.formats.robot.sdf import sdf_text
from anymesh.formats.robot.urdf import urdf_text
from anymesh.mechanisms.choosing import choose_mechanisms, parse_mechanisms
from anymesh.openusd.writer_ import write_usd

UP, ALONG = (0, 0, 1), (0, -1, 0)  # an upright hinge; one at the back that lets a lid open upwards
PANEL = ((0.0, 0.01, 0.3), (0.4, 0.03, 0.9))  # of a door whose hinge is at the origin
PLATE = ((0.01, -0.2, 1.0), (0.5, 0.2, 1.02))  # of a lid whose hinge is at x = 0, z = 1
CAP = ((-0.01, -0.01, 1.0), (0.01, 0.01, 1.02))


def chosen(
    label: str, kind: str, shape: Any, choice: str, axis: Any = UP, limits: Any = (0.0, 1.9), name: str = "thing"
) -> Model:
    """Return the model of an object with one part, whose joint is at the height of its underside, with its mechanism."""
    mesh, face_part = mesh_of([box((-0.3, -0.3, 0.0), (0.3, -0.1, 0.2)), box(*shape)])
    hinge = joint("moves", kind, "base", "part", (0, 0, shape[0][2]), axis, limits)
    parts = Segmentation(face_part, (Part("base", "base"), Part("part", label)))
    model = model_of(Asset(name, source(), mesh, parts, (hinge,), "test"), base=Base.FIXED, driven=Driven.PASSIVE)
    model = replace(model, how=model.how.with_formats(tuple(Format)))
    found, resisting = choose_mechanisms(model.asset, {b.name: b.inertia for b in model.bodies}, model.resistances, choice)
    return replace(model, mechanisms=found, resistances=resisting)


def simulated(model: Model, folder: Path) -> tuple[Any, Any]:
    write_mjcf(model, with_meshes(model, folder), CONFIG)
    compiled = mujoco.MjModel.from_xml_path(str(folder / f"{model.asset.name}.xml"))
    return compiled, mujoco.MjData(compiled)


def after(compiled: Any, data: Any, seconds: float, force: float = 0.0) -> float:
    """Return the position after a time under a force at the joint [N or N m]."""
    data.qfrc_applied[0] = force
    for _ in range(round(seconds / compiled.opt.timestep)):
        mujoco.mj_step(compiled, data)
    return float(data.qpos[0])


def breakaway(compiled: Any, data: Any, most: float, moved: float, sign: float = 1.0) -> float:
    """Return the force at the joint that moves it, by a slow ramp up to `most` [N or N m]."""
    start, steps = float(data.qpos[0]), round(8 / compiled.opt.timestep)
    for k in range(steps):
        data.qfrc_applied[0] = sign * most * k / steps
        mujoco.mj_step(compiled, data)
        if abs(data.qpos[0] - start) > moved:
            return float(abs(data.qfrc_applied[0]))
    raise AssertionError(f"not moved by {most}")


def lever(model: Model) -> float:
    j, pull = model.asset.joints[0], model.resistances["moves"].pull
    return 1.0 if str(j.type) == "prismatic" else float(np.linalg.norm(np.cross(j.axis, pull.at - j.origin)))


def test_a_self_closing_door_closes_and_rests(tmp_path: Path) -> None:
    model = chosen("door", "revolute", PANEL, "door=close")
    compiled, data = simulated(model, tmp_path)
    data.qpos[0] = np.pi / 4
    assert abs(after(compiled, data, 4.0)) < np.deg2rad(0.5)
    path = [after(compiled, data, 0.1) for _ in range(10)]
    assert np.ptp(path) < np.deg2rad(0.1)
    m = model.mechanisms["moves"]
    found = breakaway(compiled, data, 2 * m.force * lever(model), np.deg2rad(0.05))
    assert found / lever(model) == pytest.approx(m.force, rel=0.1)


@pytest.mark.parametrize("thick", [0.02, 0.2])
@pytest.mark.parametrize("degrees", [20, 60, 85])
def test_a_lid_that_holds_stays(thick: float, degrees: float, tmp_path: Path) -> None:
    low, high = PLATE
    model = chosen("lid", "revolute", (low, (*high[:2], 1 + thick)), "lid=hold", ALONG, (0.0, 1.57))
    compiled, data = simulated(model, tmp_path)
    data.qpos[0] = np.deg2rad(degrees)
    assert np.rad2deg(after(compiled, data, 5.0)) == pytest.approx(degrees, abs=1.0)
    mujoco.mj_resetData(compiled, data)
    m = model.mechanisms["moves"]
    found = breakaway(compiled, data, 2 * m.force * lever(model), np.deg2rad(0.02))
    assert found / lever(model) == pytest.approx(m.force, rel=0.1)


def test_a_latch_holds_up_to_its_force_and_snaps_shut(tmp_path: Path) -> None:
    model = chosen("door", "revolute", PANEL, "door=latch")
    compiled, data = simulated(model, tmp_path)
    m = model.mechanisms["moves"]
    assert m.force > 5
    assert abs(after(compiled, data, 2.0, 0.9 * m.force * lever(model))) < np.deg2rad(0.5)
    found = breakaway(compiled, data, 2 * m.force * lever(model), np.deg2rad(0.3))
    assert found / lever(model) == pytest.approx(m.force, rel=0.1)
    for place, stays in ((0.6 * m.at, 0.0), (0.5, 0.5)):
        mujoco.mj_resetData(compiled, data)
        data.qpos[0] = place
        assert after(compiled, data, 2.0) == pytest.approx(stays, abs=np.deg2rad(0.5))


@pytest.mark.parametrize("limits", [(0.0, 0.004), (-0.004, 0.0)])
def test_a_button_returns(limits: tuple[float, float], tmp_path: Path) -> None:
    model = chosen("button", "prismatic", CAP, "auto", (0, 0, 1), limits)
    compiled, data = simulated(model, tmp_path)
    data.qpos[0] = sum(limits)
    assert abs(after(compiled, data, 1.0)) < 1e-4
    m = model.mechanisms["moves"]
    assert breakaway(compiled, data, 3 * m.force, 1e-3, np.sign(sum(limits))) == pytest.approx(m.force, rel=0.1)


def test_a_toggle_snaps_to_either_end(tmp_path: Path) -> None:
    model = chosen("lever", "revolute", CAP, "all", (0, 1, 0), (-0.3, 0.3), "light_switch")
    compiled, data = simulated(model, tmp_path)
    for start in (0.1, -0.1):
        mujoco.mj_resetData(compiled, data)
        data.qpos[0] = start
        assert after(compiled, data, 2.0) == pytest.approx(np.copysign(0.3, start), abs=0.01)


def test_a_knob_snaps_to_steps(tmp_path: Path) -> None:
    model = chosen("knob", "continuous", CAP, "all", UP, None)
    compiled, data = simulated(model, tmp_path)
    for start, step in ((9, 0), (21, 30), (-22, -30)):
        mujoco.mj_resetData(compiled, data)
        data.qpos[0] = np.deg2rad(start)
        assert np.rad2deg(after(compiled, data, 2.0)) == pytest.approx(step, abs=2)


@pytest.mark.parametrize("choice", ["part=close", "part=hold", "part=latch", "part=return"])
def test_mechanisms_are_stable_and_survive_attachment(choice: str, tmp_path: Path) -> None:
    model = chosen("door", "revolute", PANEL, choice)
    compiled, _ = simulated(model, tmp_path)
    r, m = model.resistances["moves"], model.mechanisms["moves"]
    inertia = r.inertia + r.armature
    assert max(m.stiffness, m.slope) / 3600 / inertia < 1
    assert r.damping / 60 / r.inertia < 1
    scene = mujoco.MjSpec()
    scene.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    scene.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
    scene.attach(mujoco.MjSpec.from_file(str(tmp_path / "thing.xml")), prefix="a_", frame=scene.worldbody.add_frame())
    attached = scene.compile()
    for name in ("jnt_stiffness", "qpos_spring", "jnt_solref", "dof_solimp", "actuator_biasprm", "actuator_forcerange"):
        np.testing.assert_allclose(getattr(attached, name), getattr(compiled, name))


def test_only_what_is_sure_is_written_unasked() -> None:
    assert not chosen("door", "revolute", PANEL, "auto").mechanisms
    assert not chosen("button", "prismatic", CAP, "off", UP, (0.0, 0.004)).mechanisms
    assert chosen("door", "revolute", PANEL, "all").mechanisms["moves"].kind == "latch"
    assert chosen("lid", "revolute", PLATE, "auto", ALONG, name="my_laptop").mechanisms["moves"].kind == "hold"
    assert not chosen("lid", "revolute", PLATE, "auto", ALONG).mechanisms
    assert not chosen("knob", "continuous", CAP, "knob=latch", UP, None).mechanisms  # without a closed position


@pytest.mark.parametrize("text", ["some", "door=glue", "=hold", ""])
def test_other_choices_are_refused(text: str) -> None:
    with pytest.raises(OptionError, match="valid are auto, off, all"):
        parse_mechanisms(text)


def test_the_choice_is_kept_in_asset_json() -> None:
    how = ExportOptions.parse({"mechanisms": "door=close, part = hold"})
    assert ExportOptions.parse({}, before=how.record()) == how
    assert "mechanisms" not in ExportOptions().record()
    with pytest.raises(OptionError, match="--mechanisms: found"):
        ExportOptions.parse({}, before={"mechanisms": ["off"]})


def test_the_formats_that_hold_a_mechanism_have_it() -> None:
    spring, catch = chosen("door", "revolute", PANEL, "door=close"), chosen("door", "revolute", PANEL, "door=latch")
    written = asset_record(spring)["joints"][0]["mechanism"]
    assert written["formats"] == ["mjcf", "usd", "sdf", "glb", "usdz"]
    assert f"<spring_stiffness>{written['stiffness']:.10g}</spring_stiffness>" in sdf_text(spring)
    assert f"<springReference>{written['reference']:.10g}</springReference>" in urdf_text(spring)
    assert asset_record(catch)["joints"][0]["mechanism"]["formats"] == ["mjcf"]
    assert "spring" not in sdf_text(catch) + urdf_text(catch)


def test_a_spring_in_usd_leaves_the_drive_alone(tmp_path: Path) -> None:
    model = chosen("door", "revolute", PANEL, "door=close")
    write_usd(model, with_meshes(model, tmp_path), CONFIG)
    stage = importlib.import_module("pxr.Usd").Stage.Open(str(tmp_path / "thing.usdc"))
    prim = stage.GetPrimAtPath("/thing/joints/moves")
    m = model.mechanisms["moves"]
    values = {name: prim.GetAttribute(name).Get() for name in prim.GetAuthoredPropertyNames()}
    assert values["physxTendon:spring:stiffness"] == pytest.approx(values["mjc:stiffness"]) == pytest.approx(m.stiffness)
    gearing, rest = values["physxTendon:spring:gearing"][0], values["physxTendon:spring:restLength"]
    assert rest / gearing == pytest.approx(values["mjc:springref"])
    assert rest == pytest.approx(m.reference)
    assert values["drive:angular:physics:stiffness"] == 0
