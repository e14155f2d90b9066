"""Files of exporters that keep to a format less closely than its readers expect."""

from __future__ import annotations

import re

import numpy as np
import pytest
from assets import checker
from mesh_files import FACES, POINTS, all_files, dae, put

from anymesh.loading import load_mesh
from anymesh.loading.trimesh_ import with_decimal_points


def test_dae_geometry_survives_a_broken_material(tmp_path) -> None:
    """Exporters of Blender name surfaces that do not exist; the geometry with that material was lost."""
    (tmp_path / "checker.png").write_bytes(checker())
    broken = dae(look='<texture texture="p" texcoord="c"/>').replace(b"<source>s</source>", b"<source>gone</source>")
    loaded = load_mesh(put(tmp_path, "box.dae", broken))
    np.testing.assert_allclose(loaded.mesh.triangles, POINTS[FACES])
    (warning,) = loaded.warnings
    assert "its materials are left out" in warning


def test_dae_decimal_commas_are_points(tmp_path) -> None:
    """FBX exporters write them on computers that are set to German or French."""
    plain = dae(unit='<unit meter="0.01"/>', look="<color>0.5 0.25 1.0 1</color>").replace(b"0 0 9", b"0.0 0.0 9.5")
    commas = re.sub(rb"(?<=[\d> \"-])(\d+)\.(\d+)(?=[\s<\"])", rb"\1,\2", plain).replace(b'version="1,', b'version="1.')
    assert b"0,5 0,25" in commas
    assert b'"0,01"' in commas
    first, second = (load_mesh(put(tmp_path, name, data)) for name, data in (("a.dae", plain), ("b.dae", commas)))
    np.testing.assert_array_equal(first.mesh.triangles, second.mesh.triangles)
    assert first.mesh.materials[0].base_color == second.mesh.materials[0].base_color
    assert first.unit_in_metres == second.unit_in_metres == 0.01
    assert second.warnings == ("found decimal commas, which are taken for points",)
    assert first.warnings == ()


@pytest.mark.parametrize(
    "text", [b"<a>1,2,3</a>", b"<a>0,5 1.5</a>", b"<a>p, q</a>", b'<a n="Box 1,5"/>', b'<a id="1,5"/>', b"<a>1,5 x</a>"]
)
def test_other_commas_of_a_dae_stay(text: bytes) -> None:
    assert with_decimal_points(text) == text


@pytest.mark.parametrize("name", ["ascii.stl", "box.obj"])
@pytest.mark.parametrize("end", [b"\r", b"\r\n"])
def test_lines_may_end_with_a_carriage_return(tmp_path, name, end) -> None:
    mesh = load_mesh(put(tmp_path, name, all_files()[name].replace(b"\n", end))).mesh
    np.testing.assert_allclose(mesh.triangles, POINTS[FACES], atol=1e-6)
