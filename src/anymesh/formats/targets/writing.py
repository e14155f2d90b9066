"""An asset as one project's loader wants it, in a folder of its own: TARGET/NAME/, beside what it needs of meshes/.

robosuite, robocasa   model.xml     a body `object` about its middle, sites of its size; for robocasa also boxes of regions
maniskill             mobility_cvx.urdf, as of PartNet-Mobility: handles are shapes of their own, the front faces -x
genesis               NAME.xml
isaaclab              NAME.usdc, and NAME_cfg.py with its ArticulationCfg
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

from anymesh.export.formats import main_file
from anymesh.export.links import Primitive
from anymesh.export.meshes import material_names, texture_files, write_obj
from anymesh.export.model import FOLDER, ExportLink, Model
from anymesh.export.notation import document, quaternion, rpy, vector
from anymesh.export.options import Base, Format, TargetProject
from anymesh.geometry.kinematics import link_transforms
from anymesh.kinds.usual import kind_of
from anymesh.names import legal_names
from anymesh.rendering.viewpoints import away
from anymesh.types import JointType

Sub = ElementTree.SubElement
GROUPS = {"visual": {"contype": "0", "conaffinity": "0", "group": "1"}, "collision": {"group": "0"}}  # instead of our classes
BITS = range(1, 31)  # of contacts, beside the one that everything has
# RoboCasa's names of insides, and of doors' joints, by kind of object; those of `SHELVED` are counted from below
REGIONS = {"microwave": "tray", "fridge": "fridge_shelf", "oven": "rack", "dishwasher": "rack"}
SHELVED = ("fridge", "oven", "dishwasher")
DOORS = {"microwave": "microjoint", "fridge": "fridge_door_joint", "oven": "door_joint", "dishwasher": "door_joint"}
ALONG = 0.9998  # minimum cosine of a region's axes to those of the object, within a degree
NO_ARMATURE = "1e-9"  # [kg m2]
SUFFIXES = {".obj", ".mtl", ".dae", ".png", ".jpg"}


def write_target(model: Model, folder: Path) -> None:
    """Write the folder of the target anew; those of other targets go."""
    for target in TargetProject:
        shutil.rmtree(folder / target, ignore_errors=True)
    if model.how.target is not TargetProject.NONE:
        into = folder / model.how.target / model.asset.name
        into.mkdir(parents=True)
        WRITERS[model.how.target](model, folder, into)


def turn_to_front(model: Model) -> Float[np.ndarray, "3 3"]:
    """Return the quarter turns about z after which the front faces -y.

    The front is the one that was answered, else the side to which parts open, opposite the hinge of a lid, else that at -y.
    """
    asset, way = model.asset, np.array([0.0, -1.0, 0.0])
    if asset.front is not None:
        way = away(np.deg2rad(asset.front), 0.0)
    elif model.states:
        closed, half = (link_transforms(asset, model.states[state]) for state in ("closed", "half"))
        middles = {link.name: [*(link.origin + link.triangles.mean((0, 1))), 1.0] for link in model.links}
        moved = np.array([(half[name] - closed[name])[:3] @ middle for name, middle in middles.items()])
        lifted = np.abs(moved[:, 2]) > np.linalg.norm(moved[:, :2], axis=1)
        total = (moved * np.where(lifted, -1, 1)[:, None]).sum(0)
        way = total if np.linalg.norm(total[:2]) > 1e-3 * asset.mesh.diagonal else way
    quarters = round((-np.pi / 2 - np.arctan2(way[1], way[0])) / (np.pi / 2)) % 4
    c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarters]
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def _write_object(model: Model, folder: Path, into: Path) -> None:
    """Write model.xml for robosuite or RoboCasa: they read its bodies and meshes, and merge the rest only if asked to."""
    root = ElementTree.parse(folder / main_file(Format.MJCF, model.asset.name)).getroot()
    for tag in ("keyframe", "default"):  # positions of a scene differ; defaults are read one level deep only
        for element in root.findall(tag):
            root.remove(element)
    for geom in root.iter("geom"):
        geom.attrib.update(GROUPS[geom.attrib.pop("class")])
    _contacts(root, [(e.a, e.b) for e in model.exclusions])
    _copy_assets(root, folder, into)
    for element in root.iter():  # where the name that the loaders look for is taken
        keys = ("body1", "body2", *(["name"] if element.tag == "body" else []))
        element.attrib.update({k: "object_0" for k in keys if element.get(k) == "object"})
    world, R = root.find("worldbody"), turn_to_front(model)
    if world is None:
        raise ValueError("the MJCF has no world")
    points = model.asset.mesh.vertices[np.unique(model.asset.mesh.faces)] @ R.T
    low, high = points.min(0), points.max(0)
    middle, half = (low + high) / 2, (high - low) / 2
    outer = ElementTree.Element("body")
    inner = Sub(outer, "body", name="object")
    for body in world.findall("body"):  # the root, and parts that only lie on it, which a body within another cannot
        for joint in (*body.findall("freejoint"), *body.findall("joint[@type='free']")):  # loaders add one to the whole
            body.remove(joint)
        place = R @ [float(v) for v in body.get("pos", "0 0 0").split()] - middle
        body.attrib.update(pos=vector(place), quat=vector(quaternion(R)))
        world.remove(body)
        inner.append(body)
    world.append(outer)
    radius = float(np.linalg.norm((points - middle)[:, :2], axis=1).max())
    wide = (
        (half[0], half[1], 0.0) if model.how.target is TargetProject.ROBOCASA else (radius, radius, 0.0)
    )  # its length, or its x
    sites = {"bottom_site": (0.0, 0.0, -half[2]), "top_site": (0.0, 0.0, half[2]), "horizontal_radius_site": wide}
    for name, place in sites.items():
        Sub(outer, "site", name=name, pos=vector(place), size="0.005", rgba="0 0 0 0")
    if model.how.target is TargetProject.ROBOCASA:
        regions = {"main": (low, high), "bbox": (low, high), **_regions(model, R)}
        for name, (least, most) in regions.items():
            words = {
                "name": f"reg_{name}",
                "type": "box",
                "pos": vector((least + most) / 2 - middle),
                "size": vector((most - least) / 2),
            }
            Sub(inner, "geom", words, group="1", contype="0", conaffinity="0", mass="0", rgba="0 1 0 0")
        _closed_at_zero(root, model)
        _name_doors(root, model)
    ElementTree.indent(root)
    (into / "model.xml").write_text(ElementTree.tostring(root, encoding="unicode") + "\n", encoding="utf-8", newline="\n")


def _copy_assets(root: ElementTree.Element, folder: Path, into: Path) -> None:
    """Copy the meshes and pictures of an MJCF."""
    for element in root.iterfind("asset/*[@file]"):
        file = into / str(element.get("file"))
        file.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(folder / str(element.get("file")), file)


def _regions(model: Model, R: np.ndarray) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return the lowest and highest corner of RoboCasa's regions by name, turned by R: places along the axes when closed.

    Insides of what RoboCasa has a fixture of are called as it looks for them, else `int`, the largest first; others are `top`.
    """
    closed = link_transforms(model.asset, model.states.get("closed", {}))
    slides = {j.child for j in model.asset.joints if j.type is JointType.PRISMATIC}
    regions, kind = dict[str, tuple[np.ndarray, np.ndarray]](), _kind(model)
    shelved, largest = kind in SHELVED, sorted(model.places, key=lambda p: -float(np.prod(p.size)))
    for at in model.places if shelved else largest:
        T = R @ closed[at.link][:3]
        axes = T[:, :3] @ at.R
        if np.abs(axes).max(1).min() < ALONG:
            continue
        foot, half = T @ [*at.place, 1.0], np.abs(axes) @ at.size / 2
        name = "int" if at.inside else "top"
        if at.inside and kind in REGIONS:
            name = REGIONS[kind].replace("shelf", "drawer" if at.link in slides else "shelf")
        number = sum(other.rstrip("0123456789").rstrip("_") == name for other in regions)
        numbered = f"{name}{number}" if shelved and at.inside else f"{name}_{number}" if number else name
        low, high = np.array([*-half[:2], 0.0]), np.array([*half[:2], 2 * half[2]])
        regions[numbered] = foot + low, foot + high
    return regions


