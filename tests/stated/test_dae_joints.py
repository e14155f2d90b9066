"""Test the joints that animations of COLLADA files give."""

import numpy as np
import pytest
from assets import CUBE, CUBE_FACES
from test_animated import PIVOT, assert_hinge, only

from anymesh.loading import load_mesh
from anymesh.types import JointType


def words(values) -> str:
    return " ".join(f"{v:.9g}" for v in np.ravel(values))


def geometry(name: str, low, high) -> str:
    points = np.array(low) + CUBE * (np.array(high) - np.array(low))
    return f"""<geometry id="{name}-mesh"><mesh>
      <source id="{name}-p"><float_array id="{name}-a" count="24">{words(points)}</float_array><technique_common>
        <accessor source="#{name}-a" count="8" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
        </technique_common></source>
      <vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/></vertices>
      <triangles count="12"><input semantic="VERTEX" source="#{name}-v" offset="0"/><p>{words(CUBE_FACES)}</p></triangles>
    </mesh></geometry>"""


def animation(target: str, times, values, kind: str = "LINEAR", name: str = "Open", number: int = 0) -> str:
    key, count = f"a{number}", len(times)
    return f"""<animation id="{name}">
      <source id="{key}-i"><float_array count="{count}">{words(times)}</float_array></source>
      <source id="{key}-o"><float_array count="{np.size(values)}">{words(values)}</float_array></source>
      <source id="{key}-k"><Name_array count="{count}">{" ".join([kind] * count)}</Name_array></source>
      <sampler id="{key}"><input semantic="INPUT" source="#{key}-i"/><input semantic="OUTPUT" source="#{key}-o"/>
        <input semantic="INTERPOLATION" source="#{key}-k"/></sampler>
      <channel source="#{key}" target="{target}"/></animation>"""


def read(folder, animations: str, transforms: str, clips: str = ""):
    """Return the mesh and the warnings of a case with a door that has these transforms and animations."""
    case, door = geometry("case", (-0.25, 0, -0.2), (0.25, 0.7, 0.2)), geometry("door", (-0.5, 0, 0), (0, 0.7, 0.02))
    text = f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
      <asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset><library_geometries>{case}{door}</library_geometries>
      <library_animations>{animations}</library_animations>{clips}<library_visual_scenes><visual_scene id="s">
      <node id="case" name="Case"><instance_geometry url="#case-mesh"/></node>
      <node id="door" name="Door">{transforms}<instance_geometry url="#door-mesh"/></node>
      </visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
    (folder / "scene.dae").write_text(text)
    loaded = load_mesh(folder / "scene.dae")
    return loaded.mesh, loaded.warnings


PLACED = f'<translate sid="location">{words(PIVOT)}</translate>'
TURNED = PLACED + "".join(
    f'<rotate sid="rotation{n}">{words(a)} 0</rotate>' for n, a in zip("ZYX", np.eye(3)[::-1], strict=True)
)


def matrix(degrees: float) -> np.ndarray:
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array([[c, 0, s, PIVOT[0]], [0, 1, 0, PIVOT[1]], [-s, 0, c, PIVOT[2]], [0, 0, 0, 1]])


def test_an_angle(tmp_path):
    mesh, warnings = read(tmp_path, animation("door/rotationY.ANGLE", [0, 1, 2], [0, 50, 95], "BEZIER"), TURNED)
    joint = only(mesh)
    assert_hinge(joint, (0, 1, 0), PIVOT, (0, 95))
    assert (joint.name, joint.reason) == ("Door", 'from the animation "Open"')
    assert {node.name: node.joint for node in mesh.nodes} == {"Case": -1, "Door": 0}
    assert not warnings


def test_a_whole_turn_between_two_keys(tmp_path):
    joint = only(read(tmp_path, animation("door/rotationY.ANGLE", [0, 1], [1080, 1440]), TURNED)[0])
    assert joint.type is JointType.CONTINUOUS
    np.testing.assert_allclose(joint.axis, (0, 1, 0), atol=1e-6)
    np.testing.assert_allclose(joint.origin, PIVOT, atol=1e-6)


