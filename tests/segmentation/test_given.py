"""Parts that a user gives: as nodes of the scene, or as a file of face labels."""

import json
from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.errors import OptionError
from anymesh.segmentation.given import parts_from_file, parts_from_nodes
from anymesh.types import Mesh, Node

SMALL, LARGE, MIDDLE = box((0, 0, 0), (1, 1, 1)), box((0, 0, 0), (5, 5, 5)), box((0, 0, 0), (2, 2, 2))
MESH, PIECE = mesh_of([SMALL, LARGE, MIDDLE])
LABELS = PIECE.tolist()


def with_nodes(*names: str) -> Mesh:
    return replace(MESH, face_node=PIECE, nodes=tuple(Node(n) for n in names))


def names(segmentation) -> list[str]:
    return [p.name for p in segmentation.parts]


def test_the_node_named_base_is_the_root() -> None:
    found = parts_from_nodes(with_nodes("Base", "lid", "Left Door"))
    assert names(found) == ["Base", "lid", "Left_Door"]
    assert [p.label for p in found.parts] == ["base", "lid", "door"]
    assert found.face_part.tolist() == LABELS


def test_else_the_largest_node_is_the_root() -> None:
    found = parts_from_nodes(with_nodes("database", "body", "knob"))
    assert names(found) == ["body", "database", "knob"]
    assert found.face_part.tolist() == np.array([1, 0, 2])[PIECE].tolist()


def test_nodes_without_faces_are_no_parts_and_names_become_legal_and_unique() -> None:
    mesh = replace(
        MESH, face_node=np.array([4, 1, 3])[PIECE], nodes=tuple(map(Node, ("camera", "a b", "empty", "a_b", "世界")))
    )
    assert names(parts_from_nodes(mesh)) == ["a_b_2", "a_b", "part"]


@pytest.mark.parametrize("kind", [np.int64, np.uint8, np.int32])
def test_labels_from_npy(kind, tmp_path) -> None:
    np.save(tmp_path / "l.npy", (2 * PIECE).astype(kind))
    found = parts_from_file(MESH, tmp_path / "l.npy")
    assert names(found) == ["base", "part_2", "part_4"]
    assert found.face_part.tolist() == LABELS


def test_labels_from_json_with_and_without_names(tmp_path) -> None:
    path = tmp_path / "l.json"
    path.write_text(json.dumps(LABELS))
    assert names(parts_from_file(MESH, path)) == ["base", "part_1", "part_2"]
    path.write_text(json.dumps({"names": ["wheel", "corpus", "unused", "Tür"], "faces": [[0, 1, 3][k] for k in LABELS]}))
    found = parts_from_file(MESH, path)
    assert names(found) == ["corpus", "wheel", "Tur"]  # the largest first
    assert [p.label for p in found.parts][:2] == ["base", "wheel"]
    assert found.face_part.tolist() == np.array([1, 0, 2])[PIECE].tolist()


FAULTY = {
    "short.npy": np.array(LABELS[:-1]),
    "float.npy": np.array(LABELS, float),
    "bool.npy": PIECE > 0,
    "column.npy": PIECE[:, None],
    "pickle.npy": np.array([None] * len(LABELS), dtype=object),
    "short.json": LABELS[:-1],
    "words.json": ["a"] * len(LABELS),
    "ragged.json": [[0], *LABELS[1:]],
    "number.json": 3,
    "no_faces.json": {"names": ["a", "b", "c"]},
    "few_names.json": {"names": ["a", "b"], "faces": LABELS},
    "negative.json": {"names": ["a", "b", "c"], "faces": [-k for k in LABELS]},
    "labels.txt": LABELS,
}


@pytest.mark.parametrize("name", FAULTY)
def test_faulty_labels_are_one_error_of_one_line_that_names_the_file(name: str, tmp_path) -> None:
    path = tmp_path / name
    if path.suffix == ".npy":
        np.save(path, FAULTY[name], allow_pickle=True)
    else:
        path.write_text(json.dumps(FAULTY[name]))
    with pytest.raises(OptionError) as told:
        parts_from_file(MESH, path)
    assert "\n" not in str(told.value)
    assert str(told.value).startswith("--parts: ")
    assert name in str(told.value) or path.suffix == ".txt"


def test_the_length_found_and_the_one_expected_are_told(tmp_path) -> None:
    np.save(tmp_path / "l.npy", PIECE[:-1])
    with pytest.raises(OptionError, match=r"\(35,\).* 36 faces"):
        parts_from_file(MESH, tmp_path / "l.npy")
    with pytest.raises(OptionError, match="found no file"):
        parts_from_file(MESH, tmp_path / "none.npy")
