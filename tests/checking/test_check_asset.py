"""One fault an asset: what the check says of it, and how bad it is."""

import json
import re
import struct
import sys

import mujoco
import numpy as np
import pytest
import trimesh
import typer
from assets import cabinet, pistol, slanted
from drawn import chest
from typer.testing import CliRunner

from anymesh.checking import Severity, check_asset
from anymesh.checking.command_line import NOT_IN_ORDER, check
from anymesh.errors import InputError, OptionError
from anymesh.export import write_asset

INWARD = ('axis xyz="0 -1 0"', 'axis xyz="0 1 0"')
DRAWER_VISUAL = '<mesh filename="meshes/drawer.obj" />'
FAULTS = {  # name: (changes to the chest's text, check, severity, subject, words)
    "zero axis": ([('axis xyz="0 -1 0"', 'axis xyz="0 0 0"')], "joints", "failure", "slide", r"\(0, 0, 0\).*direction"),
    "long axis": ([('axis xyz="0 -1 0"', 'axis xyz="0 -2 0"')], "joints", "warning", "slide", "length 2"),
    "inverted limits": ([('lower="0" upper="0.3"', 'lower="0.3" upper="0"')], "joints", "failure", "slide", "0.3 to 0"),
    "no limits": ([('lower="0" upper="0.3"', "")], "joints", "failure", "slide", "no limits"),
    "no range": ([('upper="0.3"', 'upper="0"')], "joints", "failure", "slide", "range"),
    "rest outside": ([('lower="0" upper="0.3"', 'lower="0.1" upper="0.3"')], "joints", "warning", "slide", "rest position"),
    "degrees": ([('upper="1.6"', 'upper="90"')], "joints", "warning", "hinge", "units"),
    "millimetres of travel": ([('upper="0.3"', 'upper="300"')], "joints", "warning", "slide", "units"),
    "unknown type": ([('type="prismatic"', 'type="sliding"')], "joints", "failure", "slide", "'sliding'"),
    "no effort": ([('effort="20" ', "")], "joints", "warning", "hinge", "effort"),
    "no velocity": ([('velocity="2"', 'velocity="0"')], "joints", "warning", "hinge", "velocity"),
    "missing mesh": ([("meshes/drawer.obj", "meshes/lost.obj")], "schema", "failure", "drawer", "lost.obj is not there"),
    "backslash": ([("meshes/drawer.obj", "meshes\\drawer.obj")], "schema", "warning", "drawer", "backslash"),
    "lost parent": ([('<child link="door"', '<child link="gate"')], "schema", "failure", "hinge", "'gate'"),
    "two parents": ([('<child link="door"', '<child link="drawer"')], "schema", "failure", "drawer", "2 joints"),
    "circle": ([('<parent link="case" />\n    <child link="door"', '<parent link="door" />\n    <child link="door"')],
               "schema", "failure", "door", "tree"),
    "same name twice": ([('name="slide"', 'name="hinge"')], "schema", "failure", "hinge", "2 joints"),
    "no number": ([('upper="1.6"', 'upper="wide"')], "schema", "failure", "hinge", "'wide'"),
    "space in a name": ([('"drawer"', '"top drawer"')], "naming", "warning", "top drawer", "top_drawer"),
    "accent": ([('"door"', '"tür"')], "naming", "warning", "tür", "tur"),
    "case alone": ([('name="hinge"', 'name="Slide"')], "naming", "warning", "Slide", "only in case"),
    "inward drawer": ([INWARD], "direction", "failure", "slide", "axis is reversed"),
    "inward door": ([('axis xyz="0 0 1"', 'axis xyz="0 0 -1"')], "direction", "failure", "hinge", "axis is reversed"),
    "jammed drawer": ([('<origin xyz="0.3 0 0.6" />', '<origin xyz="0.3 0.05 0.6" />')],
                      "collision", "warning", "drawer", "penetrates 'case'"),
    "scale of a mesh": ([(DRAWER_VISUAL, DRAWER_VISUAL.replace("/>", 'scale="20 20 20" />'))],
                        "meshes", "failure", "drawer", "units"),
    "no mass": ([('mass value="3.864"', 'mass value="0"')], "inertia", "failure", "door", "above 0"),
    "osmium": ([('mass value="3.864"', 'mass value="386400"')], "inertia", "warning", "door", "kg/m3"),
    "mass elsewhere": ([('xyz="-0.28 -0.0125 0" />\n      <mass', 'xyz="-2.8 -0.0125 0" />\n      <mass')],
                       "inertia", "failure", "door", "centre of mass"),
}  # fmt: skip


