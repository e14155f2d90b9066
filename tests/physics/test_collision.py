"""Test sampled poses of few joints, shapes of whole assets at several sizes, and the cache of shapes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of, source
from test_decomposer import FakePool, bracket

from anymesh import physics
from anymesh.evaluation.ground_truth import prepared, read_ground_truth
from anymesh.export import write_asset
from anymesh.export.links import split_links
from anymesh.geometry.kinematics import carried_links, joint_transform, link_transforms
from anymesh.geometry.raycast_ import RayScene
from anymesh.physics.clear import ContactScene, LinkSurface
from anymesh.physics.collision import CollisionConfig, collision_shapes, joint_poses, sampled_poses
from anymesh.physics.convex import as_hull
from anymesh.physics.decompose import content_key, load_shapes, save_shapes
from anymesh.types import Asset, Box, Cylinder, Hull, JointType, Part, Segmentation

SHEET = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2], [0, 2, 3]])


@pytest.mark.parametrize(("most", "blocks", "poses"), [(5, 3, 2 + 3 * 2), (5, 1, 2 + 4), (2000, 0, 2), (7, 2, 2 + 2 * 2)])
def test_positions_are_shared_among_the_joints_down_to_three_each(most: int, blocks: int, poses: int, monkeypatch) -> None:
    """The rest pose and all joints open are two more; the position 0 of each range is the rest pose."""
    monkeypatch.setattr(physics.collision, "MAX_POSES", most)
    asset = row(blocks)
    assert len(sampled_poses(asset, origins_of(asset), 17)) == poses


def test_fewer_than_three_positions_may_be_asked_for() -> None:
    asset = row(3)
    assert len(sampled_poses(asset, origins_of(asset), 2)) == 2 + 3


def test_one_joint_is_placed_over_its_range_or_a_whole_turn() -> None:
    asset = cabinet()
    origins = origins_of(asset)
    for j in asset.joints:
        low, high = j.limits or (-np.pi, np.pi)
        rest, *placed = joint_poses(asset, origins, j, 4)
        expected = [v for v in np.linspace(low, high, 4) if v != 0]
        assert len(placed) == len(expected)
        for pose, v in zip(placed, expected, strict=True):
            assert pose[j.child] == pytest.approx(joint_transform(j, v) @ rest[j.child])
        still = asset.segmentation.parts[0].name
        assert rest[still][:3, 3] == pytest.approx(origins[still])
        assert all(pose[still] is rest[still] for pose in placed)


def asset_of(*pieces, joints=()) -> Asset:
    mesh, part = mesh_of(pieces)
    parts = tuple(Part(f"part_{k}", "part") for k in range(len(pieces)))
    return Asset("thing", source(), mesh, Segmentation(part, parts), tuple(joints), "")


def made(asset: Asset, **changes):
    links = split_links(asset)
    where = {k.name: k.triangles for k in links}, {k.name: k.origin for k in links}
    return collision_shapes(asset, *where, replace(CollisionConfig(), **changes), pool=FakePool())


@pytest.mark.parametrize(("size", "thickness"), [(0.5, 0.001 * np.sqrt(2)), (50.0, 0.005)])
def test_an_open_sheet_is_as_thick_as_a_wall_of_two_thousandths_up_to_five_millimetres(size: float, thickness: float) -> None:
    (shape,) = made(asset_of((SHEET[0] * size, SHEET[1]))).shapes["part_0"]
    assert isinstance(shape, Box)
    assert np.sort(shape.size) == pytest.approx([thickness, size, size])


@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_a_component_has_the_pieces_of_the_first_gap_unless_contacts_are_false(scale: float) -> None:
    """The middle of the hull's slope is 0.42 from the bracket, and the object's diagonal is 1.73."""
    corners = (scale * bracket().triangles).reshape(-1, 3)
    asset = asset_of((corners, np.arange(len(corners)).reshape(-1, 3)))
    counts = [len(made(asset, gaps=gaps).shapes["part_0"]) for gaps in ((0.4, 0.01), (0.01, 0.4))]
    assert counts == [1, 2]


@pytest.mark.parametrize("scale", [0.1, 10.0])
@pytest.mark.parametrize(("share", "overlap"), [(0.0027, False), (0.0033, True)])
def test_links_overlap_if_they_penetrate_by_three_thousandths_of_the_diagonal(
    scale: float, share: float, overlap: bool
) -> None:
    size = np.sqrt(1 + 1 + 4)
    upper = box((0.4, 0.05, 1 - share * size), (0.6, 0.3, 2))  # beside the diagonals of the top
    slide = joint("slide", "prismatic", "part_0", "part_1", (0, 0, 0), (0, 0, 1), (0.0, 0.1 * scale))
    pieces = [(v * scale, f) for v, f in (box((0, 0, 0), (1, 1, 1)), upper)]
    found = made(asset_of(*pieces, joints=[slide]), rest_gap=0.0)
    assert found.overlapping == ((("part_0", "part_1"),) if overlap else ())
    assert found.false_before == (0 if overlap else 1)
    assert found.tight == ()
    total = sum(float(np.ptp(as_hull(s).vertices[:, 2])) for some in found.shapes.values() for s in some)
    assert total == pytest.approx((2 + (share * size if overlap else 0)) * scale, abs=1e-3 * scale)


@pytest.mark.parametrize(("scale", "gap"), [(0.1, 0.002 * 0.1 * np.sqrt(6)), (1.0, 0.002)])
@pytest.mark.parametrize("deep", [-0.0001, 0.0, 0.2])
def test_at_rest_shapes_keep_a_gap_whatever_their_surfaces_do(scale: float, gap: float, deep: float) -> None:
    upper = box((0.4, 0.05, 1 - deep), (0.6, 0.3, 2))
    slide = joint("slide", "prismatic", "part_0", "part_1", (0, 0, 0), (0, 0, 1), (0.0, 0.1 * scale))
    asset = asset_of(*((v * scale, f) for v, f in (box((0, 0, 0), (1, 1, 1)), upper)), joints=[slide])
    found = made(asset)
    assert found.overlapping == ((("part_0", "part_1"),) if deep > 0 else ())
    (low,), (high,) = (found.shapes[name] for name in ("part_0", "part_1"))
    assert isinstance(low, Box)
    assert isinstance(high, Box)
    between = as_hull(high).vertices[:, 2].min() - as_hull(low).vertices[:, 2].max()
    assert 0.99 * gap < between < 1.15 * gap


def test_a_link_without_surface_gets_the_smallest_box() -> None:
    point = np.full((3, 3), 0.5), np.array([[0, 1, 2]])
    slide = joint("slide", "prismatic", "part_0", "part_1", (0, 0, 0), (0, 0, 1), (0.0, 0.1))
    found = made(asset_of(box((0, 0, 0), (1, 1, 1)), point, joints=[slide]))
    (shape,) = found.shapes["part_1"]
    assert np.ptp(as_hull(shape).vertices, axis=0) == pytest.approx([0.002 * np.sqrt(3)] * 3)


def test_a_key_has_one_shape_which_is_replaced(tmp_path) -> None:
    brick, rod = Box(np.ones(3), np.eye(3), np.array([1, 2, 3.0])), Cylinder(np.zeros(3), np.eye(3), 0.5, 2.0)
    save_shapes(tmp_path / "a", "k", (rod, rod))
    save_shapes(tmp_path / "a", "k", (brick,))
    (found,) = load_shapes(tmp_path / "a", "k") or ()
    assert isinstance(found, Box)
    assert (found.size.tolist(), found.center.tolist()) == ([1, 2, 3], [1, 1, 1])
    save_shapes(tmp_path / "a", "many", (as_hull(brick), rod, brick))
    many = load_shapes(tmp_path / "a", "many") or ()
    assert [type(s) for s in many] == [Hull, Cylinder, Box]
    np.testing.assert_array_equal(as_hull(many[0]).vertices, as_hull(brick).vertices)
    save_shapes(tmp_path / "a", "none", ())
    assert load_shapes(tmp_path / "a", "none") == ()


def test_a_folder_that_cannot_be_written_or_a_file_of_other_arrays_is_ignored(tmp_path) -> None:
    (tmp_path / "file").write_text("")
    save_shapes(tmp_path / "file", "k", ())
    assert load_shapes(tmp_path / "file", "k") is None
    with (tmp_path / "odd.npz").open("wb") as out:
        np.savez(out, arrays=np.array([1]), **{"0_0": np.zeros(3)})
    assert load_shapes(tmp_path, "odd") is None
    np.savez(tmp_path / "old.npz", other=np.zeros(3))
    assert load_shapes(tmp_path, "old") is None


@pytest.mark.parametrize("kept", [0, 100, -30])
def test_a_damaged_file_is_ignored(tmp_path, kept: int) -> None:
    save_shapes(tmp_path, "k", (Box(np.ones(3), np.eye(3), np.array([1, 2, 3.0])),))
    stored = tmp_path / "k.npz"
    stored.write_bytes(stored.read_bytes()[:kept])
    assert load_shapes(tmp_path, "k") is None


def test_objects_in_a_stored_file_are_refused(tmp_path) -> None:
    """numpy stores objects as pickles, which run code when they are loaded."""
    cylinder = {f"0_{n}": value for n, value in enumerate((np.zeros(3), np.eye(3), np.array(0.5), np.array(2.0)))}
    np.savez(tmp_path / "plain.npz", arrays=np.array([4]), **cylinder)
    np.savez(tmp_path / "pickled.npz", arrays=np.array([4], object), **cylinder)
    assert [type(s) for s in load_shapes(tmp_path, "plain") or ()] == [Cylinder]
    assert load_shapes(tmp_path, "pickled") is None


def test_keys_depend_on_every_value_and_its_order() -> None:
    a, b = np.arange(3.0), np.arange(4.0)
    keys = {content_key(a, 1), content_key(b, 1), content_key(a, 2), content_key(1, a), content_key(a), content_key(a, 1, 0.5)}
    assert len(keys) == 6
    assert content_key(a, 1) == content_key(a[::-1][::-1], 1.0)


def test_specks_that_no_engine_can_make_a_hull_of_become_boxes() -> None:
    """Triangles of ten nanometres a metre apart, as thick as walls: needles in double precision, lines in single."""
    specks = [1e-8 * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]) + at for at in (-0.5, 0.5)]
    shapes = made(asset_of((np.concatenate(specks), np.array([[0, 1, 2], [3, 4, 5]])))).shapes["part_0"]
    assert all(isinstance(shape, Box) for shape in shapes)


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


EXAMPLES = Path(__file__).parents[2] / "examples"
BALL = 0.03  # of the object's diagonal: radius of the ball


def true_asset(name: str) -> Asset:
    """Return a shipped example with its true parts and joints."""
    return prepared(read_ground_truth(EXAMPLES / "truth" / f"{name}.json", EXAMPLES / "meshes" / f"{name}.glb")).asset()


class World:
    """A written asset in MuJoCo with a free ball. Some joints are fixed at their upper limit, others at rest."""

    def __init__(self, folder: Path, asset: Asset, opened: set[str]) -> None:
        write_asset(asset, folder)
        spec = mujoco.MjSpec.from_file(str(folder / f"{asset.name}.xml"))
        self.radius = BALL * asset.mesh.diagonal
        ball = spec.worldbody.add_body(name="ball")
        ball.add_freejoint()
        ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[self.radius, 0, 0], density=500)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self.geom = self.model.body("ball").geomadr[0]
        self.hold = {j.name: j.limits[1] if j.name in opened and j.limits else 0.0 for j in asset.joints if j.type != "fixed"}

    def place(self, point) -> None:
        self.data.qpos[:], self.data.qvel[:] = self.model.qpos0, 0
        address = self.model.jnt_qposadr[self.model.body("ball").jntadr[0]]
        self.data.qpos[address : address + 3] = point
        self._held()
        mujoco.mj_forward(self.model, self.data)

    def _held(self) -> None:
        for name, value in self.hold.items():
            self.data.joint(name).qpos, self.data.joint(name).qvel = value, 0

    def drop(self, point, seconds: float = 1.5) -> np.ndarray:
        """Return the position of the ball after it was dropped."""
        self.place(point)
        for _ in range(round(seconds / self.model.opt.timestep)):
            self._held()
            mujoco.mj_step(self.model, self.data)
        return self.data.body("ball").xpos.copy()

    def touched(self, point) -> bool:
        """Return whether the ball at this point touches anything."""
        self.place(point)
        pairs = self.data.contact.geom[: self.data.ncon]
        return bool((pairs == self.geom).any())


def box_of(asset: Asset, part: str) -> np.ndarray:
    number = [p.name for p in asset.segmentation.parts].index(part)
    corners = asset.mesh.triangles[asset.segmentation.faces(number)].reshape(-1, 3)
    return np.array([corners.min(0), corners.max(0)])


def open_place(asset: Asset, low, high, way, radius: float) -> np.ndarray:
    """Return the place behind a door, nearest to its center, from which half of `way` is free of the base for a ball."""
    mesh = asset.mesh.subset(asset.segmentation.face_part == 0)
    scene = RayScene(mesh.vertices, mesh.faces)
    across = [i for i in range(3) if way[i] == 0]
    middle = (low + high) / 2
    places = []
    for share in np.stack(np.meshgrid(*[np.linspace(0.15, 0.85, 9)] * 2), -1).reshape(-1, 2):
        place = middle.copy()
        place[across] = low[across] + share * (high - low)[across]
        ring = [place + radius * np.eye(3)[i] * off for i in across for off in np.linspace(-1.2, 1.2, 13)]
        if scene.first_hit(np.array(ring), np.tile(way, (len(ring), 1)), 0.6).distance.min() > 0.6:
            places.append(place)
    assert places, "nothing is open behind the door"
    return min(places, key=lambda p: float(np.linalg.norm(p - middle)))


@pytest.mark.parametrize("name", ["cabinet", "tilted_drawer"])
def test_a_ball_stays_in_an_opened_drawer_and_can_be_put_there_from_above(name, tmp_path):
    asset = true_asset(name)
    slides = [j for j in asset.joints if j.type is JointType.PRISMATIC]
    assert slides
    joint = slides[0]
    assert joint.limits
    world = World(tmp_path, asset, {joint.name})
    low, high = box_of(asset, joint.child) + joint.limits[1] * joint.axis
    middle = (low + high) / 2
    for height in np.linspace(high[2] + 2 * world.radius, middle[2], 5):
        assert not world.touched([*middle[:2], height])
    end = world.drop(middle)
    assert (end > low).all()
    assert (end < high).all()


@pytest.mark.parametrize(("name", "part"), [("microwave", "door"), ("fridge", None), ("cabinet", None)])
def test_a_probe_enters_behind_every_opened_door_and_a_ball_stays(name, part, tmp_path):
    asset = true_asset(name)
    doors = [j for j in asset.joints if j.type is JointType.REVOLUTE and abs(j.axis[2]) > 0.9 and part in (None, j.child)]
    assert doors
    world = World(tmp_path, asset, {j.name for j in doors})
    body = box_of(asset, asset.segmentation.parts[0].name)
    for door in doors:
        low, high = box_of(asset, door.child)
        depth = int(np.argmin(high - low))
        way = np.zeros(3)
        way[depth] = np.sign(body.mean(0)[depth] - (low + high)[depth] / 2)  # from the door into the base
        start = open_place(asset, low, high, way * np.ptp(body[:, depth]), world.radius)
        free = [not world.touched(start + way * share * np.ptp(body[:, depth])) for share in np.linspace(-0.3, 0.45, 9)]
        assert all(free), (door.child, free)
        end = world.drop(start + way * 0.4 * np.ptp(body[:, depth]))
        assert (end > body[0]).all(), door.child
        assert (end < body[1]).all(), door.child


def test_lengths_are_small_shares_of_the_object_in_a_known_order() -> None:
    """Walls are thicker than contacts and thinner than real collisions; finer shapes are closer and of more pieces."""
    c = CollisionConfig()
    assert 0 < c.contact < c.wall < c.crossing < c.gaps[1] < c.gaps[0] < 0.05
    assert 0 < c.wall_most < 0.01
    assert len(c.gaps) == len(c.pieces) == 2
    assert c.pieces[0] < c.pieces[1]


def test_a_link_that_touches_its_parent_on_its_way_is_tight_and_one_that_leaves_it_is_not() -> None:
    """A dial turns on a plate, a lid opens from it; engines that test a link against its parent would brake the dial."""
    asset = asset_of(
        box((0, 0, 0), (1, 1, 0.1)), box((0.1, 0.4, 0.1), (0.3, 0.6, 0.2)), box((0.5, 0, 0.1), (1, 1, 0.15)),
        joints=(
            joint("turn", "continuous", "part_0", "part_1", (0.2, 0.5, 0.1), (0, 0, 1), None),
            joint("lift", "revolute", "part_0", "part_2", (0.5, 0.5, 0.1), (0, -1, 0), (0.0, 1.5)),
        ),
    )  # fmt: skip
    surfaces, origins = {k.name: k.triangles for k in split_links(asset)}, origins_of(asset)
    assert collision_shapes(asset, surfaces, origins, CollisionConfig(rest_gap=0.0)).tight == (("part_0", "part_1"),)
    assert collision_shapes(asset, surfaces, origins).tight == ()  # the gap at rest keeps it free
