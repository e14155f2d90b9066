"""Test files with a few wrong bytes: the result is a mesh or an InputError, within a short time."""

import json
import random
import warnings

import numpy as np
import pytest
from mesh_files import all_files, put

from anymesh.errors import InputError
from anymesh.loading import load_mesh

FILES = all_files()


def spoiled(data: bytes, rng: random.Random) -> bytes:
    """Return data with a few bytes changed, removed, duplicated, or with the end missing."""
    data = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(max(len(data), 1))
        match rng.randrange(6):
            case 0 | 1:
                data[at : at + 1] = [rng.randrange(256)]
            case 2:
                data[at : at + 1] = [rng.choice(b'0123456789-.e /\n"{}[]<>nul')]
            case 3:
                del data[at : at + rng.randint(1, 9)]
            case 4:
                data[at:at] = data[at : at + rng.randint(1, 40)]
            case _:
                data = data[: max(at, 1)]
    return bytes(data)


def misspelt(data: bytes, rng: random.Random) -> bytes:
    """Return data with a few letters and digits replaced by others, so that the syntax of text stays valid."""
    data = bytearray(data)
    places = [k for k, c in enumerate(data) if chr(c).isalnum()]
    for at in rng.sample(places, rng.randint(1, 3)):
        data[at] = rng.choice(b"0123456789" if chr(data[at]).isdigit() else b"abcdefinstxyz")
    return bytes(data)


@pytest.mark.parametrize("name", [*FILES, "scene.gltf"])
def test_spoiled_files_give_a_mesh_or_an_input_error(tmp_path, name) -> None:
    data = FILES.get(name) or json.dumps(json.loads(FILES["box.gltf"]) | {"materials": [{}], "images": [{}]}).encode()
    rng = random.Random(name)
    good = 0
    for k in range(200):
        path = put(tmp_path, name, (misspelt if k % 2 else spoiled)(data, rng))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                mesh = load_mesh(path).mesh
            except InputError:
                continue
        good += 1
        assert np.isfinite(mesh.triangles).all()
        assert mesh.diagonal > 0
    assert good > 0 or name == "scene.gltf"
