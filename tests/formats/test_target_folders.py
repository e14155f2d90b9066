"""The folders for other projects hold what their loaders look for."""

import sys
from dataclasses import replace
from types import SimpleNamespace
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
import trimesh
from assets import box, joint, mesh_of, source
from models import CONFIG, model_of, with_meshes

from anymesh.export.formats import write_formats
from anymesh.export.model import Exclusion
from anymesh.export.options import NEEDED, Base, ExportOptions, TargetProject
from anymesh.formats.targets.writing import turn_to_front, write_target
from anymesh.types import Asset, Part, Segmentation

CASE = box((-0.2, 0.0, 0.0), (0.2, 0.3, 0.6))
DOOR = [box((-0.2, -0.02, 0.0), (0.2, -0.001, 0.6)), box((0.15, -0.05, 0.25), (0.17, -0.019, 0.35))]  # with a bar
OPEN = {"closed": {"hinge": 0.0}, "half": {"hinge": 0.95}, "open": {"hinge": 1.9}}


def cupboard(limits: tuple[float, float] = (0.0, 1.9), turned: int = 0) -> Asset:
    """Return a case with a door whose front faces -y, turned by quarters about z."""
    mesh, piece = mesh_of([CASE, *DOOR])
    c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][turned]
    R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    hinge = joint("hinge", "revolute", "object", "door", R @ (-0.2, -0.01, 0.3), (0, 0, -1), limits)
    parts = Segmentation(np.minimum(piece, 1), (Part("object", "base"), Part("door", "door")))
    return Asset("cupboard", source(), replace(mesh, vertices=mesh.vertices @ R.T), parts, (hinge,), "test")


def written(folder, target, asset=None, states=OPEN, base=Base.FIXED, exclusions=()):
    model = replace(model_of(asset or cupboard(), base=base, exclusions=exclusions), states=states)
    model = replace(model, how=replace(model.how, target=target))
    write_formats(model, with_meshes(model, folder), NEEDED[target], CONFIG)
    return folder / target / "cupboard"


def bodies(root):
    return {body.get("name"): body for body in root.iter("body")}


@pytest.mark.parametrize("target", [TargetProject.ROBOSUITE, TargetProject.ROBOCASA])
def test_an_object_of_robosuite_is_about_its_middle_with_sites_of_its_size(target, tmp_path):
    path = written(tmp_path, target, base=Base.FREE) / "model.xml"
    root, model = ElementTree.parse(path).getroot(), mujoco.MjModel.from_xml_path(str(path))
    inner = root.find("./worldbody/body/body[@name='object']")
    assert [b.get("name") for b in inner.findall("body")] == ["object_0"]  # the link whose name was taken
    assert not root.findall(".//freejoint") + root.findall("keyframe") + root.findall(".//*[@class]")
    assert {g.get("group") for g in root.iter("geom")} == {"0", "1"}
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    sites = {model.site(k).name: data.site_xpos[k] for k in range(model.nsite)}
    assert np.allclose([sites["bottom_site"], sites["top_site"]], [[0, 0, -0.3], [0, 0, 0.3]])
    x, y, _ = sites["horizontal_radius_site"]
    reach = np.hypot(0.2, 0.175)
    assert (x, y) == pytest.approx((0.2, 0.175) if target is TargetProject.ROBOCASA else (reach, reach), abs=1e-6)
    assert [model.geom(k).name for k in range(model.ngeom) if model.geom(k).name.startswith("reg_")] == (
        ["reg_main", "reg_bbox"] if target is TargetProject.ROBOCASA else []
    )
    assert model.body("object").mass == 0.0


def test_what_must_not_touch_does_not_without_excludes(tmp_path):
    root = ElementTree.parse(
        written(tmp_path, TargetProject.ROBOSUITE, exclusions=(Exclusion("object", "door", "fused"),)) / "model.xml"
    )
    root = root.find("worldbody")
    bits = {
        name: {(int(g.get("contype")), int(g.get("conaffinity"))) for g in bodies(root)[name].findall("geom[@group='0']")}
        for name in ("object_0", "door")
    }
    ((a, b),), ((c, d),) = bits.values()
    assert (a & d, c & b) == (0, 0)
    assert (a & 1 and c & 1) or (b & 1 and d & 1)  # other things touch both


