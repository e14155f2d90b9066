"""Wheels that mesh are found by their teeth, and fluted knobs side by side are none."""

import numpy as np
import pytest
from assets import box, joint, mesh_of

from anymesh.mechanisms.meshing import with_gears
from anymesh.types import Mimic, Part, Segmentation

UP = np.array([0.0, 0, 1])


def wheel(teeth: int, module: float, center, phase: float = 0.0, depth: float = 2.25):
    """A wheel with trapezoids as teeth, of thickness .02."""
    middle, pitch = module * teeth / 2, 2 * np.pi / teeth
    tip, root = middle + module * depth / 2.25, middle - 1.25 * module * depth / 2.25
    profile = [(-0.35, root), (-0.13, tip), (0.13, tip), (0.35, root)]
    ring = [(r, phase + (k + share) * pitch) for k in range(teeth) for share, r in profile]
    around = np.array([(r * np.cos(a), r * np.sin(a)) for r, a in ring]) + np.asarray(center, float)
    n = len(around)
    vertices = np.concatenate([np.c_[around, np.full(n, z)] for z in (0.0, 0.02)] + [[[*center, 0.0], [*center, 0.02]]])
    k, after = np.arange(n), (np.arange(n) + 1) % n
    sides = np.concatenate([np.c_[k, after, after + n], np.c_[k, after + n, k + n]])
    ends = np.concatenate([np.c_[after, k, np.full(n, 2 * n)], np.c_[k + n, after + n, np.full(n, 2 * n + 1)]])
    return vertices, np.concatenate([sides, ends])


def train(wheels, **axes):
    """A base and wheels (center, vertices, faces) that turn on it; axes: of joints that do not turn about +z."""
    mesh, part = mesh_of([box((-1, -1, -0.1), (1, 1, -0.05)), *(shape for _, shape in wheels)])
    names = ["base", *(f"w{k}" for k in range(len(wheels)))]
    joints = tuple(
        joint(f"j{k}", "continuous", "base", f"w{k}", (*center, 0.0), axes.get(f"j{k}", UP), None)
        for k, (center, _) in enumerate(wheels)
    )
    return with_gears(mesh, Segmentation(part, tuple(Part(n, "part") for n in names)), joints)


def test_a_train_follows_its_largest_wheel():
    centers = ((0.0, 0.0), (0.18, 0.0), (0.33, 0.0))
    shapes = [wheel(n, 0.01, c, p) for n, c, p in zip((24, 12, 18), centers, (0, np.pi / 12, 0), strict=True)]
    first, second, third = train(list(zip(centers, shapes, strict=True)), j2=-UP)
    assert first.mimic is None
    assert second.mimic == Mimic("j0", -2.0)
    assert third.mimic is not None
    assert third.mimic.ratio == pytest.approx(-24 / 18)
    assert third.reason.endswith("its teeth mesh")


@pytest.mark.parametrize(
    ("other", "apart"),
    [
        (wheel(12, 0.01, (0.25, 0.0)), 0.25),  # too far away
        (wheel(12, 0.013, (0.2, 0.0)), 0.2),  # other teeth
        (wheel(24, 0.01, (0.26, 0.0), depth=0.5), 0.26),  # flutes
    ],
)
def test_what_does_not_mesh_follows_nothing(other, apart):
    joints = train([((0.0, 0.0), wheel(24, 0.01, (0.0, 0.0))), ((apart, 0.0), other)])
    assert [j.mimic for j in joints] == [None, None]


def test_a_mimic_that_is_there_already_stays():
    shapes = [((0.0, 0.0), wheel(24, 0.01, (0.0, 0.0))), ((0.18, 0.0), wheel(12, 0.01, (0.18, 0.0), np.pi / 12))]
    first, second = train(shapes)
    mesh, part = mesh_of([box((-1, -1, -0.1), (1, 1, -0.05)), *(shape for _, shape in shapes)])
    segmentation = Segmentation(part, tuple(Part(n, "part") for n in ("base", "w0", "w1")))
    assert with_gears(mesh, segmentation, (first, second))[1].mimic == second.mimic
