"""Sweet Home 3D's built-in furniture, doors and windows with hinges and rails, by artists (GPL or CC-BY; not shipped).

The models are in the program's jar, installed by the Debian package `sweethome3d` (`apt-get install sweethome3d`); the package
file itself (`apt-get download sweethome3d`) works as well.
In a model, groups `sweethome3d_hinge_K` mark a hinge along the longest side of their common box, and groups `..._on_hinge_K...`
rotate about it. Rails work alike; a rail called unique is shared by all. Markers and names would reveal the answer, so neither
is written to the mesh.

Sweet Home 3D does not limit motions, so ranges are unknown. Doors and windows, however, have sashes in the catalogue, whose
arcs give the side and the angle of their opening.
"""

from __future__ import annotations

import io
import math
import re
import tarfile
import zipfile
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from anymesh.errors import InputError, MissingExtraError
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.datasets.links import DatasetLink, assemble
from anymesh.evaluation.ground_truth import GroundTruth
from anymesh.formats.obj import read_obj
from anymesh.loading.files import Folder
from anymesh.types import JointType, KnownJoint, Mesh

MAGIC = b"!<arch>\n"
HEADER = 60  # bytes before each member of the archive
INSTALLED = Path("/usr/share/sweethome3d/sweethome3d.jar")
CATALOG = "com/eteks/sweethome3d/io/DefaultFurnitureCatalog.properties"
ON = re.compile(r"sweethome3d_(?:opening|window_pane|mirror)_on_(hinge|rail)_([^_]+)")
MARKER = re.compile(r"sweethome3d_(?:unique_(rail)|(hinge|rail)_([^_]+))")
TYPES = {"hinge": JointType.REVOLUTE, "rail": JointType.PRISMATIC}
CLOSED = 10.0  # [deg] a sash nearer than this to an end of its arc is at rest there


def member(package: Path, name: str) -> io.BytesIO:
    """Return the first file of that name in the .deb. Raise InputError if it cannot be read."""
    archive = package.read_bytes()
    if not archive.startswith(MAGIC):
        raise InputError(f"{package.name} is not a Debian package file; it must start with {MAGIC!r}")
    at = len(MAGIC)
    while at + HEADER <= len(archive):
        header = archive[at : at + HEADER]
        size = int(header[48:58])
        if header[:16].strip().rstrip(b"/").startswith(b"data.tar"):
            return _from_tar(package.name, archive[at + HEADER : at + HEADER + size], name)
        at += HEADER + size + size % 2
    raise InputError(f"{package.name} holds no data.tar; it is broken or truncated")


def _from_tar(package: str, data: bytes, name: str) -> io.BytesIO:
    try:
        with tarfile.open(fileobj=io.BytesIO(data)) as tar:
            tar_member = next((m for m in tar if m.isfile() and m.name.rsplit("/", 1)[-1] == name), None)
            opened = None if tar_member is None else tar.extractfile(tar_member)
            if opened is not None:
                return io.BytesIO(opened.read())
    except (tarfile.TarError, EOFError, OSError) as error:
        raise InputError(f"{package}: its data cannot be read ({error}); valid are packages packed with xz or gzip") from None
    raise InputError(f"{package}: found no file {name} in the package")


@dataclass(frozen=True)
class Sash:
    """A wing of a door or window in the floor plan: its hinge (shares of width and depth) and the ends of its arc [deg].

    Angles are about +y from +x of the model, whose front is +z.
    """

    at: tuple[float, float]
    arc: tuple[float, float]


@dataclass(frozen=True)
class SweetHome3D(Dataset):
    """Sweet Home 3D data set. source: the .deb, the .jar, or a folder that contains the jar."""

    source: Path = INSTALLED
    name: str = "sweethome3d"

    @cached_property
    def _jar(self) -> zipfile.ZipFile:
        return _open(self.source)

    @cached_property
    def _catalog(self) -> dict[str, dict[str, str]]:
        """Catalogue entries of the models, by file name."""
        entries: dict[str, dict[str, str]] = {}
        for line in self._jar.read(CATALOG).decode("latin-1").splitlines():
            if entry := re.match(r"(\w+)#(\d+)=(.*)", line.strip()):
                key, number, value = entry.groups()
                entries.setdefault(number, {})[key] = value.strip()
        models = [e for e in entries.values() if e.get("model", "").endswith(".obj")]
        return {Path(e["model"]).stem: e for e in models}

    def _model(self, entry: dict[str, str]) -> bytes:
        return self._jar.read(entry["model"].lstrip("/"))

    def _names(self) -> list[str]:
        """Return the models with at least one moving part."""
        return sorted(name for name, entry in self._catalog.items() if ON.search(self._model(entry).decode("latin-1")))

    def truth(self, name: str, folder: Path) -> GroundTruth:
        entry = self._catalog.get(name)
        if entry is None:
            raise InputError(f"{self.source.name}: found no model {name!r}; valid are {', '.join(self.objects())}")
        mesh = read_obj(self._model(entry), Folder(Path(f"{name}.obj")))
        mesh = mesh.transformed(np.diag([*[float(entry["height"]) / 100 / mesh.extents[1]] * 3, 1.0]))
        bodies = _bodies(mesh, _sashes(entry))
        return assemble(name, bodies, folder / f"{name}.glb", entry.get("name", "object").lower())


