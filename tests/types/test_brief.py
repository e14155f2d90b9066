"""No repr prints arrays or bytes: those of assets have ten lines at most, those of other values one."""

import ast
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet, joint

import anymesh
from anymesh.types import Brief, Exchange, Material, Picture, Texture
from anymesh.types.brief import brief
from anymesh.types.exchange import PNG

SOURCE = Path(anymesh.__file__).parent


def test_every_dataclass_that_holds_arrays_or_bytes_is_brief():
    """They derive from Brief, or have a repr of their own."""
    long = []
    for path in SOURCE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef) and any("dataclass" in ast.unparse(d) for d in node.decorator_list):
                kinds = [ast.unparse(f.annotation) for f in node.body if isinstance(f, ast.AnnAssign)]
                holds = any(w in kind for kind in kinds for w in ("ndarray", "bytes") if "Callable" not in kind)
                own = any(isinstance(m, ast.FunctionDef) and m.name == "__repr__" for m in node.body)
                if holds and not own and "Brief" not in {ast.unparse(b) for b in node.bases}:
                    long.append(f"{path.relative_to(SOURCE)}:{node.name}")
    assert not long


def test_an_asset_is_printed_in_ten_lines_with_its_joints():
    text = str(cabinet())
    assert text.splitlines()[0] == "Asset 'cabinet': 4 parts, 120 faces, by geometry"
    assert text.splitlines()[1] == (
        "  Joint 'hinge': door on base, revolute 0..109 deg, axis (0, 0, 1) through (0.6, 0, 0.3), confidence 0.90"
    )
    assert "1 warnings" in text
    many = [joint(f"j{k}", "fixed", "base", f"p{k}", (0, 0, 0), (0, 0, 1), None) for k in range(30)]
    parts = (cabinet().segmentation.parts[0], *(replace(cabinet().segmentation.parts[1], name=j.child) for j in many))
    mesh = cabinet().mesh
    segmentation = replace(cabinet().segmentation, parts=parts, face_part=np.arange(len(mesh.faces)) % 31)
    assert len(repr(replace(cabinet(), segmentation=segmentation, joints=tuple(many))).splitlines()) <= 10


@pytest.mark.parametrize(
    "value",
    [
        cabinet().mesh,
        cabinet().segmentation,
        cabinet().source,
        cabinet().joints,
        cabinet().mesh.materials,
        Exchange("marks", "k", "m", "t" * 9000, (Picture(PNG + bytes(9000)),), "a" * 9000, "accepted", 1, 1, None, False, 1.0),
    ],
    ids=lambda value: type(value).__name__,
)
def test_values_are_printed_in_one_line_without_bytes(value):
    text = repr(value)
    assert "\n" not in text
    assert "\\x" not in text
    assert "array(" not in text
    assert len(text) < 700


def test_arrays_are_described_and_vectors_printed():
    assert brief(np.array([0.0, -0.0, 1.23456])) == "(0, 0, 1.235)"
    assert brief(np.zeros((4, 4))) == "float64 (4, 4)"
    assert brief(b"abc") == "3 bytes"
    assert brief({"a": b"abc"}) == "(a: 3 bytes)"
    assert brief([Texture(b"", "image/png")] * 9) == "9 Texture"
    assert repr(Material("oak")).startswith("Material(name='oak', base_color=4 float")

    @dataclass
    class Own(Brief):
        data: bytes

        def __repr__(self) -> str:
            return "mine"

    assert repr(Own(b"abc")) == "mine"
