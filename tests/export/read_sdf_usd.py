"""Content of SDFormat and OpenUSD files, read independently of the writers."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdPhysics
from read_content import KINDS, Body, Read, box, chain, cloud, cylinder, frame, motion, obj_points
from scipy.spatial.transform import Rotation


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
        "drive": (drive.GetStiffnessAttr().Get() / unit, drive.GetDampingAttr().Get() / unit, drive.GetMaxForceAttr().Get()),
    }