def test_a_pivot_of_several_translations(tmp_path):
    names, places = ("translate", "rotatePivot", "back"), ((0.25, 0, 0), (0, 0, 0.2), (0, 0, -0.2))
    first, pivot, back = (f'<translate sid="{n}">{words(p)}</translate>' for n, p in zip(names, places, strict=True))
    turned = f'{first}{pivot}<rotate sid="rotateY">0 1 0 0</rotate>{back}<translate sid="shape">0 0 0.2</translate>'
    assert_hinge(only(read(tmp_path, animation("door/rotateY.ANGLE", [0, 1], [0, 90]), turned)[0]), (0, 1, 0), PIVOT, (0, 90))


def test_matrices(tmp_path):
    keys = [matrix(a) for a in (0, -40, -80)]
    made = animation("door/transform", [0, 1, 2], keys)
    at_rest = f'<matrix sid="transform">{words(matrix(0))}</matrix>'
    assert_hinge(only(read(tmp_path, made, at_rest)[0]), (0, -1, 0), PIVOT, (0, 80))
    shift = animation("door/transform(3)(2)", [0, 1], [PIVOT[2], PIVOT[2] + 0.3])
    joint = only(read(tmp_path, shift, at_rest)[0])
    np.testing.assert_allclose(joint.axis, (0, 0, 1), atol=1e-6)
    assert joint.limits == pytest.approx((0, 0.3))


MOVES = {".X": [0.25, 0.6], "": [PIVOT, (0.6, 0, 0.2)], "(0)": [0.25, 0.6]}


@pytest.mark.parametrize("member", MOVES)
def test_a_translation(tmp_path, member):
    joint = only(read(tmp_path, animation(f"door/location{member}", [0, 1], MOVES[member]), PLACED)[0])
    assert joint.type is JointType.PRISMATIC
    np.testing.assert_allclose(joint.axis, (1, 0, 0), atol=1e-9)
    assert joint.limits == pytest.approx((0, 0.35))


def test_channels_of_several_transforms_are_one_motion(tmp_path):
    angles = np.linspace(0, 90, 5)
    lever = [np.sin(np.deg2rad(angles)) * -0.2 + 0.25, np.cos(np.deg2rad(angles)) * -0.2 + 0.4]  # the hinge is .2 in front
    made = animation("door/rotationY.ANGLE", range(5), angles)
    made += animation("door/location.X", range(5), lever[0], number=1)
    made += animation("door/location.Z", range(5), lever[1], number=2)
    assert_hinge(only(read(tmp_path, made, TURNED)[0]), (0, 1, 0), (0.25, 0, 0.4), (0, 90))


def test_clips_name_parts_of_the_time(tmp_path):
    clips = """<library_animation_clips><animation_clip name="Idle" start="0" end="1"/>
      <animation_clip name="Open wide" start="1" end="3"/></library_animation_clips>"""
    made = animation("door/rotationY.ANGLE", [0, 1, 3], [0, 0, 120], name="all")
    joint = only(read(tmp_path, made, TURNED, clips)[0])
    assert_hinge(joint, (0, 1, 0), PIVOT, (0, 120))
    assert joint.reason == 'from the animation "Open wide"'


def test_bones_are_named(tmp_path):
    bone = '<node id="arm" type="JOINT"><rotate sid="r">0 1 0 0</rotate></node>'
    mesh, warnings = read(tmp_path, animation("arm/r.ANGLE", [0, 1], [0, 90], name="Wave"), PLACED + bone)
    assert mesh.joints == ()
    assert warnings == ('the animation "Wave" bends a mesh by bones; it is read at rest',)


def test_channels_that_move_no_node_are_counted(tmp_path):
    made = animation("door/rotationY.ANGLE", [0, 1], [0, 90]) + animation("steel/diffuse.R", [0, 1], [0, 1], number=1)
    made += animation("door/rotationX.ANGLE", [0, 1], [0, 1, 2], number=2)
    mesh, warnings = read(tmp_path, made, TURNED)
    assert_hinge(only(mesh), (0, 1, 0), PIVOT, (0, 90))
    assert [w for w in warnings if w.startswith("2 channels")]