def found(report, check, severity):
    return [f for f in report.findings if f.check == check and f.severity == severity]


def test_a_good_asset_is_in_order(tmp_path):
    report = check_asset(chest(tmp_path))
    assert report.ok
    assert {f.severity for f in report.findings} == {Severity.OK}, "\n".join(report.lines())
    checks = {f.check for f in report.findings}
    assert checks == {*"schema naming meshes scale joints inertia usual collision texture direction motion".split()}
    assert [s.engine.split()[0] for s in report.sweeps] == ["mujoco"]


@pytest.mark.parametrize("name", FAULTS)
def test_each_fault_is_told_with_its_subject(name, tmp_path):
    changes, check, severity, subject, words = FAULTS[name]
    report = check_asset(chest(tmp_path, *changes), engines=())
    told = [f for f in found(report, check, severity) if f.subject == subject]
    assert any(re.search(words, f.text) for f in told), "\n".join(report.lines())
    assert report.ok == (severity != "failure")
    others = {f.check for f in report.findings if f.severity == Severity.FAILURE} - {check}
    assert not others, "\n".join(report.lines())


def edited(path, pattern, new, count=0):
    text, times = re.subn(pattern, new, path.read_text(), count=count)
    assert times
    path.write_text(text)
    return path


def test_placeholder_inertia_is_told(tmp_path):
    ball = '<inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001" />'
    report = check_asset(edited(chest(tmp_path), "<inertia .*/>", ball), engines=())
    assert any("placeholders" in f.text for f in found(report, "inertia", "warning"))


@pytest.mark.parametrize(("values", "words"), [((-1, 1, 1), "above 0"), ((1, 1, 3), "sum of the others")])
def test_impossible_tensors_fail(values, words, tmp_path):
    xx, yy, zz = values
    tensor = f'<inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}" />'
    report = check_asset(edited(chest(tmp_path), "<inertia .*/>", tensor, 1), engines=())
    assert any(words in f.text for f in found(report, "inertia", "failure"))


def test_a_moving_link_without_inertia_or_collision_fails(tmp_path):
    path = edited(chest(tmp_path), r"(?s)(<link name=\"door\">\s*)<inertial>.*?</inertial>", r"\1")
    assert [f.subject for f in found(check_asset(path, engines=()), "inertia", "warning")] == ["door"]  # made of its collision
    path = edited(chest(tmp_path), r"(?s)(<link name=\"door\">.*?)<collision>.*?</collision>", r"\1")
    assert [f.subject for f in found(check_asset(path, engines=()), "collision", "failure")] == ["door"]


def test_one_hull_for_the_case_fills_it_and_is_told(tmp_path):
    hull = '<collision><geometry><mesh filename="meshes/case.obj"/></geometry></collision></link>'
    path = edited(chest(tmp_path), r"(?s)<collision>.*?</collision>\s*</link>", hull, 1)
    (cavity, *contacts) = found(check_asset(path, engines=()), "collision", "warning")
    assert cavity.subject == "case"
    assert "one convex shape) fills 100%" in cavity.text
    assert any("penetrates 'case'" in f.text for f in contacts)


def test_a_bore_that_collision_fills_is_told(tmp_path):
    trimesh.creation.annulus(0.02, 0.1, 0.02, sections=48).export(tmp_path / "plate.obj")
    one = '<geometry><mesh filename="plate.obj"/></geometry>'
    aside = '<origin xyz="-0.07 0 0"/><geometry><box size=".06 .1 .02"/></geometry>'
    moments = 'ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"'
    for collision, count in ((one, 1), (aside, 0)):
        (tmp_path / "plate.urdf").write_text(
            f'<robot name="p"><link name="plate"><inertial><mass value="0.1"/><inertia {moments}/></inertial>'
            f"<visual>{one}</visual><collision>{collision}</collision></link></robot>"
        )
        told = found(check_asset(tmp_path / "plate.urdf", engines=()), "collision", "warning")
        assert len(told) == count
        assert all(re.search(r"a ball of 0.03\d+ m fits", f.text) for f in told)


