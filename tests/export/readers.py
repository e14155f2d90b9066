"""Content of each format, read independently of the writers: yourdfpy, MuJoCo, OpenUSD; SDFormat here, and GLB beside."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import yourdfpy
from glb_reader import read_glb
from neutral import KINDS, Body, Read, box, chain, cloud, cylinder, frame, motion, obj_points
from pxr import Gf, Usd, UsdGeom, UsdPhysics
from scipy.spatial.transform import Rotation

from anymesh.export.notation import DRAKE


def _sdf_pose(element: ElementTree.Element) -> np.ndarray:
    values = np.array((element.findtext("pose") or "0 0 0 0 0 0").split(), float)
    return frame(values[:3], Rotation.from_euler("xyz", values[3:]).as_matrix())


def _sdf_joints(model: ElementTree.Element, rest: dict[str, np.ndarray]) -> tuple[dict[str, dict], bool]:
    """Return the joints by name, and whether the model is fixed to the world."""
    joints, fixed = {}, False
    for j in model.findall("joint"):
        parent, child, kind = str(j.findtext("parent")), str(j.findtext("child")), str(j.get("type"))
        if parent == "world":
            fixed = kind == "fixed"
            continue
        assert j.find("pose") is None  # a joint's frame is its child's
        joints[str(j.get("name"))] = said = {"type": kind, "parent": parent, "child": child}
        said["rest"] = np.linalg.inv(rest[parent]) @ rest[child]
        if kind == "fixed":
            continue
        xyz = j.find("axis/xyz")
        assert xyz is not None
        assert xyz.get("expressed_in") is None  # in the joint's frame
        said["axis"] = np.array(str(xyz.text).split(), float)
        number = {key: float(str(j.findtext(f"axis/{key}"))) for key in ("dynamics/damping", "dynamics/friction")}
        limit = {key: j.findtext(f"axis/limit/{key}") for key in ("lower", "upper", "effort", "velocity")}
        said |= {
            "limits": None if limit["lower"] is None else (float(limit["lower"]), float(str(limit["upper"]))),
            "effort": float(str(limit["effort"])),
            "velocity": float(str(limit["velocity"])),
            "damping": number["dynamics/damping"],
            "friction": number["dynamics/friction"],
        }
    return joints, fixed


def _sdf_bodies(folder: Path, links: dict[str, ElementTree.Element]) -> dict[str, Body]:
    bodies = {}
    for name, link in links.items():
        inertial = link.find("inertial")
        assert inertial is not None
        v = {key: float(str(inertial.findtext(f"inertia/{key}"))) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")}
        tensor = np.array([[v["ixx"], v["ixy"], v["ixz"]], [v["ixy"], v["iyy"], v["iyz"]], [v["ixz"], v["iyz"], v["izz"]]])
        body = bodies[name] = Body(float(str(inertial.findtext("mass"))), _sdf_pose(inertial)[:3, 3], tensor)
        for c in link.findall("collision"):
            T, size = _sdf_pose(c), c.findtext("geometry/box/size")
            radius, length = c.findtext("geometry/cylinder/radius"), c.findtext("geometry/cylinder/length")
            if size:
                body.supports.append(box(T, np.array(size.split(), float)))
            elif radius:
                body.supports.append(cylinder(T, float(radius), float(str(length))))
            else:
                points = obj_points(folder / str(c.findtext("geometry/mesh/uri")))
                body.supports.append(cloud(points @ T[:3, :3].T + T[:3, 3]))
    return bodies


def read_sdf(folder: Path, name: str) -> Read:
    config = ElementTree.parse(folder / "model.config").getroot()
    model = ElementTree.parse(folder / str(config.findtext("sdf"))).getroot().find("model")
    assert model is not None

    links = {str(link.get("name")): link for link in model.findall("link")}
    rest: dict[str, np.ndarray] = {}

    def placed(link: str) -> np.ndarray:
        element = links[link].find("pose")
        on = element.get("relative_to") if element is not None else None
        return rest.setdefault(link, (placed(on) if on else np.eye(4)) @ _sdf_pose(links[link]))

    for link in links:
        placed(link)
    joints, fixed = _sdf_joints(model, rest)
    bodies = _sdf_bodies(folder, links)
    root = next(iter(links))
    move = chain(joints, root, lambda j, q: j["rest"] @ motion(KINDS[j["type"]], j.get("axis", np.zeros(3)), q))
    return Read(joints, bodies, move, fixed)


def read_usd(folder: Path, name: str) -> Read:
    stage = Usd.Stage.Open(str(folder / f"{name}.usdc"))
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert UsdGeom.GetStageMetersPerUnit(stage) == UsdPhysics.GetStageKilogramsPerUnit(stage) == 1
    cache = UsdGeom.XformCache()

    def matrix(m) -> np.ndarray:
        return np.array(m).T  # USD's vectors are rows

    def turned(q) -> np.ndarray:
        return matrix(Gf.Matrix4d().SetRotate(Gf.Quatd(q)))

    joints, fixed = {}, False
    bodies, placed = {}, {}
    for prim in stage.Traverse():
        if prim.HasAPI(UsdPhysics.RigidBodyAPI):
            placed[prim.GetName()] = matrix(cache.GetLocalToWorldTransform(prim))
            mass = UsdPhysics.MassAPI(prim)
            R = turned(mass.GetPrincipalAxesAttr().Get())[:3, :3]
            tensor = (R * np.array(mass.GetDiagonalInertiaAttr().Get())) @ R.T
            bodies[prim.GetName()] = Body(mass.GetMassAttr().Get(), np.array(mass.GetCenterOfMassAttr().Get()), tensor)
        elif prim.HasAPI(UsdPhysics.CollisionAPI):
            owner = prim.GetParent()
            T = matrix(cache.ComputeRelativeTransform(prim, owner)[0])
            body = bodies[owner.GetName()]
            if prim.IsA(UsdGeom.Cube):
                size = UsdGeom.Cube(prim).GetSizeAttr().Get() * np.linalg.norm(T[:3, :3], axis=0)
                body.supports.append(box(frame(T[:3, 3], T[:3, :3] / np.linalg.norm(T[:3, :3], axis=0)), size))
            elif prim.IsA(UsdGeom.Cylinder):
                assert UsdGeom.Cylinder(prim).GetAxisAttr().Get() == "Z"
                c = UsdGeom.Cylinder(prim)
                body.supports.append(cylinder(T, c.GetRadiusAttr().Get(), c.GetHeightAttr().Get()))
            else:
                assert UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get() == "convexHull"
                body.supports.append(cloud(np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get(), float)))
        elif prim.IsA(UsdPhysics.Joint):
            j = UsdPhysics.Joint(prim)
            ends = [rel.GetTargets()[0] for rel in (j.GetBody0Rel(), j.GetBody1Rel())]
            if not stage.GetPrimAtPath(ends[0]).HasAPI(UsdPhysics.RigidBodyAPI):
                fixed = prim.IsA(UsdPhysics.FixedJoint)
                continue
            joints[prim.GetName()] = said = _usd_joint(prim)
            said |= {"parent": ends[0].name, "child": ends[1].name}
            said["before"] = frame(j.GetLocalPos0Attr().Get()) @ turned(j.GetLocalRot0Attr().Get())
            said["after"] = np.linalg.inv(frame(j.GetLocalPos1Attr().Get()) @ turned(j.GetLocalRot1Attr().Get()))
    root = (set(bodies) - {j["child"] for j in joints.values()}).pop()
    move = chain(joints, root, lambda j, q: j["before"] @ motion(KINDS[j["type"]], j["axis"], q) @ j["after"])
    for link, T in move({}).items():
        np.testing.assert_allclose(placed[link], T, atol=1e-6)  # links are where the joints place them
    return Read(joints, bodies, move, fixed)


def _usd_joint(prim) -> dict:
    if prim.IsA(UsdPhysics.FixedJoint):
        return {"type": "fixed", "axis": np.zeros(3)}
    slides = prim.IsA(UsdPhysics.PrismaticJoint)
    joint = UsdPhysics.PrismaticJoint(prim) if slides else UsdPhysics.RevoluteJoint(prim)
    kind, unit = ("linear", 1.0) if slides else ("angular", np.pi / 180)
    lower, upper = joint.GetLowerLimitAttr().Get(), joint.GetUpperLimitAttr().Get()
    limits = (lower * unit, upper * unit) if np.isfinite(lower) else None
    drive = UsdPhysics.DriveAPI(prim, kind)

    def value(name: str) -> float:
        return prim.GetAttribute(name).Get()

    for physx, newton in (
        ("maxJointVelocity", "velocityLimit"),
        ("dynamicFrictionEffort", "friction"),
        ("viscousFrictionCoefficient", "damping"),
        ("armature", "armature"),
    ):
        assert value(f"physxJointAxis:{kind}:{physx}") == value(f"newton:{newton}")
    return {
        "type": "prismatic" if slides else "revolute" if limits else "continuous",
        "axis": np.eye(3)["XYZ".index(joint.GetAxisAttr().Get())],
        "limits": limits,
        "effort": drive.GetMaxForceAttr().Get(),
        "velocity": value("newton:velocityLimit") * unit,
        "damping": value("newton:damping") / unit,
        "friction": value("newton:friction"),
        "armature": value("newton:armature"),
        "drive": (drive.GetStiffnessAttr().Get() / unit, drive.GetDampingAttr().Get() / unit, drive.GetMaxForceAttr().Get()),
    }


def read_urdf(folder: Path, name: str) -> Read:
    robot = yourdfpy.URDF.load(str(folder / f"{name}.urdf"), mesh_dir=str(folder), load_meshes=False)
    transmissions = ElementTree.parse(folder / f"{name}.urdf").getroot().findall("transmission")
    gains = {t.find("joint").get("name"): t.find("actuator/{http://drake.mit.edu}controller_gains") for t in transmissions}
    joints = {}
    for j in robot.joint_map.values():
        joints[j.name] = {"type": j.type, "parent": j.parent, "child": j.child}
        if j.name in gains:
            joints[j.name]["drive"] = (float(gains[j.name].get("p")), float(gains[j.name].get("d")), j.limit.effort)
        if j.type != "fixed":
            joints[j.name] |= {
                "limits": None if j.type == "continuous" else (j.limit.lower, j.limit.upper),
                "effort": j.limit.effort,
                "velocity": j.limit.velocity,
                "damping": float(j.dynamics.damping),
                "friction": float(j.dynamics.friction),
            }
    for transmission in ElementTree.parse(folder / f"{name}.urdf").iter("transmission"):
        gains = transmission.find(f"actuator/{DRAKE}controller_gains")
        said = joints[transmission.find("joint").get("name")]
        said["drive"] = (float(gains.get("p")), float(gains.get("d")), said["effort"])
    bodies = {}
    for link in robot.robot.links:
        body = bodies[link.name] = Body(link.inertial.mass, link.inertial.origin[:3, 3], link.inertial.inertia)
        for c in link.collisions:
            g, T = c.geometry, c.origin
            if g.box is not None:
                body.supports.append(box(T, g.box.size))
            elif g.cylinder is not None:
                body.supports.append(cylinder(T, g.cylinder.radius, g.cylinder.length))
            else:
                body.supports.append(cloud(obj_points(folder / g.mesh.filename) @ T[:3, :3].T + T[:3, 3]))

    def poses(positions):
        robot.update_cfg({**dict.fromkeys(robot.actuated_joint_names, 0.0), **positions})
        return {link: robot.get_transform(link) for link in robot.link_map}

    return Read(joints, bodies, poses, None)


def read_mjcf(folder: Path, name: str) -> Read:
    model = mujoco.MjModel.from_xml_path(str(folder / f"{name}.xml"))
    data = mujoco.MjData(model)
    names = [model.body(b).name for b in range(model.nbody)]
    joints = {}
    for k in range(model.njnt):
        j, dof = model.joint(k), model.jnt_dofadr[k]
        if model.jnt_type[k] == mujoco.mjtJoint.mjJNT_FREE:
            continue
        slides = model.jnt_type[k] == mujoco.mjtJoint.mjJNT_SLIDE
        motor = model.actuator(j.name)
        child = int(model.jnt_bodyid[k])
        joints[j.name] = {
            "type": "prismatic" if slides else "revolute" if model.jnt_limited[k] else "continuous",
            "parent": names[model.body_parentid[child]],
            "child": names[child],
            "limits": tuple(j.range) if model.jnt_limited[k] else None,
            "effort": float(model.jnt_actfrcrange[k, 1]),
            "damping": float(np.atleast_2d(model.dof_damping.T)[0][dof]),
            "friction": float(model.dof_frictionloss[dof]),
            "armature": float(model.dof_armature[dof]),
            "drive": (float(motor.gainprm[0]), float(-motor.biasprm[2]), float(motor.forcerange[1])),
        }
    bodies = {}
    for b in range(1, model.nbody):
        R = Rotation.from_quat(model.body_iquat[b], scalar_first=True).as_matrix()
        bodies[names[b]] = Body(model.body_mass[b], model.body_ipos[b], (R * model.body_inertia[b]) @ R.T)
    for g in np.flatnonzero(model.geom_contype):
        body = bodies[names[model.geom_bodyid[g]]]
        T = frame(model.geom_pos[g], Rotation.from_quat(model.geom_quat[g], scalar_first=True).as_matrix())
        match mujoco.mjtGeom(model.geom_type[g]):
            case mujoco.mjtGeom.mjGEOM_BOX:
                body.supports.append(box(T, 2 * model.geom_size[g]))
            case mujoco.mjtGeom.mjGEOM_CYLINDER:
                body.supports.append(cylinder(T, model.geom_size[g, 0], 2 * model.geom_size[g, 1]))
            case _:
                mesh = model.mesh(model.geom_dataid[g])
                v = model.mesh_vert[mesh.vertadr[0] : mesh.vertadr[0] + mesh.vertnum[0]]
                body.supports.append(cloud(v @ T[:3, :3].T + T[:3, 3]))

    def poses(positions):
        mujoco.mj_resetData(model, data)
        for key, value in positions.items():
            data.joint(key).qpos = value
        mujoco.mj_kinematics(model, data)
        return {n: frame(data.body(n).xpos, data.body(n).xmat.reshape(3, 3)) for n in names[1:]}

    return Read(joints, bodies, poses, all(model.jnt_type != mujoco.mjtJoint.mjJNT_FREE))


READERS = {"urdf": read_urdf, "mjcf": read_mjcf, "usd": read_usd, "sdf": read_sdf, "glb": read_glb}