def _kind(model: Model) -> str:
    kind = kind_of(model.asset.category, model.asset.name)
    return "" if kind is None else kind.name


def _name_doors(root: ElementTree.Element, model: Model) -> None:
    """Call the doors' joints as RoboCasa's fixture of this kind looks for them."""
    doors = [j.name for j in model.asset.joints if j.type is JointType.REVOLUTE and j.name in model.states.get("open", {})]
    word = DOORS.get(_kind(model))
    taken = [str(e.get("name")) for e in root.iter() if e.get("name") not in (None, *doors)]
    new = dict(zip(doors, legal_names([*taken, *[word] * len(doors)])[len(taken) :], strict=True)) if word else {}
    for element in root.iter():
        keys = ("joint", "joint1", "joint2", *(["name"] if element.tag == "joint" else []))
        element.attrib.update({k: new[element.attrib[k]] for k in keys if element.get(k) in new})


def _contacts(root: ElementTree.Element, pairs: list[tuple[str, str]]) -> None:
    """Keep excluded pairs of links from touching by bits of contact, since the loaders drop `exclude`.

    Links of such a pair take part with what everything else has, but not with each other; others of them by a bit of their own.
    """
    excluded = {frozenset(pair) for pair in pairs}
    links = sorted({name for pair in pairs for name in pair})
    bits = {name: [1, 0] for name in links}
    others = [pair for pair in combinations(links, 2) if frozenset(pair) not in excluded]
    for bit, (a, b) in zip(BITS, others, strict=False):
        bits[a][0] |= 1 << bit
        bits[b][1] |= 1 << bit
    for body in root.iter("body"):
        for geom in body.findall("geom") if body.get("name") in bits else ():
            if geom.get("group") == "0":
                geom.set("contype", str(bits[str(body.get("name"))][0]))
                geom.set("conaffinity", str(bits[str(body.get("name"))][1]))


