"""Test parts given by a user: nodes of the scene, a file of face labels, and names of materials."""

import io
import json
from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.errors import OptionError
from anymesh.pipeline.solving import Solver
from anymesh.segmentation.naming import parts_from_file, parts_from_nodes
from anymesh.types import Material, Mesh, Node, Segmentation

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


def test_an_object_of_one_node_per_material_is_one_part() -> None:
    materials = (Material("oak"), Material("steel"), Material("door"))
    mesh = replace(with_nodes("lid_oak", "body", "lid.Steel"), face_material=np.array([0, 2, 1])[PIECE], materials=materials)
    assert names(parts_from_nodes(mesh)) == ["body", "lid"]
    parts = replace(with_nodes("case_oak", "case_door", "x"), face_material=np.array([0, 2, 1])[PIECE], materials=materials)
    assert names(parts_from_nodes(parts)) == ["case_door", "case_oak", "x"]  # the material is called like a part


@pytest.mark.parametrize("parts", ["auto", "nodes"])
def test_names_in_other_scripts_are_among_the_reasons(parts) -> None:
    found = Solver(with_nodes("柜门", "柜体", "ручка")).parts(parts).segmentation
    assert all(any(name in part.reason for part in found.parts) for name in ("柜门", "柜体", "ручка"))


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


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_json_with_a_byte_order_mark_is_read(encoding, tmp_path) -> None:
    (tmp_path / "l.json").write_text(json.dumps(LABELS), encoding=encoding)
    assert parts_from_file(MESH, tmp_path / "l.json").face_part[-1] == 2


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
    "negative_without_names.json": [-k for k in LABELS],
    "negative_without_names.npy": -PIECE,
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


def zipped() -> bytes:
    file = io.BytesIO()
    np.savez(file, labels=PIECE)
    return file.getvalue()


@pytest.mark.parametrize(
    ("name", "data", "found"),
    [
        ("empty.npy", b"", "an empty file in empty.npy"),
        ("zipped.npy", zipped(), "a ZIP archive"),
        ("cut_zip.npy", zipped()[:50], "a ZIP archive"),
        ("text.npy", b"0 1 2", "another format"),
        ("cut.npy", b"\x93NUMPY\x01\x00", "a broken array"),
        ("header.npy", b"\x93NUMPY\x01\x00\x04\x00{(((" + bytes(200), "a broken array"),
        ("empty.json", b"", "an empty file in empty.json"),
        ("deep.json", b"[" * 200_000, "nested too deep"),
        ("deep_labels.json", b"[" * 200 + b"]" * 200, "lists of"),
        ("binary.json", b"\xff\xfe\xff\x00", "no JSON"),
        ("cut.json", b"[0, 1", "no JSON"),
        ("no_faces.json", b'{"names": []}', 'no "faces"'),
        ("minus.json", json.dumps([-1, *LABELS[1:]]).encode(), "the label -1"),
    ],
)
def test_what_a_file_holds_instead_of_labels_is_told(name: str, data: bytes, found: str, tmp_path) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(OptionError) as told:
        parts_from_file(MESH, tmp_path / name)
    assert f"found {found}" in str(told.value) or f"found lists {found}" in str(told.value)
    assert name in str(told.value)
    assert "; valid " in str(told.value)


def test_a_name_that_is_too_long_for_a_file(tmp_path) -> None:
    with pytest.raises(OptionError, match="cannot be opened"):
        parts_from_file(MESH, tmp_path / f"{'a' * 300}.npy")


def test_the_length_found_and_the_one_expected_are_told(tmp_path) -> None:
    np.save(tmp_path / "l.npy", PIECE[:-1])
    with pytest.raises(OptionError, match=r"\(35,\).* 36 faces"):
        parts_from_file(MESH, tmp_path / "l.npy")
    with pytest.raises(OptionError, match="found no file"):
        parts_from_file(MESH, tmp_path / "none.npy")


WALLS = [
    box((-0.3, 0.28, 0), (0.3, 0.3, 0.8)),
    box((-0.3, 0, 0), (-0.28, 0.28, 0.8)),
    box((0.28, 0, 0), (0.3, 0.28, 0.8)),
    box((-0.28, 0, 0), (0.28, 0.28, 0.02)),
    box((-0.28, 0, 0.78), (0.28, 0.28, 0.8)),
]
FRONT = box((-0.3, -0.02, 0), (0.3, 0, 0.8))  # a plate that covers the opening, without handle and clearance


def segmented(wood: str, paint: str) -> Segmentation:
    materials = (Material(wood),) if wood == paint else (Material(wood), Material(paint))
    number = np.repeat([0] * len(WALLS) + [len(materials) - 1], 12)
    mesh, _ = mesh_of([*WALLS, FRONT], number, materials=materials)
    return Solver(mesh).parts().segmentation


@pytest.mark.parametrize(("paint", "found"), [("Door_white", ["base", "door"]), ("paint_2", ["base"])])
def test_a_front_in_a_material_named_door(paint: str, found: list[str]) -> None:
    assert [p.name for p in segmented("wood", paint).parts] == found


def test_the_name_of_the_only_material_tells_nothing() -> None:
    named, plain = segmented("door_oak", "door_oak"), segmented("wood", "wood")
    assert named.face_part.tolist() == plain.face_part.tolist()
    assert [(p.name, p.confidence, p.reason) for p in named.parts] == [(p.name, p.confidence, p.reason) for p in plain.parts]
