"""An asset folder in one piece: as a ROS 2 package, and as a zip whose bytes depend on its content only.

A package has package.xml, CMakeLists.txt, urdf/ with package:// paths, and meshes/.
"""

from __future__ import annotations

import io
import re
import shutil
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

import anymesh
from anymesh.errors import InputError, OutputError
from anymesh.export.model import FOLDER
from anymesh.export.notation import document, rpy, vector
from anymesh.export.options import Base
from anymesh.names import legal_names
from anymesh.runtime import read_json

CMAKE = """cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
install(DIRECTORY urdf meshes DESTINATION share/${{PROJECT_NAME}})
ament_package()
"""
SUFFIXES = {".obj", ".mtl", ".dae", ".png", ".jpg"}  # files used by a URDF's meshes; face indices are left out
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date that a zip can hold
PLAIN_FILE = 0o100644 << 16  # a file readable by all and writable by its owner


def write_package(folder: Path, into: Path, *, base: Base) -> Path:
    """Write a package of the one URDF in an asset folder as a new folder in `into`; return the package's folder.

    A fixed base gets the link `world` to which ROS and Gazebo fix it; a free one has none. A handle gets a link without mass,
    which is a frame in ROS and in Gazebo; not in a URDF for engines, where PyBullet gives it a mass of 1 kg.

    Raise InputError if the folder has no URDF, OutputError if the package exists.
    """
    urdfs = sorted(folder.glob("*.urdf"))
    if len(urdfs) != 1:
        raise InputError(f"{folder}: a package needs one .urdf, found {len(urdfs)}")
    name = package_name(urdfs[0].stem)
    package = into / name
    if package.exists() or (into.exists() and not into.is_dir()):
        raise OutputError(f"{package if package.exists() else into} exists; valid is a folder without a package of this name")
    (package / "urdf").mkdir(parents=True)
    (package / FOLDER).mkdir()
    for file in sorted((folder / FOLDER).iterdir()):
        if file.suffix in SUFFIXES:
            shutil.copyfile(file, package / FOLDER / file.name)
    texts = {
        "package.xml": _manifest(name, ElementTree.parse(urdfs[0]).find("credits")),
        "CMakeLists.txt": CMAKE.format(name=name),
        f"urdf/{urdfs[0].name}": _packaged(urdfs[0].read_text(encoding="utf-8"), name, base, _handles(folder)),
    }
    for path, text in texts.items():
        (package / path).write_text(text, encoding="utf-8", newline="\n")
    return package


def package_name(name: str) -> str:
    """Return a name that ROS accepts: lower case, starting with a letter, without double underscores or one at the end."""
    return re.sub(r"_+", "_", name.lower()).strip("_")


def _manifest(name: str, credits: ElementTree.Element | None) -> str:
    root = ElementTree.Element("package", format="3")
    sub = ElementTree.SubElement
    sub(root, "name").text = name
    sub(root, "version").text = ".".join(re.findall(r"\d+", anymesh.__version__)[:3])
    sub(root, "description").text = "An articulated object, made by Articulate AnyMesh"
    sub(root, "maintainer", email="unknown@example.com").text = "unknown"
    stated = {} if credits is None else credits.attrib
    sub(root, "license").text = stated.get("license", "As the mesh that it was made from")
    if "author" in stated:
        sub(root, "author").text = stated["author"]
    sub(root, "buildtool_depend").text = "ament_cmake"
    sub(sub(root, "export"), "build_type").text = "ament_cmake"
    return document(root)


def _handles(folder: Path) -> list[dict[str, Any]]:
    """Return the handles of an asset, with the origins of their links."""
    joints = (read_json(folder / "asset.json") or {}).get("joints", [])
    origins = {j["child"]: j["origin"] for j in joints}
    return [j["handle"] | {"origin": origins[j["handle"]["link"]]} for j in joints if "handle" in j]


def _packaged(text: str, name: str, base: Base, handles: list[dict[str, Any]]) -> str:
    """Return the URDF with paths in the package, a link per handle, and a world link if its base is fixed."""
    robot = ElementTree.fromstring(text)
    for mesh in robot.iter("mesh"):
        mesh.set("filename", f"package://{name}/{mesh.get('filename')}")
    for handle in handles:
        place, (y, z) = np.subtract(handle["place"], handle["origin"]), (np.array(handle[k]) for k in ("closing", "approach"))
        ElementTree.SubElement(robot, "link", name=handle["name"])
        joint = ElementTree.SubElement(robot, "joint", name=f"{handle['name']}_joint", type="fixed")
        turned = vector(rpy(np.stack([np.cross(y, z), y, z], 1)))
        ElementTree.SubElement(joint, "origin", xyz=vector(place), rpy=turned)
        ElementTree.SubElement(joint, "parent", link=handle["link"])
        ElementTree.SubElement(joint, "child", link=handle["name"])
    if base is Base.FIXED:
        children = {str(c.get("link")) for c in robot.iter("child")}
        root = next(str(link.get("name")) for link in robot.iter("link") if link.get("name") not in children)
        taken = [str(j.get("name")) for j in robot.findall("joint")]
        joint = ElementTree.Element("joint", name=legal_names([*taken, "fixed_base"], fallback="joint")[-1], type="fixed")
        ElementTree.SubElement(joint, "parent", link="world")
        ElementTree.SubElement(joint, "child", link=root)
        robot[:0] = [ElementTree.Element("link", name="world"), joint]
    return document(robot)


def check_zip(path: Path) -> None:
    """Raise OutputError if no zip can be written there."""
    if path.suffix.lower() != ".zip" or path.is_dir() or not path.parent.is_dir():
        raise OutputError(f"--zip: found {str(path)!r}; valid is the path of a file that ends in .zip, in an existing folder")


def write_zip(folder: Path, path: Path) -> None:
    """Zip an asset folder under its own name, with files sorted by name and fixed dates and permissions.

    Hidden files and saved stages, which no simulator needs, are left out.
    """
    partial = path.with_name(f".{path.name}.partial")
    with partial.open("wb") as sink:
        _zip(folder, sink, without=path)
    partial.replace(path)


def zip_bytes(folder: Path) -> bytes:
    """Return the zip of an asset folder, as `write_zip` writes it."""
    sink = io.BytesIO()
    _zip(folder, sink)
    return sink.getvalue()


def _zip(folder: Path, sink: io.BufferedIOBase, without: Path | None = None) -> None:
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        for file in sorted(p for p in folder.rglob("*") if p.is_file()):
            inside = file.relative_to(folder)
            if file == without or inside.parts[0] == "stages" or any(part.startswith(".") for part in inside.parts):
                continue
            entry = zipfile.ZipInfo(f"{folder.name}/{inside.as_posix()}", EPOCH)
            entry.compress_type, entry.external_attr, entry.create_system = zipfile.ZIP_DEFLATED, PLAIN_FILE, 3
            archive.writestr(entry, file.read_bytes())
