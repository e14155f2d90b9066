"""Sweet Home 3D's format, written here; the program's own models where it is installed."""

import io
import tarfile
import zipfile
from pathlib import Path

import numpy as np
import pytest
from assets import box
from small_sets import loaded, part_box

from anymesh.errors import InputError, MissingExtraError
from anymesh.evaluation.datasets.sweethome3d import INSTALLED, SweetHome3D
from anymesh.types import JointType

RESOURCES = "com/eteks/sweethome3d/io/resources/"
CATALOG = "com/eteks/sweethome3d/io/DefaultFurnitureCatalog.properties"
CABINET = {
    "Body": ((-50, 0, -30), (50, 100, 30)),
    "sweethome3d_hinge_1_1": ((-50, 10, 30), (-49, 15, 31)),
    "sweethome3d_hinge_1_2_steel": ((-50, 80, 30), (-49, 85, 31)),
    "sweethome3d_opening_on_hinge_1_door": ((-50, 10, 30), (50, 60, 31)),
    "sweethome3d_window_pane_on_hinge_1": ((-10, 20, 31), (10, 40, 32)),
    "sweethome3d_window_pane": ((-10, 70, 31), (10, 90, 32)),
    "sweethome3d_opening_on_rail_2_drawer": ((-45, 65, -20), (45, 95, 31)),
    "sweethome3d_unique_rail": ((-1, 70, -25), (1, 72, 25)),
}
WINDOW = {
    "frame": ((0, 0, 0), (2, 2, 0.2)),
    "sweethome3d_hinge_1": ((0, 0, 0.2), (0.02, 2, 0.22)),
    "sweethome3d_opening_on_hinge_1": ((0, 0, 0.2), (1, 2, 0.25)),
    "sweethome3d_hinge_2": ((1.98, 0, 0.2), (2, 2, 0.22)),
    "sweethome3d_opening_on_hinge_2": ((1, 0, 0.2), (2, 2, 0.25)),
}
ENTRIES = f"""
name#1=Cabinet
model#1=/{RESOURCES}cabinet.obj
width#1=100
depth#1=60
height#1=100
name#2=Table
model#2=/{RESOURCES}table.obj
width#2=1
depth#2=1
height#2=1
name#3=Double window
model#3=/{RESOURCES}window.obj
width#3=200
depth#3=25
height#3=200
doorOrWindowSashXAxis#3=1 199
doorOrWindowSashYAxis#3=21 21
doorOrWindowSashStartAngle#3=0 180
doorOrWindowSashEndAngle#3=-90 270
"""


def obj(groups) -> str:
    lines, count = ["# a model"], 0
    for name, (low, high) in groups.items():
        vertices, faces = box(low, high)
        lines += [f"g {name}", *(f"v {x} {y} {z}" for x, y, z in vertices), "usemtl white"]
        lines += [f"f {a} {b} {c}" for a, b, c in faces + 1 + count]
        count += len(vertices)
    return "\n".join(lines)


@pytest.fixture
def jar(tmp_path: Path) -> Path:
    path = tmp_path / "sweethome3d.jar"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(CATALOG, "# caf\u00e9\n".encode("latin-1") + ENTRIES.encode())
        archive.writestr(f"{RESOURCES}cabinet.obj", obj(CABINET))
        archive.writestr(f"{RESOURCES}table.obj", obj({"top": ((0, 0, 0), (1, 1, 1))}))
        archive.writestr(f"{RESOURCES}window.obj", obj(WINDOW))
    return path


def deb(jar: Path) -> Path:
    """The jar in a Debian package file."""
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w:xz") as tar:
        tar.add(jar, "./usr/share/sweethome3d/sweethome3d.jar")
    package = b"!<arch>\n"
    for name, content in (("debian-binary", b"2.0\n"), ("control.tar.xz", b"odd"), ("data.tar.xz", data.getvalue())):
        package += (
            f"{name:<16}{0:<12}{0:<6}{0:<6}{100644:<8}{len(content):<10}`\n".encode() + content + b"\n" * (len(content) % 2)
        )
    path = jar.with_name("sweethome3d.deb")
    path.write_bytes(package)
    return path


def test_parts_and_joints(jar: Path, tmp_path: Path) -> None:
    truth = SweetHome3D(jar).truth("cabinet", tmp_path / "out")
    mesh = loaded(truth)
    assert len(mesh.faces) == 12 * 5  # without the markers
    assert b"sweethome3d" not in truth.mesh.read_bytes()
    assert truth.category == "cabinet"
    assert np.allclose(mesh.extents, (1, 1, 0.62))  # as high as the catalogue says
    hinge, rail = truth.joints
    assert (hinge.child, hinge.type, hinge.parent) == ("hinge_1", JointType.REVOLUTE, "base")
    assert np.allclose(np.abs(hinge.axis), (0, 1, 0))  # along the markers together, not along one
    assert np.allclose(hinge.origin[[0, 2]], (-0.495, 0.305))
    assert np.allclose(part_box(truth, "hinge_1"), [[-0.5, 0.1, 0.3], [0.5, 0.6, 0.32]])
    assert rail.type is JointType.PRISMATIC
    assert np.allclose(np.abs(rail.axis), (0, 0, 1))
    assert all(j.limits is None and not j.range_known for j in truth.joints)


def test_wings_open_as_the_catalogue_draws_them(jar: Path, tmp_path: Path) -> None:
    """Both to the front, which is +z: the left one about -y, the right one about +y."""
    left, right = SweetHome3D(jar).truth("window", tmp_path / "out").joints
    assert np.allclose(left.axis, (0, -1, 0))
    assert np.allclose(right.axis, (0, 1, 0))
    for joint in (left, right):
        assert joint.range_known
        assert np.allclose(joint.limits, (0, np.pi / 2))


def test_the_jar_the_package_and_their_folder_are_one(jar: Path, tmp_path: Path) -> None:
    for source in (jar, deb(jar), tmp_path):
        assert SweetHome3D(source).objects() == ["cabinet", "window"]


def test_other_files(jar: Path, tmp_path: Path) -> None:
    with pytest.raises(MissingExtraError, match="apt-get install sweethome3d"):
        SweetHome3D(tmp_path / "none.jar").objects()
    (tmp_path / "x.jar").write_text("no jar")
    (tmp_path / "x.deb").write_text("no package")
    for name in ("x.jar", "x.deb"):
        with pytest.raises(InputError, match=name):
            SweetHome3D(tmp_path / name).objects()
    with pytest.raises(InputError, match="cabinet"):
        SweetHome3D(jar).truth("bed", tmp_path / "out")


@pytest.mark.skipif(not INSTALLED.is_file(), reason="Sweet Home 3D is not installed")
def test_installed(tmp_path: Path) -> None:
    data = SweetHome3D()
    truths = [data.truth(name, tmp_path) for name in data.objects()]
    assert len(truths) == 32
    assert sum(len(t.joints) for t in truths) == 54
    for truth in truths:
        loaded(truth)