def _closed_at_zero(root: ElementTree.Element, model: Model) -> None:
    """Count positions of joints from where they are closed, as RoboCasa does, where they are modelled open."""
    for joint in root.iter("joint"):
        closed = model.states.get("closed", {}).get(str(joint.get("name")), 0.0)
        if closed:
            joint.set("ref", vector([-closed]))
            for key in ("range", "springref"):
                if key in joint.attrib:
                    joint.set(key, vector([float(v) - closed for v in joint.attrib[key].split()]))


def _write_maniskill(model: Model, folder: Path, into: Path) -> None:
    """Write a URDF whose handles are visuals of the links that joints move, called handle_*; a fixed base is turned to -x."""
    robot = ElementTree.parse(folder / main_file(Format.URDF, model.asset.name)).getroot()
    _copy_meshes(folder, into)
    links, bodies = {str(e.get("name")): e for e in robot.findall("link")}, {body.name: body for body in model.bodies}
    names, moving = material_names(model.asset.mesh.materials), {j.name: j for j in model.asset.joints}
    for handle in model.handles:
        body, carrier = bodies[handle.link], bodies[moving[handle.joint].child]
        files = [f"{FOLDER}/{handle.name}.obj", body.visual_path()]
        for path, primitives in zip(files, _divided(model, body, handle.faces), strict=True):
            visual = links[body.name].find("visual") if path == files[1] else None
            if primitives:
                write_obj(into / path, Path(path).stem, f"{body.name}.mtl", primitives, names)
            elif visual is not None:
                links[body.name].remove(visual)
        visual = Sub(links[carrier.name], "visual", name=f"handle_{handle.name}")
        Sub(visual, "origin", xyz=vector(body.link.origin - carrier.link.origin), rpy="0 0 0")
        Sub(Sub(visual, "geometry"), "mesh", filename=files[0])
    if model.how.base is Base.FIXED:
        taken, root = set(links), model.bodies[0].name
        name = next(n for n in ("root", *(f"root_{k}" for k in range(len(taken) + 1))) if n not in taken)
        joint = ElementTree.Element("joint", name=f"{name}_joint", type="fixed")
        facing = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]]) @ turn_to_front(model)
        Sub(joint, "origin", xyz="0 0 0", rpy=vector(rpy(facing)))
        Sub(joint, "parent", link=name)
        Sub(joint, "child", link=root)
        robot[:0] = [ElementTree.Element("link", name=name), joint]
    (into / "mobility_cvx.urdf").write_text(document(robot), encoding="utf-8", newline="\n")


