"""The same assets judged by simcheck, a package of others: both find the same in order, and the same faults."""

import re

import pytest
from assets import cabinet
from drawn import chest

from anymesh.checking import Severity, check_asset
from anymesh.export import write_asset

simcheck = pytest.importorskip("simcheck")
BALL = '<inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001" />'
FAULTS = {  # name: (pattern, replacement, our check, its check)
    "zero axis": ('axis xyz="0 -1 0"', 'axis xyz="0 0 0"', "joints", "joints.axis"),
    "inverted limits": ('lower="0" upper="0.3"', 'lower="0.3" upper="0"', "joints", "joints.limits"),
    "missing mesh": ("meshes/drawer.obj", "meshes/lost.obj", "schema", "files.meshes"),
    "inward drawer": ('axis xyz="0 -1 0"', 'axis xyz="0 1 0"', "direction", "kinematics.pass_through"),
    "placeholder inertia": (r"<inertia [^>]*/>", BALL, "inertia", "inertia.geometry"),
}


def ours(path):
    return {f.check for f in check_asset(path, engines=()).findings if f.severity != Severity.OK}


def theirs(path):
    return {f.check for f in simcheck.check(str(path), static_only=True).findings if f.severity in ("error", "warning")}


def test_both_find_a_good_asset_in_order(tmp_path):
    path = chest(tmp_path)
    assert (ours(path), theirs(path)) == (set(), set())


@pytest.mark.parametrize("name", FAULTS)
def test_both_find_the_fault_and_nothing_else(name, tmp_path):
    pattern, new, check, other = FAULTS[name]
    path = chest(tmp_path)
    text, count = re.subn(pattern, new, path.read_text())
    assert count
    path.write_text(text)
    assert (ours(path), theirs(path)) == ({check}, {other})


@pytest.mark.slow
def test_both_find_our_own_output_in_order_in_mujoco_too(tmp_path):
    write_asset(cabinet(), tmp_path)
    path = tmp_path / "cabinet.urdf"
    assert check_asset(path).ok
    found = simcheck.check(str(path), engines=("mujoco",))
    assert not found.errors, found.errors
