"""Looks by a service: used where what comes back is what was sent, refused with a reason where it is not."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import box, cabinet, mesh_of
from finished import with_wall

from anymesh.errors import ModelError, OptionError
from anymesh.export.glb import GlbBuffer
from anymesh.finishing.bake import png
from anymesh.finishing.finishing import open_completer, open_retexturer
from anymesh.finishing.holopart import HoloPart
from anymesh.finishing.protocol import Finished
from anymesh.finishing.retexture import Remote, described, nearest
from anymesh.finishing.scene_glb import read_scene, scene_glb
from anymesh.finishing.texture import Carried, Painted
from anymesh.formats.gltf.scene import read_gltf
from anymesh.loading.files import Folder
from anymesh.loading.join import join
from anymesh.rendering.render import face_colors
from anymesh.types import Material, Mesh, Texture

EYE = np.eye(4)


class Service:
    """Gives back what it was sent, changed."""

    name = "service"

    def __init__(self, change: Callable[[Mesh], Mesh | bytes]) -> None:
        self.change, self.prompts = change, []

    def retexture(self, glb: bytes, prompt: str) -> bytes:
        self.prompts.append(prompt)
        found = self.change(read_gltf(glb, Folder(Path("sent.glb"))))
        return found if isinstance(found, bytes) else scene_glb({"mesh": found}, EYE)


def halves() -> tuple[Material, ...]:
    """A picture, its left half green, its right half purple."""
    pixels = np.zeros((64, 64, 3), np.uint8)
    pixels[:, :32], pixels[:, 32:] = (10, 200, 10), (120, 10, 160)
    return (Material("new", (1.0, 1.0, 1.0, 1.0), textures={"base_color": Texture(png(pixels), "image/png", "new")}),)


def by_height(mesh: Mesh) -> Mesh:
    """The same faces with a picture that is green below and purple above the middle."""
    above = mesh.triangles[:, :, 1] > mesh.bounds.mean(0)[1]  # Y up
    uv = np.stack([np.where(above, 0.75, 0.25), np.full(above.shape, 0.5)], 2).astype(np.float32)
    return replace(mesh, materials=halves(), corner_uv=uv, face_material=np.zeros(len(uv), int))


def inside(mesh: Mesh) -> Mesh:
    """A part that the object does not have."""
    low, high = mesh.bounds
    v, f = box(low + 0.2 * (high - low), low + 0.5 * (high - low))
    return mesh_of([(v, f)], corner_uv=np.zeros((12, 3, 2), np.float32))[0]


def untouched() -> Finished:
    asset = cabinet()
    return Finished(asset, np.arange(len(asset.mesh.faces)))


def run(change: Callable[[Mesh], Mesh | bytes], finished: Finished | None = None) -> Painted:
    return Remote(Service(change), "a prompt", size=128, padding=1).retexture(finished or untouched())


def built_in() -> np.ndarray:
    return face_colors(run(lambda mesh: b"").asset.mesh)


def expected(mesh: Mesh) -> np.ndarray:
    """Colours of faces that lie on one side of the middle; -1 for the others."""
    z = mesh.triangles[:, :, 2]
    above, below = (z > mesh.bounds.mean(0)[2]).all(1), (z <= mesh.bounds.mean(0)[2]).all(1)
    found = np.full((len(z), 3), -1)
    found[below], found[above] = (10, 200, 10), (120, 10, 160)
    return found


def test_the_same_faces_take_over_the_pictures_that_came_back() -> None:
    found = run(by_height, with_wall())
    assert len(found.notes) == 3
    assert found.notes[-1] == "service: its pictures are used"
    assert [m.name for m in found.asset.mesh.materials] == ["new"]
    told, asked = face_colors(found.asset.mesh).astype(int), expected(found.asset.mesh)
    on = asked[:, 0] >= 0
    assert on.sum() > 60
    np.testing.assert_array_equal(told[on], asked[on])
    np.testing.assert_array_equal(found.asset.mesh.vertices, with_wall().asset.mesh.vertices)


def test_a_result_that_was_centred_and_scaled_is_put_back() -> None:
    def moved(mesh: Mesh) -> Mesh:
        made = by_height(mesh)
        return replace(made, vertices=(made.vertices - 7.0) * 3.0)

    found = run(moved)
    np.testing.assert_array_equal(face_colors(found.asset.mesh), face_colors(run(by_height).asset.mesh))


def test_other_faces_of_the_same_surface_give_their_colours_part_by_part() -> None:
    def finer(mesh: Mesh) -> Mesh:
        """Each face in four, in another order."""
        a, b, c = (mesh.triangles[:, k] for k in range(3))
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        t = np.concatenate([np.stack(s, 1) for s in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])[::-1]
        corners, nothing = np.arange(3 * len(t)).reshape(-1, 3), np.full(len(t), -1)
        return by_height(Mesh(t.reshape(-1, 3), corners, nothing + 1, mesh.nodes, nothing))

    found = run(finer)
    assert "it has other faces" in found.notes[-1]
    assert [m.name for m in found.asset.mesh.materials] == ["retextured"]
    told, asked = face_colors(found.asset.mesh).astype(int), expected(found.asset.mesh)
    on = asked[:, 0] >= 0
    assert np.abs(told[on] - asked[on]).max() <= 1


def test_where_parts_meet_each_has_the_colour_of_its_own() -> None:
    """A floor and a wall that share an edge: on it the floor finds the floor, and the wall the wall."""
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 1, 1], [0, 1, 1.0]])
    mesh, _ = mesh_of([(points, np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4], [3, 4, 5]]))])
    there = nearest(mesh.subset(np.array([3, 1, 2, 0])), mesh, np.array([0, 0, 1, 1]))
    share = np.linspace(0, 1, 9)
    floor = np.stack([0 * share, share, 1 - share], 1)  # of its face 1, on the edge between 2 and 3
    wall = np.stack([share, 1 - share, 0 * share], 1)  # of its face 2
    assert set(there(np.full(9, 1), floor)[0].tolist()) <= {1, 3}
    assert set(there(np.full(9, 2), wall)[0].tolist()) <= {0, 2}


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda mesh: b"glTF" + bytes(30), "not accepted"),
        (lambda mesh: b"", "not accepted"),
        (lambda mesh: replace(by_height(mesh), materials=(Material(),)), "it has faces without a picture"),
        (lambda mesh: replace(by_height(mesh), corner_uv=None), "it has faces without a picture"),
        (
            lambda mesh: by_height(mesh.subset(untouched().asset.segmentation.face_part != 1)),
            "of its surface is not that of the",
        ),
        (lambda mesh: by_height(join([mesh, inside(mesh)])), "of its surface is not that of the object"),
        (lambda mesh: by_height(mesh.subset(np.arange(60))), "of its surface is not that of the object"),
        (lambda mesh: by_height(mesh.transformed(np.diag([1.0, 0.5, 1.0, 1.0]))), "of its surface is not that of the object"),
    ],
)
def test_what_is_not_the_object_is_not_used(change: Callable, why: str) -> None:
    found = run(change)
    assert why in found.notes[-1]
    assert found.notes[-1].startswith("service: not accepted, ")
    assert found.notes[-1].endswith("; the built-in textures are kept")
    assert found.asset.mesh.materials[0].name == "atlas"
    np.testing.assert_array_equal(face_colors(found.asset.mesh), built_in())


def test_what_is_seen_through_keeps_its_look() -> None:
    asset = cabinet()
    glass = replace(asset.mesh.materials[1], alpha_mode="BLEND", base_color=(1.0, 1.0, 1.0, 0.3))
    mesh = replace(asset.mesh, materials=(asset.mesh.materials[0], glass, asset.mesh.materials[2]))
    found = run(by_height, replace(untouched(), asset=replace(asset, mesh=mesh))).asset.mesh
    door = asset.segmentation.face_part == 1
    assert {found.materials[k].alpha_mode for k in found.face_material[door]} == {"BLEND"}
    assert {found.materials[k].name for k in found.face_material[~door]} == {"new"}


def test_a_service_that_cannot_be_asked_is_an_error() -> None:
    def refuses(mesh: Mesh) -> Mesh:
        raise ModelError("no key")

    with pytest.raises(ModelError, match="no key"):
        run(refuses)


def test_without_a_prompt_the_object_and_its_parts_are_named() -> None:
    service = Service(by_height)
    Remote(service, size=128, padding=1).retexture(untouched())
    assert service.prompts == ["a cabinet with door, drawer, knob, realistic materials"]
    assert len(described(replace(cabinet(), name="x" * 900))) == 600


def test_names_of_the_command_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MESHY_API_KEY", "msy_1")
    state = tmp_path / "task.json"
    assert isinstance(open_retexturer("builtin", state=state), Carried)
    assert open_retexturer("bake:512", state=state).size == 512
    assert open_retexturer("bake", state=state).name == "bake"
    remote = open_retexturer("meshy:old oak: waxed", state=state, max_calls=2)
    assert (remote.prompt, remote.name, remote.service.max_calls) == ("old oak: waxed", "meshy", 2)
    assert open_retexturer("meshy", state=state).prompt is None
    for name in ("", "Builtin", "builtin:", "bake:", "bake:big", "meshy:", "meshy: ", "tripo"):
        with pytest.raises(OptionError, match="valid are builtin, bake, bake:PIXELS, meshy or meshy:PROMPT"):
            open_retexturer(name, state=state)
    with pytest.raises(OptionError, match="use --max-calls"):
        open_retexturer("meshy", state=state, max_cost=1.0)
    monkeypatch.delenv("MESHY_API_KEY")
    with pytest.raises(ModelError, match="MESHY_API_KEY"):
        open_retexturer("meshy", state=state)
    assert open_completer("builtin") is None
    assert open_completer("off") is None
    assert isinstance(open_completer("holopart:http://127.0.0.1:9/complete"), HoloPart)
    for name in ("", "HoloPart:x", "builtin:", "holopart"):
        with pytest.raises(OptionError, match=r"valid are .*holopart:FOLDER"):
            open_completer(name)


def test_a_result_may_not_name_files_of_this_machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "secret.png").write_bytes(png(np.zeros((2, 2, 3), np.uint8)))
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "secret.png"}],
    }
    buffer = GlbBuffer()
    buffer.accessor(np.eye(3, dtype=np.float32), bounds=True)
    assert read_scene(buffer.encode(tree), "back.glb").materials[0].textures == {}