def test_links_that_no_joint_connects_must_not_overlap(tmp_path):
    path = chest(tmp_path, ('<origin xyz="0.59 -0.005 0.26" />', '<origin xyz="0.59 -0.005 0.4" />'))
    report = check_asset(path, engines=())
    (overlap,) = found(report, "collision", "failure")
    assert "'drawer'" in overlap.text
    (motion,) = found(report, "collision", "warning")  # a failure of our own assets
    assert re.search(r"contacts move 'slide' by [\d.]+ mm \('drawer' and 'door' touch\)", motion.text)


def test_meshes_that_are_broken_empty_or_open(tmp_path):
    path = chest(tmp_path)
    obj = tmp_path / "meshes" / "door.obj"
    whole = obj.read_text()
    obj.write_text(re.sub(r"(?m)^f \d+/", "f 999/", whole))
    assert found(check_asset(path, engines=()), "meshes", "failure")[0].subject == "door"
    lines = whole.splitlines()
    obj.write_text("\n".join([*lines[:-1], *[line for line in lines if line.startswith("f")][:1]]))  # a face missing
    assert "closed" in found(check_asset(path, engines=()), "meshes", "warning")[0].text
    obj.write_text(whole + "f 1/1 1/1 2/2\n" * 20)
    assert "no area" in found(check_asset(path, engines=()), "meshes", "warning")[0].text


def test_scale_in_millimetres_fails(tmp_path):
    path = chest(tmp_path)
    for name in ("case", "drawer", "door"):
        edited(path, f'filename="meshes/{name}.obj"', f'filename="meshes/{name}.obj" scale="1000 1000 1000"')
    assert "metres" in found(check_asset(path, engines=()), "scale", "failure")[0].text


def test_textures_that_are_missing_or_broken_are_told(tmp_path):
    path = chest(tmp_path)
    picture = tmp_path / "meshes" / "checker.png"
    data = picture.read_bytes()
    picture.write_bytes(data[:20])
    assert "checker.png" in found(check_asset(path, engines=()), "texture", "warning")[0].text
    picture.unlink()
    assert "missing" in found(check_asset(path, engines=()), "texture", "warning")[0].text
    picture.write_bytes(data)
    path = chest(tmp_path, ("</robot>", '<material name="m"><texture filename="meshes/gone.png"/></material></robot>'))
    assert "gone.png is not there" in found(check_asset(path, engines=()), "texture", "failure")[0].text


def test_a_joint_that_cannot_move_fails_in_the_engine(tmp_path):
    report = check_asset(chest(tmp_path, ('effort="50"', 'effort="0.0001"')))
    told = found(report, "motion", "failure")
    assert {f.subject for f in told} == {"slide"}
    assert any("it does not move" in f.text for f in told)


def as_mjcf(path):
    spec = mujoco.MjSpec.from_file(str(path))
    spec.compiler.fusestatic = spec.compiler.discardvisual = False
    spec.compile()
    target = path.parent / "chest.xml"
    target.write_text(spec.to_xml())
    path.unlink()
    return target


def test_mjcf_is_checked_as_urdf_is(tmp_path):
    path = as_mjcf(chest(tmp_path))
    assert check_asset(tmp_path).ok
    bad = check_asset(edited(path, 'axis="0 -1 0"', 'axis="0 1 0"'))
    assert [f.subject for f in found(bad, "direction", "failure")] == ["slide"]
    edited(path, "</mujoco>", "<contact><exclude body1='case' body2='drawer'/></contact><junk/></mujoco>")
    assert "junk" in found(check_asset(path), "schema", "failure")[0].text


