"""Test the codecs of compressed glTF: meshopt against data that its own encoder wrote (from the formulas below), and Draco."""

import base64
import json
from pathlib import Path

import DracoPy
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from anymesh.formats.gltf.buffers import DataError
from anymesh.formats.gltf.compressed_ import draco_attributes, meshopt

ENCODED = {
    name: base64.b64decode(text) for name, text in json.loads(Path(__file__).with_name("meshopt.json").read_text()).items()
}
VIEWS = {
    "words0": (260, 16, "ATTRIBUTES", "NONE"), "words1": (260, 16, "ATTRIBUTES", "NONE"),
    "oct": (40, 8, "ATTRIBUTES", "OCTAHEDRAL"),
    "quat": (40, 8, "ATTRIBUTES", "QUATERNION"), "exp": (40, 16, "ATTRIBUTES", "EXPONENTIAL"),
    "color": (40, 4, "ATTRIBUTES", "COLOR"),
    "mesh": (180, 4, "TRIANGLES", "NONE"), "indices": (36, 2, "INDICES", "NONE"), "triangles": (36, 2, "TRIANGLES", "NONE"),
}  # fmt: skip
N = np.arange(260)
K = np.arange(40)
DRACO = DracoPy.encode(np.eye(3), np.array([[0, 1, 2]]), quantization_bits=11)


def view(name: str) -> dict:
    return dict(zip(("count", "byteStride", "mode", "filter"), VIEWS[name], strict=True))


def decoded(name: str, kind: str, width: int) -> np.ndarray:
    return np.frombuffer(meshopt(ENCODED[name], view(name)), kind).reshape(-1, width)


def unit(*columns) -> np.ndarray:
    rows = np.stack(np.broadcast_arrays(*columns), 1)
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


@pytest.mark.parametrize("name", ["words0", "words1"])
def test_vertices_of_both_versions(name) -> None:
    columns = [
        0 * N, N, 3 * N + N * N * 7 % 3, N * N * 37 % 64, 1000 + N**3 * 31 % 17, np.where(N % 50 == 0, N * 200, 5),
        np.where(N % 10 == 0, N * 40503 % 65536, 7), N % 2,
    ]  # fmt: skip
    np.testing.assert_array_equal(decoded(name, "<u2", 8), np.stack(columns, 1))


def test_filters() -> None:
    direction = unit(np.cos(K), np.sin(K), 0.5 * np.sin(3 * K))
    np.testing.assert_allclose(decoded("oct", "<i2", 4)[:, :3] / 32767, direction, atol=2e-3)
    np.testing.assert_allclose(decoded("exp", "<f4", 4)[:, :3], direction, atol=2e-4)
    turn = unit(np.cos(K), np.sin(2 * K), np.sin(3 * K), 0.3)
    same = (decoded("quat", "<i2", 4) / 32767 * turn).sum(1)
    np.testing.assert_allclose(np.abs(same), 1, atol=1e-3)  # q and -q are the same turn
    np.testing.assert_allclose(decoded("color", "u1", 4) / 255, (np.arange(160) * 7 % 41 / 40).reshape(-1, 4), atol=0.02)


def test_triangles_and_sequences() -> None:
    expected = []
    for i in range(40):
        expected.append((i, i + 1, i * i * 13 % 97 + 50))
        expected += [(i + 1, i + 2, i + 50)] if i % 3 == 0 else []
        expected += [(3000 + i, 2999 - i, i)] if i % 7 == 0 else []
    faces = [
        min(np.roll(f, k).tolist() for k in range(3)) for f in decoded("mesh", "<u4", 3)
    ]  # the first corner may be another
    assert faces == [min(np.roll(f, k).tolist() for k in range(3)) for f in expected]
    np.testing.assert_array_equal(np.sort(decoded("indices", "<u2", 3)), np.sort(decoded("triangles", "<u2", 3)))


@given(st.sampled_from(sorted(VIEWS)), st.integers(0, 10**6), st.binary(min_size=0, max_size=4), st.integers(0, 3))
def test_broken_meshopt_data_is_one_error_or_other_numbers(name, place, new, removed) -> None:
    data = ENCODED[name]
    place %= len(data)
    count, stride, *_ = VIEWS[name]
    try:
        assert len(meshopt(data[:place] + new + data[place + removed :], view(name))) == count * stride
    except DataError:
        return


@pytest.mark.parametrize(
    "wrong", [{"count": -1}, {"count": 10**9}, {"byteStride": 6}, {"mode": "X"}, {"filter": "X"}, {"count": 20.5}]
)
def test_absurd_views_are_refused(wrong) -> None:
    with pytest.raises(DataError):
        meshopt(ENCODED["words1"], view("words1") | wrong)


@given(st.integers(0, 10**6), st.binary(min_size=0, max_size=4), st.integers(0, 3))
def test_broken_draco_data_is_one_error_or_another_mesh(place, new, removed) -> None:
    place %= len(DRACO)
    try:
        draco_attributes(DRACO[:place] + new + DRACO[place + removed :], {"POSITION": 0})
    except DataError:
        return


def test_draco_that_states_billions_or_lacks_an_attribute() -> None:
    attributes, index = draco_attributes(DRACO, {"POSITION": 0})
    assert len(attributes["POSITION"]) == len(index) == 3
    with pytest.raises(DataError, match="lacks NORMAL"):
        draco_attributes(DRACO, {"NORMAL": 5})
    with pytest.raises(DataError, match="states 4294967295"):
        draco_attributes(DRACO[:12] + b"\xff\xff\xff\xff\x0f" + DRACO[13:], {"POSITION": 0})
