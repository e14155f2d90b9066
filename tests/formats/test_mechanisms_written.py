"""Each mechanism moves in each format as in the asset: by MuJoCo and yourdfpy, and as written in USD, SDFormat and GLB."""

from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
import yourdfpy
from mechanical import MECHANISMS, doors, gears, jar, linkage, pot, stick
from models import CONFIG, model_of, with_meshes
from pxr import Gf, Usd, UsdGeom, UsdPhysics
from scipy.spatial.transform import Rotation

from anymesh.export.glb import GlbBuffer, tracks
from anymesh.formats.gltf.joints import KHR
from anymesh.formats.gltf.physics import add_physics
from anymesh.formats.robot.mjcf_ import write_mjcf
from anymesh.formats.robot.sdf import sdf_text
from anymesh.formats.robot.urdf import urdf_text
from anymesh.geometry.kinematics import link_transforms
from anymesh.mechanisms.closing import closed, loop_gap
from anymesh.mechanisms.serial import one_axis
from anymesh.openusd.writer_ import write_usd

STEPS = 1500  # of 2 ms in which a joint is moved over its range


def in_mujoco(asset, folder, text=None):
    model = model_of(asset)
    with_meshes(model, folder)
    path = folder / (f"{asset.name}.urdf" if text else f"{asset.name}.xml")
    if text:
        path.write_text(urdf_text(model))
    else:
        write_mjcf(model, folder, CONFIG)
    read = mujoco.MjModel.from_xml_path(str(path))
    read.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    return read, mujoco.MjData(read)


def poses(read, data):
    """Return the transform of each body from rest."""
    rest = mujoco.MjData(read)
    mujoco.mj_kinematics(read, rest)
    found = {}
    for k in range(1, read.nbody):
        now, before = np.eye(4), np.eye(4)
        now[:3, :3], now[:3, 3] = data.xmat[k].reshape(3, 3), data.xpos[k]
        before[:3, :3], before[:3, 3] = rest.xmat[k].reshape(3, 3), rest.xpos[k]
        found[read.body(k).name] = now @ np.linalg.inv(before)
    return found


def swept(asset, read, data, name, most):
    """Move a joint from rest to `most` by a spring, and return poses on the way."""
    at, dof, reached = read.joint(name).qposadr[0], read.joint(name).dofadr[0], []
    inertia = 5 * float(read.dof_M0[dof])
    for step in range(STEPS):
        goal = most * min(1.0, 1.25 * step / STEPS)
        data.qfrc_applied[dof] = inertia * (900 * (goal - data.qpos[at]) - 60 * data.qvel[dof])
        data.qfrc_applied[dof] += data.qfrc_bias[dof]
        mujoco.mj_step(read, data)
        if step % 100 == 99:
            mujoco.mj_kinematics(read, data)
            reached.append((float(data.qpos[at]), poses(read, data)))
    return reached


@pytest.mark.parametrize(
    ("make", "name", "most"),
    [
        (doors, "hinge", 1.4),
        (doors, "first", 0.19),
        (gears, "wheel_joint", 5.0),
        (jar, "thread", 11.0),
        (linkage, "crank_joint", 0.5),
    ],
)
def test_what_is_coupled_moves_together_in_mujoco(make, name, most, tmp_path):
    asset = make()
    read, data = in_mujoco(asset, tmp_path)
    mujoco.mj_forward(read, data)
    reached = swept(asset, read, data, name, most)
    assert reached[-1][0] == pytest.approx(most, rel=0.4)
    others = {j.name: 0.0 for j in asset.joints if j.name != name and j.mimic is None} if not asset.loops else {}
    for position, found in reached:
        at = closed(asset, {name: position} | {n: float(data.joint(n).qpos[0]) for n in others})
        T = link_transforms(asset, at)
        assert loop_gap(asset, found) < 1e-3
        for link in T:
            assert np.abs(found[link] - T[link])[:3].max() < (1e-3 if name in at and not others else 5e-3), (link, position)


