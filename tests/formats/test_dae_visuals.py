"""Test the visuals of DAE with our reader of COLLADA, which shares no code with the writer."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet
from models import CONFIG, desk, model_of, with_meshes

from anymesh.entry_points import WRITE_DAE, resolve
from anymesh.export.formats import write_formats
from anymesh.export.meshes import visible
from anymesh.export.model import Model
from anymesh.export.options import Format, Visuals
from anymesh.loading import load_mesh
from anymesh.types import Mesh
from anymesh.types.mesh import to_srgb


def written(asset, folder: Path) -> Model:
    """Write a URDF and an SDFormat whose visuals are DAE."""
    model = model_of(asset)
    model = replace(model, how=replace(model.how, visuals=Visuals.DAE))
    with_meshes(model, folder)
    resolve(WRITE_DAE)(model, folder, CONFIG)
    write_formats(model, folder, [Format.URDF, Format.SDF, Format.MJCF], CONFIG)
    return model


def read(folder: Path, link: str) -> Mesh:
    loaded = load_mesh(folder / "meshes" / f"{link}.dae")
    assert not loaded.warnings
    return loaded.mesh


@pytest.mark.parametrize("make", [cabinet, desk])
def test_dae_is_the_link_in_metres_with_z_up(tmp_path, make):
    model = written(make(), tmp_path)
    for body in model.tiled.bodies:
        mesh = read(tmp_path, body.name)
        wanted = np.concatenate([p.positions[p.triangles] for p in visible(body.link, CONFIG)])
        np.testing.assert_allclose(ordered(mesh.triangles), ordered(wanted), atol=1e-6)
        assert mesh.corner_normal is not None
        np.testing.assert_allclose(np.linalg.norm(mesh.corner_normal, axis=2), 1, atol=1e-5)
        assert (np.einsum("nij,nj->ni", mesh.corner_normal, mesh.face_normals) > 0.9).all()


def ordered(triangles: np.ndarray) -> np.ndarray:
    rows = np.round(triangles.reshape(-1, 9), 4)
    return triangles[np.lexsort(rows.T)]


def test_dae_keeps_colours_pictures_and_their_coordinates(tmp_path):
    model = written(cabinet(), tmp_path)
    door = read(tmp_path, "door")
    (material,) = [m for m in door.materials if m.textures]
    source = next(body.link for body in model.tiled.bodies if body.name == "door")
    own = model.tiled.asset.mesh.materials[source.primitives[0].material]
    assert material.textures["base_color"].data == own.textures["base_color"].data
    uv = np.concatenate([p.uv[p.triangles].reshape(-1, 2) for p in source.primitives])
    np.testing.assert_allclose(np.sort(door.corner_uv.reshape(-1, 2), axis=0), np.sort(uv, axis=0), atol=1e-6)
    knob = next(body.link for body in model.tiled.bodies if body.name == "knob").primitives[0]
    wanted = model.tiled.asset.mesh.materials[knob.material].base_color[:3]
    np.testing.assert_allclose(read(tmp_path, "knob").materials[0].base_color[:3], wanted, atol=1e-5)


def test_dae_has_the_mean_of_vertex_colours_which_viewers_do_not_show(tmp_path):
    asset = cabinet()
    color = asset.mesh.corner_color.copy()
    color[::2, :, :3] = (100, 0, 0)
    color[1::2, :, :3] = (200, 0, 0)
    written(replace(asset, mesh=replace(asset.mesh, corner_color=color, face_material=np.full(len(color), -1))), tmp_path)
    knob = read(tmp_path, "knob")
    assert knob.corner_color is None
    assert to_srgb(knob.materials[0].base_color[:3]) == pytest.approx([150 / 255, 0, 0], abs=2e-2)


def test_urdf_and_sdf_refer_to_dae_and_mjcf_to_obj(tmp_path):
    written(cabinet(), tmp_path)
    urdf, sdf, mjcf = ((tmp_path / name).read_text() for name in ("cabinet.urdf", "model.sdf", "cabinet.xml"))
    assert 'filename="meshes/door.dae"' in urdf
    assert 'discardvisual="true"' in urdf  # MuJoCo does not read DAE
    assert "<uri>meshes/door.dae</uri>" in sdf
    assert "door.obj" in mjcf
    assert ".dae" not in mjcf
