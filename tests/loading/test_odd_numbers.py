"""Numbers that mean nothing: texture coordinates and cutoffs that are not finite, and files that take long for their size."""

import re
import time

import numpy as np
import pytest
from mesh_files import FACES, POINTS, UV, assert_refused, plain_gltf, put, rows, stl_ascii, stl_binary, triples

from anymesh.loading import load_mesh


@pytest.mark.parametrize("value", ["nan", "inf", "1e37", "1e300"])
def test_texture_coordinates_that_mean_no_place_are_0(tmp_path, value) -> None:
    uv = "\n".join(f"vt {value if k == 0 else u} {v}" for k, (u, v) in enumerate(UV))
    corners = "\n".join("f " + " ".join(f"{c + 1}/{c + 1}" for c in face) for face in FACES)
    read = load_mesh(put(tmp_path, "box.obj", (rows("v ", POINTS) + uv + "\n" + corners + "\n").encode()))
    uv_read = read.mesh.corner_uv
    assert uv_read is not None
    assert np.isfinite(uv_read).all()
    first = np.array(FACES) == 0
    assert (uv_read[first][:, 0] == 0).all()
    assert uv_read[~first] == pytest.approx(UV[np.array(FACES)][~first])
    if value != "nan":  # the OBJ reader takes NaN for 0 without a warning
        assert any("texture coordinates" in w for w in read.warnings)


@pytest.mark.parametrize(("cutoff", "kept"), [(float("nan"), 0.5), (float("inf"), 0.5), (0.3, 0.3), (1.5, 1.5)])
def test_a_cutoff_is_finite(tmp_path, cutoff, kept) -> None:
    document = plain_gltf()
    document.doc["materials"] = [{"alphaMode": "MASK", "alphaCutoff": cutoff}]
    document.doc["meshes"][0]["primitives"][0]["material"] = 0
    assert load_mesh(put(tmp_path, "a.glb", document.glb())).mesh.materials[0].alpha_cutoff == kept


def test_a_mesh_that_does_not_exist_is_refused(tmp_path) -> None:
    document = plain_gltf()
    document.doc["nodes"][0]["mesh"] = -1
    assert_refused(put(tmp_path, "a.glb", document.glb()), "index -1")


def test_what_moves_or_repeats_a_mesh_is_told(tmp_path) -> None:
    document = plain_gltf()
    document.doc["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {}}}
    document.doc["meshes"][0]["primitives"][0]["targets"] = [{}]
    document.doc["extensionsRequired"] = ["KHR_materials_unlit", "ACME_gravity"]
    warnings = " ".join(load_mesh(put(tmp_path, "a.glb", document.glb())).warnings)
    assert "instances" in warnings
    assert "morph targets" in warnings
    assert "ACME_gravity" in warnings
    assert "unlit" not in warnings


def test_an_obj_counts_from_1_also_in_its_errors(tmp_path) -> None:
    data = (rows("v ", POINTS) + triples() + "f 1 2 1000\n").encode()
    assert_refused(put(tmp_path, "a.obj", data), "vertex 1000; valid are 1 to 8")


@pytest.mark.parametrize(
    "change",
    [
        bytes.upper,
        lambda d: b"\xef\xbb\xbf" + d,
        lambda d: d.replace(b"\n", b" "),
        lambda d: d.replace(b"\n", b"\r"),
        lambda d: b"\f" + d,
        lambda d: re.sub(rb" normal [^\n]*", b"", d),
        lambda d: re.sub(rb"solid[^\n]*", b"solid my facet normal map, vertex one two three", d, count=1),
        lambda d: re.sub(rb"endsolid[^\n]*", b"endsolid facet normal vertex a b c", d),
        lambda d: d.replace(b"outer loop", b"outer loop ; a vertex of the box here"),
    ],
    ids=["capitals", "mark", "one line", "returns", "feed", "no normals", "title", "end", "comments"],
)
def test_spellings_of_ascii_stl(tmp_path, change) -> None:
    plain = load_mesh(put(tmp_path, "a.stl", stl_ascii())).mesh
    assert (load_mesh(put(tmp_path, "b.stl", change(stl_ascii()))).mesh.triangles == plain.triangles).all()


def test_a_binary_stl_may_have_text_in_its_header(tmp_path) -> None:
    data = b"solid made of facets".ljust(80) + stl_binary()[80:]
    assert len(load_mesh(put(tmp_path, "a.stl", data)).mesh.faces) == len(FACES)


def seconds(path) -> float:
    begin = time.process_time()
    load_mesh(path)
    return time.process_time() - begin


def test_the_time_of_large_outlines_and_empty_lines_does_not_explode(tmp_path) -> None:
    rng = np.random.default_rng(0)
    outline = np.c_[rng.random((3000, 2)), np.zeros(3000)]  # crosses itself thousands of times
    polygon = put(tmp_path, "a.obj", (rows("v ", outline) + "f " + " ".join(map(str, range(1, 3001))) + "\n").encode())
    empty = put(tmp_path, "b.stl", stl_ascii().replace(b"endfacet\n", b"endfacet" + b"\n" * 50_000))
    assert len(load_mesh(polygon).mesh.faces) == 2998
    assert seconds(polygon) < 2  # 0.1 s; with the triangles of one corner after the other it took hours
    assert seconds(empty) < 2
    assert seconds(put(tmp_path, "c.stl", stl_ascii() + stl_ascii().replace(b"solid", b"solid" + b" " * 100_000, 1))) < 2
