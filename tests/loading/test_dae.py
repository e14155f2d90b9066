"""Test that what a COLLADA file holds is read, or named in one warning: each row of the table in docs/formats.md."""

# ruff: noqa: E501
from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from mesh_files import DAE_INSTANCE, POINTS, assert_refused, dae, put, write_png

from anymesh.formats.dae import document as dae_reader
from anymesh.loading import LoadedMesh, load_mesh
from anymesh.types.mesh import to_linear

TABLE = Path(__file__).parents[2] / "docs" / "formats.md"
PICTURE = '<texture texture="p" texcoord="c"/>'
INSTANCE = '<instance_node url="#l{}"/>'
Check = Callable[[LoadedMesh], object]


def swapped(*pairs: tuple[str, str], **how) -> bytes:
    """Return the box with texts replaced, each of which is there."""
    data = dae(**how).decode()
    for old, new in pairs:
        assert old in data, old
        data = data.replace(old, new, 1)
    return data.encode()


def added(geometry: str, node: str) -> bytes:
    """Return the box with more in its library of geometries and in its scene."""
    return swapped(("</library_geometries>", f"{geometry}</library_geometries>"), ("</visual_scene>", f"{node}</visual_scene>"))


def faces(inner: str) -> bytes:
    """Return the corners of the box with other faces."""
    data = dae().decode()
    return re.sub(r"<triangles.*</triangles>", inner.replace("INPUT", VERTEX), data, flags=re.S).encode()


VERTEX = '<input semantic="VERTEX" source="#v" offset="0"/>'
SQUARE = "1 3 7 5"  # corners of the side at the upper x, in order
HOLED = """<geometry id="f" name="frame"><mesh><source id="fp"><float_array id="fa" count="24">
0 0 0 1 0 0 1 1 0 0 1 0 .25 .25 0 .75 .25 0 .75 .75 0 .25 .75 0</float_array><technique_common>
<accessor source="#fa" count="8" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor></technique_common></source>
<vertices id="fv"><input semantic="POSITION" source="#fp"/></vertices><polygons count="1">
<input semantic="VERTEX" source="#fv" offset="0"/><ph><p>0 1 2 3</p><h>4 5 6 7</h></ph></polygons></mesh></geometry>"""
FRAME = '<node id="fn" name="Frame"><instance_geometry url="#f"/></node>'


def source(name: str, values: str, width: int) -> str:
    params = "".join(f'<param name="{k}" type="float"/>' for k in "STPQ"[:width])
    return (
        f'<source id="{name}"><float_array id="{name}a">{values}</float_array><technique_common>'
        f'<accessor source="#{name}a" count="{len(values.split()) // width}" stride="{width}">{params}</accessor>'
        "</technique_common></source>"
    )


def with_corners(inputs: str, *sources: str, **how) -> bytes:
    """Return the box with further inputs, which use the index of the vertex."""
    return swapped((VERTEX, VERTEX + inputs), ("<vertices", "".join(sources) + "<vertices"), **how)


