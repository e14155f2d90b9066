"""PhysX by ovphysx, the engine of Isaac Sim, on the CPU, from the USD, or SimReady with its variant for PhysX."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import ovphysx
import ovstage
from common import Asset, finite, frame, motion, placed, serve, turn_of
from ovphysx.samples.python_samples.schema_support import physx_schema_paths
from ovphysx.types import ObjectScope, SimObjectType

PLACE = tempfile.TemporaryDirectory()
DEGREE = np.pi / 180
JOINT, LINK, TENDON = SimObjectType.ARTICULATION_JOINT, SimObjectType.ARTICULATION_LINK, SimObjectType.FIXED_TENDON
ALL = {"scope": ObjectScope.ALL}
HELD = {
    "effort": "jointMaxForce",
    "velocity": "jointMaxVelocity",
    "damping": "jointViscousFriction",
    "friction": "jointDynamicFriction",
    "armature": "jointArmature",
}
ovphysx.PhysX.set_cpu_mode(True)


def values(physx: ovphysx.PhysX, kind: SimObjectType, name: str) -> dict[str, np.ndarray]:
    """Return an attribute by the path of its prim."""
    found = {}
    with physx.read_sync(kind, [name], **ALL) as result:
        for group in result.groups:
            paths = result.dictionary.get_path_strings(group.prim_list)
            columns = [np.array(t.numpy(), float) for t in group.tensors]
            rows = columns if kind is JOINT else list(columns[0])  # a tensor for each joint, but one for all links
            found |= {path: np.ravel(row) for path, row in zip(paths, rows, strict=True)}
    return found


def poses(physx: ovphysx.PhysX) -> dict[str, np.ndarray]:
    """Return the pose of each link in the world by its path."""
    at, turn = values(physx, LINK, "position"), values(physx, LINK, "orientation")
    return {path: frame(at[path], turn_of(*turn[path])) for path in at}


def place(physx: ovphysx.PhysX, names: ovstage.PathDictionary, joint: str, position: float) -> None:
    """Move a joint [degrees or m], and the others to 0."""
    with physx.write_sync(JOINT, "jointPosition", **ALL) as session:
        for group in session.groups:
            for path, tensor in zip(names.get_path_strings(group.prim_list), group.tensors, strict=True):
                tensor.assign(np.full(tensor.shape, position if path == joint else 0, np.float32))
            session.commit_sync(group)
    physx.update_articulations_kinematic()


def last(path: str) -> str:
    return path.rsplit("/", 1)[-1]


def read(asset: Asset, variant: str) -> dict:
    path = asset.enabled("PhysX", Path(PLACE.name)) if variant == "simready" else asset.file(variant)
    physx = ovphysx.PhysX()
    stage = ovstage.Stage(asset.content["name"])
    ovstage.population.open_usd(stage, str(path), ordinal=1, domains=ovstage.PopulationDomain.ALL)
    stage.advance_write_floor(ordinal=1).wait()
    physx.wait_task(physx.attach_ovstage(stage, read_ordinal=1))
    physx.step_sync(1e-5)
    links, names = {}, ovstage.PathDictionary(stage)
    mass, center, inertia = (values(physx, LINK, name) for name in ("mass", "centerOfMassPosition", "inertia"))
    places = poses(physx)
    root = next(T for path, T in places.items() if last(path) == asset.root)
    rest = {last(path): np.linalg.inv(root) @ T for path, T in places.items()}
    for path in mass:
        links[last(path)] = placed(rest[last(path)], mass[path][0], center[path], inertia[path])
    held = {key: values(physx, JOINT, name) for key, name in HELD.items()}
    springs = {last(path): row[0] for path, row in values(physx, TENDON, "tendonStiffness").items()}
    lengths = {last(path): row[0] for path, row in values(physx, TENDON, "tendonRestLength").items()}
    joints = {}
    for path, row in values(physx, JOINT, "jointLimit").items():
        name, turns = last(path), asset.joints[last(path)]["type"] != "prismatic"
        unit = DEGREE if turns else 1.0
        limits = finite(*(np.clip(row, -1e9, 1e9) * unit))
        record = joints[name] = {"type": "prismatic" if not turns else "revolute" if limits else "continuous"}
        record |= {key: column[path][0] for key, column in held.items()} | {"limits": limits}
        if name in springs:  # of a tendon of one joint
            record |= {"stiffness": springs[name], "reference": lengths[name]}
        record["damping"] /= unit
        record["velocity"] *= unit
        child, amount = asset.joints[name]["child"], asset.amount(name)
        place(physx, names, path, amount / unit)
        after = {last(p): T for p, T in poses(physx).items()}
        record |= motion(rest[child], np.linalg.inv(after[asset.root]) @ after[child], amount)
        place(physx, names, path, 0.0)
    del held
    return {"version": f"ovphysx {ovphysx.__version__}", "joints": joints, "links": links}


ovstage.population.register_usd_schemas([*map(str, physx_schema_paths()), str(ovphysx.newton_schema_root())])
serve(read)