def _divided(model: Model, body: ExportLink, faces: np.ndarray) -> tuple[list[Primitive], list[Primitive]]:
    """Return the primitives of some faces of a link, and those of its other faces."""
    material, chosen = model.asset.mesh.face_material, np.isin(body.link.faces, faces)
    inside, outside = [], []
    for p in body.link.primitives:
        ours = chosen[material[body.link.faces] == p.material]  # both in the order of the mesh
        for those, some in ((inside, ours), (outside, ~ours)):
            if some.any():
                those.append(replace(p, triangles=p.triangles[some]))
    return inside, outside


def _write_genesis(model: Model, folder: Path, into: Path) -> None:
    """Copy the MJCF, with armature: Genesis gives a joint .1 kg m2 where a file states none or 0."""
    file = main_file(Format.MJCF, model.asset.name)
    root = ElementTree.parse(folder / file).getroot()
    _copy_assets(root, folder, into)
    for joint in root.iterfind("worldbody//joint"):
        joint.attrib.setdefault("armature", NO_ARMATURE)
    (into / file).write_text(ElementTree.tostring(root, encoding="unicode") + "\n", encoding="utf-8", newline="\n")


def _copy_meshes(folder: Path, into: Path) -> None:
    (into / FOLDER).mkdir()
    for file in sorted((folder / FOLDER).iterdir()):
        if file.suffix in SUFFIXES:
            shutil.copyfile(file, into / FOLDER / file.name)


CONFIGURATION = '''"""{name} in Isaac Lab; put the folder beside your assets and import {constant}."""

from pathlib import Path

import isaaclab.sim as sim_utils
from isaaclab.actuators import ImplicitActuatorCfg
from isaaclab.assets import ArticulationCfg

STATES = {states}  # positions of joints [rad or m]

{constant} = ArticulationCfg(
    spawn=sim_utils.UsdFileCfg(usd_path=str(Path(__file__).with_name("{file}")), activate_contact_sensors=True),
    init_state=ArticulationCfg.InitialStateCfg(joint_pos={rest}),
    actuators={{  # None: as the file has it
        "joints": ImplicitActuatorCfg(joint_names_expr=[".*"], stiffness=None, damping=None),
    }},
)
'''


def _write_isaaclab(model: Model, folder: Path, into: Path) -> None:
    name, file = model.asset.name, main_file(Format.USD, model.asset.name)
    shutil.copyfile(folder / file, into / file)
    for picture in sorted(set(texture_files(model.tinted.asset.mesh).values())):
        (into / FOLDER).mkdir(exist_ok=True)
        shutil.copyfile(folder / FOLDER / picture, into / FOLDER / picture)
    rest = {j.name: 0.0 for j in model.asset.joints if j.name in model.resistances}
    states = {state: {joint: round(v, 6) for joint, v in at.items()} for state, at in model.states.items()}
    words = {"name": name, "constant": f"{name.upper()}_CFG", "file": file, "states": states, "rest": rest}
    (into / f"{name}_cfg.py").write_text(CONFIGURATION.format(**words), encoding="utf-8", newline="\n")


WRITERS: Mapping[TargetProject, Callable[[Model, Path, Path], None]] = {
    TargetProject.ROBOSUITE: _write_object,
    TargetProject.ROBOCASA: _write_object,
    TargetProject.MANISKILL: _write_maniskill,
    TargetProject.GENESIS: _write_genesis,
    TargetProject.ISAACLAB: _write_isaaclab,
}