def test_loose_parts_and_balls_are_free_in_mjcf(tmp_path):
    read, data = in_mujoco(pot(), tmp_path)
    assert (read.nq, read.body("lid").parentid[0]) == (7, 0)
    data.qpos[:3] += (0.1, 0, 0.5)
    mujoco.mj_kinematics(read, data)
    np.testing.assert_allclose(poses(read, data)["lid"][:3, 3], (0.1, 0, 0.5), atol=1e-9)
    read, data = in_mujoco(stick(), tmp_path)
    assert read.jnt_range[0].tolist() == [0, 0.5]
    turn = Rotation.from_rotvec((0.2, -0.3, 0.1))
    data.qpos[:] = turn.as_quat(scalar_first=True)
    mujoco.mj_kinematics(read, data)
    expected = link_transforms(stick(), {"socket": turn.as_rotvec()})["stick"]
    np.testing.assert_allclose(poses(read, data)["stick"], expected, atol=1e-9)


@pytest.mark.parametrize("make", MECHANISMS)
def test_urdf_moves_alike_in_every_reader(make, tmp_path):
    asset = make()
    read, _ = in_mujoco(asset, tmp_path, text=True)
    robot = yourdfpy.URDF.load(str(tmp_path / f"{asset.name}.urdf"), load_meshes=False, build_collision_scene_graph=False)
    leading = [j for j in asset.joints if j.mimic is None and j.type.value in ("revolute", "continuous", "prismatic", "screw")]
    at = {j.name: 0.7 * j.span[1] for j in leading}
    robot.update_cfg({name: value for name, value in at.items() if name in robot.actuated_joint_names})
    rest = yourdfpy.URDF.load(str(tmp_path / f"{asset.name}.urdf"), load_meshes=False, build_collision_scene_graph=False)
    T, base = link_transforms(asset, at), asset.segmentation.parts[0].name
    for link in T:
        moved = robot.get_transform(link, base) @ np.linalg.inv(rest.get_transform(link, base))
        np.testing.assert_allclose(moved, T[link], atol=1e-6)
    couplings = sum(j.mimic is not None for j in asset.joints) + sum(j.type == "screw" for j in asset.joints)
    assert read.neq == couplings
    assert len(ElementTree.fromstring(urdf_text(model_of(asset))).findall("loop")) == len(asset.loops)


def test_chains_of_one_axis_reach_what_balls_and_free_parts_do():
    ball, screw, free = (make().joints[0] for make in (stick, jar, pot))
    steps = one_axis(ball, ["base", "stick", "socket", "stick_1"], 1.0)
    assert [s.name for s in steps] == ["socket_1", "socket_2", "socket"]
    assert len({s.child for s in steps} - {"stick_1"}) == 3
    assert np.linalg.matrix_rank(np.stack([s.axis for s in steps])) == 3
    assert [s.name for s in one_axis(screw, [], 1.0)] == ["thread", "thread_1"]
    assert len(one_axis(free, [], 1.0)) == 6
    assert one_axis(doors().joints[0], [], 1.0) == (doors().joints[0],) or len(one_axis(doors().joints[0], [], 1.0)) == 1


def usd_of(asset, folder):
    model = model_of(asset)
    write_usd(model, folder, CONFIG)
    stage = Usd.Stage.Open(str(folder / f"{asset.name}.usdc"))
    return stage, {p.GetName(): p for p in stage.GetPrimAtPath(f"/{asset.name}/joints").GetChildren()}