def skinned(joint: str = "", pose: str = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", skeleton: str = "<skeleton>#j</skeleton>") -> bytes:
    """Return the box as a skin of one joint below a node that is moved; its own node is moved too, which must not count."""
    matrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
    skin = f"""<library_controllers><controller id="c"><skin source="#g"><bind_shape_matrix>{matrix}</bind_shape_matrix>
<source id="cj"><Name_array id="cja" count="1">b</Name_array></source>{source("cb", pose, 1)}{source("cw", "1", 1)}
<joints><input semantic="JOINT" source="#cj"/><input semantic="INV_BIND_MATRIX" source="#cb"/></joints>
<vertex_weights count="8"><input semantic="JOINT" source="#cj" offset="0"/><input semantic="WEIGHT" source="#cw" offset="1"/>
<vcount>1 1 1 1 1 1 1 1</vcount><v>{"0 0 " * 8}</v></vertex_weights></skin></controller></library_controllers>"""
    nodes = (
        f'<node><scale>2 2 2</scale><node id="j" sid="b" type="JOINT">{joint}</node></node><node id="n" name="Lid">'
        f'<translate>50 0 0</translate><instance_controller url="#c">{skeleton}</instance_controller></node>'
    )
    return swapped(("<library_visual_scenes>", skin + "<library_visual_scenes>"), nodes=nodes)


def shape(loaded: LoadedMesh) -> tuple[int, list[float]]:
    return len(loaded.mesh.faces), np.round(loaded.mesh.extents, 6).tolist()


def names(loaded: LoadedMesh) -> list[str]:
    return [node.name for node in loaded.mesh.nodes]


def warned(text: str) -> Check:
    return lambda loaded: any(text in w for w in loaded.warnings) and len(loaded.mesh.faces) == 12


def area(loaded: LoadedMesh, which: str) -> float:
    mesh = loaded.mesh
    return float(mesh.face_areas[mesh.face_node == names(loaded).index(which)].sum())


def look(inner: str) -> bytes:
    return swapped(("</lambert>", f"{inner}</lambert>"))


def opacity(loaded: LoadedMesh) -> float:
    return loaded.mesh.materials[0].opacity


UV = 'semantic="TEXCOORD" offset="0"'
TWO_SETS = with_corners(
    f'<input {UV} source="#t0" set="0"/><input {UV} source="#t1" set="1"/>',
    source("t0", "0 0 " * 8, 2),
    source("t1", "1 1 " * 8, 2),
    look=PICTURE,
).replace(
    b'target="#m"/>',
    b'target="#m"><bind_vertex_input semantic="c" input_semantic="TEXCOORD" input_set="1"/></instance_material>',
)
ROWS: dict[str, tuple[bytes, Check]] = {
    "`triangles`, `polylist`, `trifans`, `tristrips`": (
        faces(
            f"<triangles>INPUT<p>0 1 3</p></triangles><polylist>INPUT<vcount>4</vcount><p>{SQUARE}</p></polylist>"
            f"<trifans>INPUT<p>{SQUARE}</p></trifans><tristrips>INPUT<p>0 1 2 3 3 4 5</p></tristrips>"
        ),
        lambda found: len(found.mesh.faces) == 1 + 2 + 2 + 3 and not found.warnings,
    ),
    "`polygons` with `ph` and `h`": (added(HOLED, FRAME), lambda found: area(found, "Frame") == pytest.approx(0.75)),
    "`lines`, `linestrips`, `spline`, `brep`": (
        swapped(("</mesh>", f"<lines>{VERTEX}<p>0 1</p></lines></mesh>")),
        warned("1 sets of lines left out"),
    ),
    "`convex_mesh`": (
        swapped(
            ("</library_geometries>", '<geometry id="h"><convex_mesh convex_hull_of="#g"/></geometry></library_geometries>'),
            ("</visual_scene>", '<node name="h"><instance_geometry url="#h"/></node></visual_scene>'),
        ),
        lambda found: len(found.mesh.faces) == 24,
    ),
    "`source`, `accessor`": (
        with_corners(f'<input {UV} source="#t"/>', source("t", "7 0 .5 " * 8, 3).replace('name="S"', "")),
        lambda found: (found.mesh.corner_uv == [0, 0.5]).all(),
    ),
    "`NORMAL`, `COLOR`": (
        with_corners('<input semantic="COLOR" source="#k" offset="0"/>', source("k", "1 0 0 0 " * 8, 4)),
        lambda found: found.mesh.corner_color is not None and (found.mesh.corner_color == [255, 0, 0, 255]).all(),
    ),
    "`TEXCOORD`, `bind_vertex_input`": (TWO_SETS, lambda found: (found.mesh.corner_uv == 1).all()),
    "indices and numbers that are not valid": (
        swapped(("<p>0 1 3", "<p>0 1 9")),
        lambda found: len(found.mesh.faces) == 11 and "1 triangles with a vertex" in found.warnings[0],
    ),
    "`node`: `matrix`, `translate`, `rotate`, `scale`, `lookat`, `skew`": (
        dae(
            nodes=f'<node name="n"><translate>0 0 5</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>{DAE_INSTANCE}</node>'
        ),
        lambda found: shape(found) == (12, [2, 2, 3]) and found.mesh.bounds[0] == pytest.approx([-4, 2, 8]),
    ),
    "`instance_node`, `library_nodes`": (
        swapped(
            (
                "<library_visual_scenes>",
                f'<library_nodes><node id="l" name="Door">{DAE_INSTANCE}</node></library_nodes><library_visual_scenes>',
            ),
            nodes='<node name="instance_0"><instance_node url="#l"/></node><node name="instance_1"><instance_node url="#l"/></node>',
        ),
        lambda found: names(found) == ["Door", "Door_1"],
    ),
    "`visual_scene`, several": (
        swapped(
            ("</visual_scene>", f'</visual_scene><visual_scene id="t"><node name="other">{DAE_INSTANCE}</node></visual_scene>')
        ),
        warned("has 2 scenes"),
    ),
    "no `scene`": (swapped(('<scene><instance_visual_scene url="#s"/></scene>', "")), warned("which scene is shown")),
    "geometries that are not placed": (added(HOLED, ""), warned("1 geometries are not placed")),
    "`visibility` (extra of Maya and 3ds Max)": (
        added(
            "",
            f'<node name="gone">{DAE_INSTANCE}<extra><technique profile="FCOLLADA"><visibility>0</visibility></technique></extra></node>',
        ),
        warned("1 hidden nodes left out"),
    ),
    "`asset` of the file: `unit`, `up_axis`": (
        dae("Z_UP", '<unit meter="0.01"/>'),
        lambda found: (found.format_up, found.unit_in_metres) == ("z", 0.01),
    ),
    "`asset` within an element": (
        swapped(
            (
                '<geometry id="g" name="g">',
                '<geometry id="g" name="g"><asset><unit meter=".001"/><up_axis>Y_UP</up_axis></asset>',
            )
        ),
        lambda found: shape(found) == (12, [0.001, 0.003, 0.002]) and "of their own" in found.warnings[0],
    ),
    "`skin`": (
        skinned("<translate>0 0 1</translate>"),
        lambda found: names(found) == ["Lid"] and found.mesh.bounds[0] == pytest.approx(2 * np.add(POINTS.min(0), [0, 0, 1])),
    ),
    "`morph`": (
        swapped(
            (
                "<library_visual_scenes>",
                '<library_controllers><controller id="c"><morph source="#g"/></controller></library_controllers><library_visual_scenes>',
            ),
            ('instance_geometry url="#g"', 'instance_controller url="#c"'),
            ("</instance_geometry>", "</instance_controller>"),
        ),
        warned("morph targets are left out"),
    ),
    "`material`, `instance_material`": (dae(), lambda found: [m.name for m in found.mesh.materials] == ["red"]),
    "`diffuse`, `emission`, `shininess`": (
        look("<emission><color>0 .5 0 1</color></emission><shininess><float>6</float></shininess>"),
        lambda found: (
            (found.mesh.materials[0].emissive[1], found.mesh.materials[0].roughness)
            == pytest.approx((to_linear([0.5])[0], 0.5))
        ),
    ),
    "`constant`": (
        swapped(
            ("<lambert>", "<constant>"),
            ("</lambert>", "</constant>"),
            ("<diffuse>", "<emission>"),
            ("</diffuse>", "</emission>"),
        ),
        lambda found: found.mesh.materials[0].unlit and found.mesh.materials[0].base_color == (1, 0, 0, 1),
    ),
    "`transparent`, `transparency`": (
        look(
            '<transparent opaque="RGB_ZERO"><color>.25 .25 .25 1</color></transparent><transparency><float>1</float></transparency>'
        ),
        lambda found: opacity(found) == pytest.approx(0.75),
    ),
    "invisible as written": (
        look("<transparent><color>1 1 1 1</color></transparent><transparency><float>0</float></transparency>"),
        lambda found: opacity(found) == 1 and "drawn visible" in found.warnings[0],
    ),
    "`texture`: `sampler2D`, `surface`, `image`": (
        dae(look=PICTURE),
        lambda found: found.mesh.materials[0].textures["base_color"].mime == "image/png" and not found.warnings,
    ),
    "`texture` of COLLADA 1.5, or that names an image": (
        swapped(
            ("<init_from>checker.png</init_from>", "<init_from><ref>checker.png</ref></init_from>"),
            (PICTURE, '<texture texture="pic"/>'),
            look=PICTURE,
        ),
        lambda found: "base_color" in found.mesh.materials[0].textures and not found.warnings,
    ),
    "`wrap_s`, `wrap_t`": (
        swapped(("<source>s</source>", "<source>s</source><wrap_s>MIRROR</wrap_s><wrap_t>CLAMP</wrap_t>"), look=PICTURE),
        lambda found: found.mesh.materials[0].textures["base_color"].wrap == ("mirror", "clamp"),
    ),
    "`double_sided` (extra)": (
        swapped(
            (
                "</profile_COMMON>",
                '<extra><technique profile="GOOGLEEARTH"><double_sided>1</double_sided></technique></extra></profile_COMMON>',
            )
        ),
        lambda found: found.mesh.materials[0].double_sided,
    ),
    "`bump` (extra)": (
        swapped(
            (
                "</technique></profile",
                f'<extra><technique profile="FCOLLADA"><bump>{PICTURE}</bump></technique></extra></technique></profile',
            ),
            (PICTURE, "<color>1 0 0 1</color>"),
            look=PICTURE,
        ),
        lambda found: [*found.mesh.materials[0].textures] == ["normal"],
    ),
    "pictures of `ambient`, `specular`, `reflective`": (
        swapped(("</lambert>", f"<specular>{PICTURE}</specular></lambert>"), look=PICTURE),
        warned("pictures of specular are left out"),
    ),
    "`profile_CG`, `profile_GLSL`, `profile_GLES` alone": (
        swapped(("<profile_COMMON>", "<profile_GLSL>"), ("</profile_COMMON>", "</profile_GLSL>")),
        warned("no common profile"),
    ),
    "kinematics, physics": (
        swapped(("<scene>", "<library_physics_models/><scene>")),
        warned("the physics of the file are not read"),
    ),
    "`camera`, `light`": (added("", '<node name="lamp"><instance_light url="#x"/></node>'), lambda found: not found.warnings),
    "numbers with decimal commas": (
        swapped(("<color>1 0 0 1</color>", "<color>1,0 0,0 0,0 1,0</color>")),
        warned("decimal commas"),
    ),
}


@pytest.mark.parametrize("row", ROWS)
def test_each_row_of_the_table(tmp_path, row) -> None:
    data, check = ROWS[row]
    write_png(tmp_path / "checker.png")
    loaded = load_mesh(put(tmp_path, "box.dae", data))
    assert check(loaded), (shape(loaded), names(loaded), loaded.warnings, loaded.mesh.materials)


def test_the_table_has_these_rows() -> None:
    section = TABLE.read_text(encoding="utf-8").split("### DAE\n")[1].split("\n### ")[0]
    rows = [line.split(" | ")[0].removeprefix("| ") for line in section.split("\n") if line.startswith("| ")]
    assert rows[1:] == [*ROWS]


def test_a_hole_stays_open_however_its_corners_run(tmp_path) -> None:
    turned = HOLED.replace("<h>4 5 6 7</h>", "<h>7 6 5 4</h>").replace("<p>0 1 2 3</p>", "<p>3 2 1 0</p>")
    loaded = load_mesh(put(tmp_path, "frame.dae", added(turned, FRAME)))
    assert area(loaded, "Frame") == pytest.approx(0.75)
    normals = loaded.mesh.face_normals[loaded.mesh.face_node == names(loaded).index("Frame")]
    np.testing.assert_allclose(normals, np.tile([0, 0, -1], (len(normals), 1)), atol=1e-12)


def test_a_skin_whose_joints_are_not_known_stays_as_it_was_bound(tmp_path) -> None:
    everywhere = load_mesh(put(tmp_path, "a.dae", skinned("<translate>0 0 1</translate>", skeleton="")))
    assert everywhere.mesh.bounds[0] == pytest.approx(2 * np.add(POINTS.min(0), [0, 0, 1]))
    lost = load_mesh(put(tmp_path, "b.dae", skinned().replace(b'sid="b"', b'sid="z"')))
    assert lost.mesh.bounds[0] == pytest.approx(np.add(POINTS.min(0), [50, 0, 0]))
    assert "no usable joints" in lost.warnings[0]


def test_the_other_modes_of_transparency(tmp_path) -> None:
    for mode, color, amount, meant in (
        ("A_ONE", "0 0 0 .5", "0.5", 0.25), ("A_ZERO", "0 0 0 .25", "1", 0.75), ("RGB_ONE", ".5 .5 .5 1", "1", 0.5),
        ("RGB_ZERO", "0 0 0 1", "1", 1.0), ("RGB_ZERO", "1 1 1 1", "1", 1.0), ("RGB_ZERO", "1 1 1 1", "0", 1.0),
    ):  # fmt: skip
        data = look(
            f'<transparent opaque="{mode}"><color>{color}</color></transparent><transparency><float>{amount}</float></transparency>'
        )
        assert opacity(load_mesh(put(tmp_path, "box.dae", data))) == pytest.approx(meant), mode


def test_the_alpha_of_the_diffuse_colour_is_no_opacity(tmp_path) -> None:
    assert opacity(load_mesh(put(tmp_path, "box.dae", dae(look="<color>1 0 0 0</color>")))) == 1


def test_instances_without_end_are_refused(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(dae_reader, "MAX_NODES", 500)
    levels = "".join(f'<node id="l{k}">{INSTANCE.format(k + 1) * 10}</node>' for k in range(9))
    bomb = swapped(
        ("<library_visual_scenes>", f'<library_nodes>{levels}<node id="l9">{DAE_INSTANCE}</node></library_nodes>'
         "<library_visual_scenes>"),
        nodes='<node><instance_node url="#l0"/></node>',
    )  # fmt: skip
    assert_refused(put(tmp_path, "bomb.dae", bomb), "placed nodes")
    assert_refused(put(tmp_path, "wide.dae", dae(nodes=f"<node>{DAE_INSTANCE}</node>" * 600)), "placed nodes")
