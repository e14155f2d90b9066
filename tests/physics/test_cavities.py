"""Test typical uses of an asset: a ball in an open drawer, and a hand in an open cupboard."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from anymesh.evaluation.ground_truth import prepared, read_ground_truth
from anymesh.export import write_asset
from anymesh.geometry.raycast_ import RayScene
from anymesh.types import Asset, JointType

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