def _open(source: Path) -> zipfile.ZipFile:
    if source.is_dir():
        source = next(iter(sorted(source.rglob("sweethome3d.jar"))), source / INSTALLED.name)
    if not source.is_file():
        raise MissingExtraError(
            f"sweethome3d: found no file {source}; `apt-get install sweethome3d` brings it, or name the package file or the "
            "jar: sweethome3d:FILE"
        )
    try:
        return zipfile.ZipFile(member(source, INSTALLED.name) if source.suffix == ".deb" else source)
    except zipfile.BadZipFile:
        raise InputError(f"{source.name} is neither a .jar nor a .deb file of Sweet Home 3D") from None


def _sashes(entry: dict[str, str]) -> list[Sash]:
    def numbers(key: str) -> list[float]:
        return [float(x) for x in entry.get(f"doorOrWindowSash{key}", "").split()]

    width, depth = float(entry["width"]), float(entry["depth"])
    rows = zip(*(numbers(k) for k in ("XAxis", "YAxis", "StartAngle", "EndAngle")), strict=True)
    return [Sash((x / width, y / depth), (min(a, b), max(a, b))) for x, y, a, b in rows]


def _bodies(mesh: Mesh, sashes: list[Sash]) -> list[DatasetLink]:
    """Return one link for the static groups, and one for those on each hinge or rail."""
    groups = [node.name for node in mesh.nodes]
    owner = {g: on.group(1, 2) for g in groups if (on := ON.match(g))}
    markers: dict[tuple[str, str | None], list[str]] = {}
    for g in groups:
        if match := MARKER.match(g):
            markers.setdefault((match[1] or match[2], match[3]), []).append(g)
    hidden = {g for names in markers.values() for g in names}
    bodies = [DatasetLink("base", meshes=_pieces(mesh, [g for g in groups if g not in owner and g not in hidden]))]
    for kind, number in dict.fromkeys(owner.values()):
        pieces = _pieces(mesh, [g for g in groups if owner.get(g) == (kind, number)])
        marker = markers.get((kind, number)) or markers.get((kind, None))
        if marker is None:
            raise InputError(f"found a part on {kind} {number}, but no group that marks where it is")
        motion = _motion(TYPES[kind], np.concatenate([p.triangles.reshape(-1, 3) for p in _pieces(mesh, marker)]))
        if kind == "hinge" and sashes and abs(motion.axis[1]) == 1:
            motion = _opened(motion, pieces, sashes, mesh.bounds)
        bodies.append(DatasetLink(f"{kind}_{number}", "base", motion, pieces))
    return bodies


def _pieces(mesh: Mesh, groups: list[str]) -> tuple[Mesh, ...]:
    numbers = [k for k, node in enumerate(mesh.nodes) if node.name in groups]
    return tuple(mesh.subset(mesh.face_node == k) for k in numbers if (mesh.face_node == k).any())


def _motion(kind: JointType, points: np.ndarray) -> KnownJoint:
    """Return a motion along the longest side of the marker's box, through its centre."""
    low, high = points.min(0), points.max(0)
    return KnownJoint(kind, (low + high) / 2, np.eye(3)[int((high - low).argmax())], None, range_known=False)


def _opened(motion: KnownJoint, pieces: tuple[Mesh, ...], sashes: list[Sash], bounds: np.ndarray) -> KnownJoint:
    """Return the motion with the range of the sash nearest to the hinge."""
    low, high = bounds[:, [0, 2]]
    places = np.array([low + np.array(s.at) * (high - low) for s in sashes])
    at = motion.origin[[0, 2]]
    sash = sashes[int(np.linalg.norm(places - at, axis=1).argmin())]
    x, z = _direction(pieces, at)
    start, end = sash.arc
    rest = start + (math.degrees(math.atan2(-z, x)) - start + 180) % 360 - 180
    rest = min((start, end), key=lambda a: abs(a - rest)) if min(abs(start - rest), abs(end - rest)) < CLOSED else rest
    limits = (math.radians(start - rest), math.radians(end - rest))
    return replace(motion, axis=np.array([0.0, 1.0, 0.0]), limits=limits, range_known=True)


def _direction(pieces: tuple[Mesh, ...], at: np.ndarray) -> np.ndarray:
    """Return (x, z): the direction of the wing from its hinge, along its plane seen from above."""
    centers = np.concatenate([p.triangles.mean(1) for p in pieces])[:, [0, 2]]
    weights = np.concatenate([p.face_areas for p in pieces])
    middle = np.average(centers, axis=0, weights=weights)
    along = np.linalg.svd((centers - middle) * np.sqrt(weights)[:, None], full_matrices=False)[2][0]
    return along if along @ (middle - at) > 0 else -along
