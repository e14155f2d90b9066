"""Files of exporters that keep to a format less closely than its readers expect."""

from __future__ import annotations

import numpy as np
import pytest
from assets import checker
from mesh_files import FACES, POINTS, all_files, dae, put

from anymesh.loading import load_mesh


def test_dae_geometry_survives_a_broken_material(tmp_path) -> None:
    """Exporters of Blender name surfaces that do not exist; the geometry with that material was lost."""
    (tmp_path / "checker.png").write_bytes(checker())
    broken = dae(look='<texture texture="p" texcoord="c"/>').replace(b"<source>s</source>", b"<source>gone</source>")
    loaded = load_mesh(put(tmp_path, "box.dae", broken))
    np.testing.assert_allclose(loaded.mesh.triangles, POINTS[FACES])
    (warning,) = loaded.warnings
    assert "its materials are left out" in warning


@pytest.mark.parametrize("name", ["ascii.stl", "box.obj"])
@pytest.mark.parametrize("end", [b"\r", b"\r\n"])
def test_lines_may_end_with_a_carriage_return(tmp_path, name, end) -> None:
    mesh = load_mesh(put(tmp_path, name, all_files()[name].replace(b"\n", end))).mesh
    np.testing.assert_allclose(mesh.triangles, POINTS[FACES], atol=1e-6)
