"""What someone else completed is taken where it agrees with what is seen."""

import numpy as np
import pytest
from assets import box
from surfaces import FRONT, SIZE, case_with_door, is_closed, part_triangles

from anymesh.finishing.complete import accept, accepted, complete, complete_shapes
from anymesh.finishing.protocol import Completer, PartMesh


def door(shift: float = 0.0, deeper: float = 0.0) -> PartMesh:
    """The whole door, shifted along y or thicker inwards."""
    vertices, faces = box((0, -FRONT + shift, 0), (SIZE[0], shift + deeper, SIZE[2]))
    return PartMesh(vertices, faces)


def test_what_agrees_is_taken_and_the_part_keeps_its_faces():
    asset = case_with_door()
    found = accept(asset, {"door": door(deeper=0.05)}, who="someone")
    assert accepted(found, "someone") == ("door",)
    old = len(asset.mesh.faces)
    assert (found.asset.mesh.triangles[:old] == asset.mesh.triangles).all()
    new = found.asset.mesh.triangles[found.source_face < 0]
    assert len(new)
    assert new[..., 1].max() == 0.05
    assert (found.asset.segmentation.face_part[found.source_face < 0] == 1).all()


@pytest.mark.parametrize(("made", "why"), [(door(shift=-0.1), "of what is seen"), (door(deeper=2.0), "has no surface")])
def test_what_does_not_agree_is_not_taken(made, why):
    asset = case_with_door()
    found = accept(asset, {"door": made}, who="someone")
    assert found.asset is asset
    assert accepted(found, "someone") == ()
    assert why in found.notes["door"][0]


def test_empty_and_unknown_parts():
    asset = case_with_door()
    nothing = PartMesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert "empty" in accept(asset, {"door": nothing}, who="someone").notes["door"][0]
    with pytest.raises(ValueError, match="window"):
        accept(asset, {"window": door()}, who="someone")
    with pytest.raises(ValueError, match=r"0\.\.7"):
        PartMesh(door().vertices, door().faces + 1)


def test_a_back_that_completes_the_border_closes_the_part():
    found = accept(case_with_door(), {"door": door()}, who="someone", tolerance=0.001)
    assert is_closed(part_triangles(found.asset, "door"))


class Someone:
    """Completes the door, and the case wrongly."""

    name = "someone"

    def complete(self, asset):
        return {"door": door(), "case": door(shift=0.3)}


def test_the_built_in_completer_does_what_was_not_taken():
    asset, someone = case_with_door(), Someone()
    assert isinstance(someone, Completer)
    found = complete(asset, completer=someone)
    assert found.notes["door"] == ("someone: accepted, 2 new faces",)
    assert "not accepted" in found.notes["case"][0]
    assert "skin" in found.notes["case"][1]
    old = len(asset.mesh.faces)
    assert (found.source_face[:old] == np.arange(old)).all()
    assert (found.source_face[old:] == -1).all()
    alone = complete(asset)
    assert (alone.asset.mesh.triangles == complete_shapes(asset).asset.mesh.triangles).all()