def test_our_own_output_is_in_order_and_its_asset_json_is_read(tmp_path):
    write_asset(cabinet(), tmp_path)
    report = check_asset(tmp_path)
    assert report.ok, "\n".join(report.lines())
    record = json.loads((tmp_path / "asset.json").read_text())
    for key, value, words in (("limits", [0.0, 0.5], "limits of 'hinge'"), ("axis", "up", "axis")):
        record["joints"][0][key] = value
        (tmp_path / "asset.json").write_text(json.dumps(record))
        assert words in found(check_asset(tmp_path, engines=()), "schema", "failure")[0].text
    for name in ("stray", "a&read"):  # the latter by MuJoCo alone
        (tmp_path / "meshes" / f"{name}.png").write_bytes(b"")
    (tmp_path / "mjcf.xml").write_text('<texture file="meshes/a&amp;read.png"/>', encoding="utf-8")
    assert [f.subject for f in found(check_asset(tmp_path, engines=()), "texture", "warning")] == ["stray.png"]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda record: record["joints"][0].update(parent="gate"), "its parents .*gate"),
        (lambda record: record["joints"][0].update(parent=record["joints"][0]["child"]), "its parents"),
        (lambda record: record["joints"][0].update(axis=[float("nan"), 0.0, 0.0]), "NaN"),
        (lambda record: record["joints"].append({**record["joints"][0], "name": "again"}), "its parents"),
        (lambda record: record["joints"].pop(), "its parents"),
        (lambda record: record["files"].update(mjcf="lost.xml"), r"lost\.xml is not there"),
    ],
)
def test_an_asset_json_whose_tree_or_files_are_incomplete_fails(tmp_path, change, words):
    write_asset(cabinet(), tmp_path)
    record = json.loads((tmp_path / "asset.json").read_text())
    change(record)
    (tmp_path / "asset.json").write_text(json.dumps(record))
    assert any(re.search(words, f.text) for f in found(check_asset(tmp_path, engines=()), "schema", "failure"))


def test_a_description_that_is_cut_off_fails_although_another_is_whole(tmp_path):
    write_asset(cabinet(), tmp_path)
    (tmp_path / "cabinet.xml").write_text("<mujoco>")
    assert "truncated" in found(check_asset(tmp_path, engines=()), "schema", "failure")[0].text


def test_an_engine_that_is_not_installed_is_a_warning_and_one_that_is_unknown_an_error(tmp_path, monkeypatch):
    path = chest(tmp_path)
    with pytest.raises(OptionError, match="mujoco, pybullet"):
        check_asset(path, engines=("unity",))
    monkeypatch.setitem(sys.modules, "mujoco", None)
    report = check_asset(path)
    assert report.ok
    assert "mujoco is missing" in found(report, "motion", "warning")[0].text


def test_the_report_as_json_and_as_lines(tmp_path):
    report = check_asset(chest(tmp_path, INWARD))
    record = json.loads(json.dumps(report.as_json()))
    assert (record["ok"], record["failures"]) == (False, 1)
    assert {"check", "severity", "subject", "text"} == set(record["findings"][0])
    assert record["sweeps"][0]["joints"][0]["name"] == "slide"
    lines = report.lines()
    assert lines[0].startswith("failure direction: slide:")
    assert lines[-1].endswith("failed, 1 failures, 0 warnings")
    assert report == check_asset(tmp_path / "chest.urdf")


def test_random_poses_of_the_hull_question():
    """A box lies in itself, and nothing outside it does."""
    from anymesh.checking.bodies import _in_hull

    rng = np.random.default_rng(0)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 2) for z in (0, 3)], float)
    points = rng.uniform(-1, 4, (500, 3))
    assert (_in_hull(corners, points) == ((points >= 0) & (points <= (1, 2, 3))).all(1)).all()


def test_what_is_checked_in_a_folder(tmp_path):
    with pytest.raises(InputError, match="no URDF and no MJCF"):
        check_asset(tmp_path)
    path = chest(tmp_path)
    assert check_asset(tmp_path, engines=()).ok
    (tmp_path / "other.urdf").write_text(path.read_text())
    with pytest.raises(InputError, match=r"chest\.urdf, other\.urdf"):
        check_asset(tmp_path)
    with pytest.raises(InputError, match="not there"):
        check_asset(tmp_path / "none")
    (tmp_path / "a.xml").write_text("<svg/>")
    with pytest.raises(InputError, match="neither URDF nor MJCF"):
        check_asset(tmp_path / "a.xml")


def test_the_mjcf_of_our_own_output_is_in_order_too(tmp_path):
    write_asset(slanted(), tmp_path)  # with a fixed joint
    report = check_asset(tmp_path / "slanted.xml")
    assert report.ok, "\n".join(report.lines())