def test_usd_couples_balls_frees_and_closes(tmp_path):
    _, joints = usd_of(doors(), tmp_path)
    twin, third = joints["twin"], joints["third"]
    assert twin.GetRelationship("newton:mimicJoint").GetTargets() == [joints["hinge"].GetPath()]
    assert twin.GetAttribute("physxMimicJoint:rotX:gearing").Get() == 1.0  # position + gearing * leader + offset = 0
    assert third.GetRelationship("newton:mimicJoint").GetTargets() == [joints["first"].GetPath()]
    assert third.GetAttribute("newton:mimicCoef1").Get() == 1.0
    assert not twin.HasAPI(UsdPhysics.DriveAPI, "angular")
    stage, joints = usd_of(jar(), tmp_path)
    assert [p.GetTypeName() for p in joints.values()] == ["PhysicsFixedJoint", "PhysicsRevoluteJoint", "PhysicsPrismaticJoint"]
    assert joints["thread_1"].GetAttribute("newton:mimicCoef1").Get() == pytest.approx(0.02 / (2 * np.pi))
    light, lid = (
        UsdPhysics.MassAPI(stage.GetPrimAtPath(f"/jar/links/{name}")).GetMassAttr().Get() for name in ("lid_1", "lid")
    )
    assert light < 0.002 * lid
    _, joints = usd_of(stick(), tmp_path)
    ball = UsdPhysics.SphericalJoint(joints["socket"])
    assert ball.GetConeAngle0LimitAttr().Get() == pytest.approx(np.rad2deg(0.5))
    assert Gf.Rotation(ball.GetLocalRot0Attr().Get()).TransformDir((1, 0, 0)) == pytest.approx((0, 0, 1), abs=1e-6)
    assert list(usd_of(pot(), tmp_path)[1]) == ["fixed_base"]  # a body without a joint
    stage, joints = usd_of(linkage(), tmp_path)
    pin = UsdPhysics.RevoluteJoint(joints["pin"])
    assert pin.GetExcludeFromArticulationAttr().Get()
    assert [t.name for rel in (pin.GetBody0Rel(), pin.GetBody1Rel()) for t in rel.GetTargets()] == ["coupler", "rocker"]
    ends = [
        UsdGeom.Xformable(stage.GetPrimAtPath(f"/linkage/links/{n}")).ComputeLocalToWorldTransform(0)
        for n in ("coupler", "rocker")
    ]
    places = [
        T.Transform(Gf.Vec3d(p))
        for T, p in zip(ends, (pin.GetLocalPos0Attr().Get(), pin.GetLocalPos1Attr().Get()), strict=True)
    ]
    np.testing.assert_allclose(places, [(0.5, 0, 0.28)] * 2, atol=1e-6)


def test_sdf_states_what_it_can():
    def sdf(asset):
        return ElementTree.fromstring(sdf_text(model_of(asset)))

    found = {j.get("name"): j for j in sdf(doors()).iter("joint")}
    assert found["third"].find("axis/mimic").get("joint") == "first"
    assert found["twin"].findtext("axis/mimic/multiplier") == "-1"
    screw = sdf(jar()).find("model/joint[@name='thread']")
    assert (screw.get("type"), screw.findtext("screw_thread_pitch"), sdf(jar()).get("version")) == ("screw", "0.02", "1.11")
    ball = sdf(stick()).find("model/joint[@name='socket']")
    assert (ball.get("type"), ball.find("axis"), sdf(stick()).get("version")) == ("ball", None, "1.9")
    assert [j.get("name") for j in sdf(pot()).iter("joint")] == ["fixed_base"]
    loops = sdf(linkage()).findall("model/{urn:articulate-anymesh}loop")
    assert [loop.get("name") for loop in loops] == ["pin"]
    assert len(sdf(linkage()).findall("model/{http://drake.mit.edu}ball_constraint")) == 2


@pytest.mark.parametrize("make", MECHANISMS)
def test_a_glb_moves_its_mechanisms_together(make):
    asset = make()
    moving = {t.joint.name: t for t in tracks(asset, CONFIG)}
    assert set(moving) == {j.name for j in asset.joints}
    for k in (5, 11):
        at = {name: float(t.amounts[k]) for name, t in moving.items()}
        T = link_transforms(asset, at)
        assert loop_gap(asset, T) < 1e-9
        for j in asset.joints:
            assert j.mimic is None or at[j.name] == pytest.approx(j.mimic.ratio * at[j.mimic.joint])
            parts = moving[j.name].values(np.zeros(3))
            if j.type == "screw":
                assert parts["translation"][k][2] == pytest.approx(0.02 / (2 * np.pi) * at[j.name], abs=1e-6)
            slides = {"translation"} if j.type in ("screw", "prismatic", "free") else set()
            assert set(parts) == slides | (set() if j.type in ("prismatic", "free") else {"rotation"})
    document = {"nodes": [{"name": "root"}, *({"name": p.name} for p in asset.segmentation.parts)], "meshes": [], "scenes": []}
    add_physics(model_of(asset), document, GlbBuffer())
    assert len(document["extensions"].get(KHR, {}).get("physicsJoints", [])) == sum(j.type != "free" for j in asset.joints)
