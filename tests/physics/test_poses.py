"""Test the sampled poses of collision shapes: equal to forward kinematics, and limited in number."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from assets import box, cabinet, joint, mesh_of, source

from anymesh.export.links import split_links
from anymesh.geometry.kinematics import carried_links, link_transforms
from anymesh.physics.clear import ContactScene, LinkSurface
from anymesh.physics.collision import MAX_POSES, MIN_POSES, sampled_poses
from anymesh.types import Asset, Part, Segmentation


def row(count: int) -> Asset:
    """Return a base and `count` sliding blocks in a row."""
    pieces = [box((0, 0, 0), (1, 1, 0.1)), *(box((0.1 * k, 1.2, 0), (0.1 * k + 0.05, 1.3, 0.1)) for k in range(count))]
    mesh, part = mesh_of(pieces)
    names = ["base", *(f"block_{k}" for k in range(count))]
    slides = [joint(f"{n}_joint", "prismatic", "base", n, (0, 0, 0), (0, 0, 1), (0.0, 0.2)) for n in names[1:]]
    segmentation = Segmentation(part, tuple(Part(n, "block") for n in names))
    return Asset("row", source(), mesh, segmentation, tuple(slides), "")


def origins_of(asset: Asset) -> dict[str, np.ndarray]:
    return {link.name: link.origin for link in split_links(asset)}


def test_each_pose_places_links_as_forward_kinematics_does():
    asset = cabinet()
    origins, poses = origins_of(asset), sampled_poses(asset, origins_of(asset), 5)
    positions = [{}]
    for j in asset.joints:
        low, high = j.limits or (-np.pi, np.pi)
        positions += [{j.name: v} for v in np.linspace(low, high, 5) if v != 0]
    positions.append({j.name: (j.limits or (0, np.pi))[1] for j in asset.joints})
    assert len(poses) == len(positions)
    for pose, told in zip(poses, positions, strict=True):
        for name, T in link_transforms(asset, told).items():
            np.testing.assert_allclose(pose[name][:3, :3], T[:3, :3], atol=1e-12)
            np.testing.assert_allclose(pose[name][:3, 3], T[:3, :3] @ origins[name] + T[:3, 3], atol=1e-12)


def test_a_joint_carries_its_child_and_what_hangs_on_it():
    asset = cabinet()
    by_child = {j.child: j for j in asset.joints}
    assert carried_links(asset, by_child["drawer"]) == ["drawer", "knob"]
    assert carried_links(asset, by_child["knob"]) == ["knob"]


def test_many_joints_get_fewer_places_each():
    few, many = row(3), row(300)
    assert len(sampled_poses(few, origins_of(few), 17)) == 2 + 3 * 16  # 0 is the rest pose
    count = MAX_POSES // 300
    assert MIN_POSES < count < 17
    assert len(sampled_poses(many, origins_of(many), 17)) == 2 + 300 * (count - 1)


def test_overlaps_are_found_among_all_pairs():
    """The result equals that of separate scenes of two links each."""
    rng = np.random.default_rng(0)
    solids = {f"link_{k}": _turned_box(rng) for k in range(12)}
    poses = [{name: np.eye(4) for name in solids}]
    scene = ContactScene({name: LinkSurface(t) for name, t in solids.items()}, poses, 1e-3, 1e-3)
    pairs = [(a, b) for a in sorted(solids) for b in sorted(solids) if a < b]
    alone = [pair for pair in pairs if replace(scene, surfaces={n: scene.surfaces[n] for n in pair})._cross(*pair, 0)]
    assert scene.overlapping == tuple(alone)
    assert 0 < len(alone) < len(pairs)


def _turned_box(rng: np.random.Generator) -> np.ndarray:
    vertices, faces = box((-0.5, -0.2, -0.1), (0.5, 0.2, 0.1))
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return (vertices @ turn.T + rng.uniform(-1, 1, 3))[faces]