def test_a_front_faces_where_the_project_expects_it():
    for turned in range(4):
        model = replace(model_of(cupboard(turned=turned)), states=OPEN)
        handle = model.handles[0]
        assert np.allclose(turn_to_front(model) @ -handle.R[:, 2], (0, -1, 0))


def test_robocasa_counts_from_where_a_joint_is_closed(tmp_path):
    ajar = {"closed": {"hinge": -0.5}, "half": {"hinge": 0.45}, "open": {"hinge": 1.4}}
    path = written(tmp_path, TargetProject.ROBOCASA, cupboard((-0.5, 1.4)), ajar) / "model.xml"
    model = mujoco.MjModel.from_xml_path(str(path))
    assert model.jnt_range[0] == pytest.approx([0.0, 1.9])
    assert model.qpos0[0] == pytest.approx(0.5)


def test_maniskill_finds_a_handle_on_the_link_that_moves(tmp_path):
    into = written(tmp_path, TargetProject.MANISKILL)
    robot = ElementTree.parse(into / "mobility_cvx.urdf").getroot()
    visuals = {v.get("name"): v for v in robot.find("link[@name='door']").findall("visual")}
    (name,) = (n for n in visuals if n and "handle" in n)
    files = [v.find("geometry/mesh").get("filename") for v in visuals.values()]
    assert sum(len(trimesh.load(into / f, process=False).faces) for f in files) == 24
    handle = trimesh.load(into / visuals[name].find("geometry/mesh").get("filename"), process=False)
    assert np.allclose(handle.bounds, np.add([[0.15, -0.05, 0.25], [0.17, -0.019, 0.35]], [0.2, 0.01, -0.3]), atol=1e-6)
    turned = [float(v) for v in robot.find("joint[@name='root_joint']/origin").get("rpy").split()]
    assert turned == pytest.approx([0, 0, -np.pi / 2])


def test_genesis_gets_no_armature_of_its_own(tmp_path):
    root = ElementTree.parse(written(tmp_path, TargetProject.GENESIS) / "cupboard.xml").getroot()
    assert float(root.find(".//joint").get("armature")) > 0
    assert all((tmp_path / "genesis/cupboard" / e.get("file")).is_file() for e in root.findall("asset/*[@file]"))


def test_isaaclab_gets_a_configuration(tmp_path, monkeypatch):
    class Said(SimpleNamespace):
        InitialStateCfg = SimpleNamespace

    names = {"isaaclab.sim": "UsdFileCfg", "isaaclab.actuators": "ImplicitActuatorCfg", "isaaclab.assets": "ArticulationCfg"}
    monkeypatch.setitem(sys.modules, "isaaclab", SimpleNamespace(sim=SimpleNamespace(UsdFileCfg=SimpleNamespace)))
    for module, name in names.items():
        monkeypatch.setitem(sys.modules, module, SimpleNamespace(**{name: Said}))
    into = written(tmp_path, TargetProject.ISAACLAB)
    said = {"__file__": str(into / "cupboard_cfg.py")}
    exec((into / "cupboard_cfg.py").read_text(), said)
    found = said["CUPBOARD_CFG"]
    assert found.spawn.usd_path == str(into / "cupboard.usdc")
    assert (into / "cupboard.usdc").is_file()
    assert found.init_state.joint_pos == {"hinge": 0.0}
    assert said["STATES"] == OPEN


def test_a_folder_of_another_target_goes(tmp_path):
    written(tmp_path, TargetProject.GENESIS)
    written(tmp_path, TargetProject.ROBOSUITE)
    assert not (tmp_path / "genesis").exists()
    write_target(model_of(cupboard()), tmp_path)
    assert not (tmp_path / "robosuite").exists()


def test_a_target_brings_its_format_and_stays():
    how = ExportOptions.parse({"target": "isaaclab"})
    assert "usd" in how.formats
    assert ExportOptions.parse({}, before=how.record() | {"files": {"usd": "x.usdc"}}).target is TargetProject.ISAACLAB