@pytest.mark.parametrize("file", ["cabinet.urdf", "cabinet.xml", "."])
def test_a_relative_path_is_as_good_as_an_absolute_one(file, tmp_path, monkeypatch):
    """An MJCF names its pictures relative to its own folder."""
    (tmp_path / "out").mkdir()
    write_asset(cabinet(), tmp_path / "out")
    monkeypatch.chdir(tmp_path)
    report = check_asset(f"out/{file}", engines=())
    assert report.ok, "\n".join(report.lines())


def test_a_file_that_is_no_xml_is_a_finding(tmp_path):
    (tmp_path / "a.urdf").write_bytes(struct.pack("<4I", *range(4)))
    report = check_asset(tmp_path)
    assert not report.ok
    assert report.findings[0].check == "schema"


app = typer.Typer()
app.command()(check)


def run(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments])


def test_a_good_asset_is_told_in_lines_with_exit_code_0(tmp_path):
    done = run(chest(tmp_path))
    assert done.exit_code == 0
    assert done.output.splitlines()[-1].endswith("passed, 0 failures, 0 warnings")


def test_a_bad_one_ends_with_its_own_exit_code_and_json_alone(tmp_path):
    path = chest(tmp_path, ('axis xyz="0 -1 0"', 'axis xyz="0 0 0"'))
    done = run(path, "--json", "--engine", "mujoco")
    assert done.exit_code == NOT_IN_ORDER == 8
    record = json.loads(done.output)
    assert not record["ok"]
    assert [f["subject"] for f in record["findings"] if f["severity"] == "failure"] == ["slide"]


def test_quiet_says_nothing_and_names_cannot_steer_the_terminal(tmp_path):
    path = chest(tmp_path, ('"drawer"', '"dra\u0085\u202ewer"'))
    assert run(path, "--quiet").output == ""
    told = run(path).output
    assert "dra??wer" in told
    assert "\u202e" not in told


BALL = '<inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001" />'
BOTH_FIND = {  # name: (pattern, replacement, our check, its check)
    "zero axis": ('axis xyz="0 -1 0"', 'axis xyz="0 0 0"', "joints", "joints.axis"),
    "inverted limits": ('lower="0" upper="0.3"', 'lower="0.3" upper="0"', "joints", "joints.limits"),
    "missing mesh": ("meshes/drawer.obj", "meshes/lost.obj", "schema", "files.meshes"),
    "inward drawer": ('axis xyz="0 -1 0"', 'axis xyz="0 1 0"', "direction", "kinematics.pass_through"),
    "placeholder inertia": (r"<inertia [^>]*/>", BALL, "inertia", "inertia.geometry"),
}


def ours(path):
    return {f.check for f in check_asset(path, engines=()).findings if f.severity != Severity.OK}


def theirs(path):
    simcheck = pytest.importorskip("simcheck")
    return {f.check for f in simcheck.check(str(path), static_only=True).findings if f.severity in ("error", "warning")}


def test_both_find_a_good_asset_in_order(tmp_path):
    path = chest(tmp_path)
    assert (ours(path), theirs(path)) == (set(), set())


@pytest.mark.parametrize("name", BOTH_FIND)
def test_both_find_the_fault_and_nothing_else(name, tmp_path):
    pattern, new, check, other = BOTH_FIND[name]
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
    found = pytest.importorskip("simcheck").check(str(path), engines=("mujoco",))
    assert not found.errors, found.errors


@pytest.mark.parametrize(
    ("axis", "limits", "leaves"),
    [((0, 1, 0), (0.0, 0.007), ""), ((0, 1, 0), (-0.02, 0.0), "negative"), ((0, -1, 0), (0.0, 0.03), "positive")],
)
def test_a_trigger_that_comes_out_instead_of_going_in_is_told(tmp_path, axis, limits, leaves):
    write_asset(pistol(axis, limits), tmp_path)
    told = [f for f in check_asset(tmp_path, engines=()).findings if f.check == "direction"]
    if not leaves:
        assert [f.severity for f in told] == [Severity.OK]
    else:
        assert [(f.severity, f.subject) for f in told] == [(Severity.WARNING, "pull")]
        assert f"{leaves} motion takes 'trigger' out of its guide" in told[0].text
