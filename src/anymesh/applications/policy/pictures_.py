"""Pictures of an environment by the project's ray caster."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, UInt8

from anymesh.applications.plan.film_ import draw_surfaces, drawn_geoms, geom_surface
from anymesh.applications.policy.scene_ import compose
from anymesh.applications.policy.simulation_ import TaskSimulation
from anymesh.applications.policy.tasks import PolicyTask
from anymesh.types.camera import Camera

FOV = np.deg2rad(35)
WAY = np.array([-0.75, -0.55, 0.5]) / np.linalg.norm([-0.75, -0.55, 0.5])  # from the object to the camera
ROOM = 0.12  # [m] around the object
FLOOR = 1.2  # [m] side of the square of ground that is drawn


class ScenePicture:
    """Draws the present state of a simulation."""

    def __init__(self, simulation: TaskSimulation, width: int = 320, height: int = 240) -> None:
        self.simulation, mujoco = simulation, simulation.mujoco
        lifts = simulation.task is PolicyTask.LIFT
        self._model = compose(simulation.object, simulation.robot, lifts=lifts, visuals=True).compile()
        self._data = mujoco.MjData(self._model)
        geoms = [g for g in drawn_geoms(self._model) if self._model.geom_rgba[g, 3] > 0 and not self._is_floor(g)]
        self._shapes = [(g, *geom_surface(mujoco, self._model, self._data, g)) for g in geoms]
        half = FLOOR / 2
        a, b, c, d = ([x, y, 0.0] for x, y in ((-half, -half), (half, -half), (half, half), (-half, half)))
        self._floor = np.array([[a, b, c], [a, c, d]])
        colors = [np.tile([209, 209, 204], (2, 1)), *(np.tile(color, (len(own), 1)) for _, own, color in self._shapes)]
        self._colors = np.concatenate(colors).astype(np.uint8)
        self._camera = self._looking(width, height)

    def _is_floor(self, geom: int) -> bool:
        return self._model.geom(geom).name == "floor"

    def _looking(self, width: int, height: int) -> Camera:
        T = self.simulation.object.T_world_asset
        points = self.simulation.object.points @ T[:3, :3].T + T[:3, 3]
        above = self.simulation.handle_at_start + np.array([0, 0, ROOM])
        points = np.concatenate([points, above[None]])
        low, high = points.min(0), points.max(0)
        center = (low + high) / 2
        radius = float(np.linalg.norm(high - low)) / 2 + ROOM
        return Camera.looking_at(center + WAY * radius / np.sin(FOV / 2), center, FOV, width, height)

    def frame(self) -> UInt8[np.ndarray, "H W 3"]:
        """Draw the object, the robot and the floor."""
        s, data = self.simulation, self._data
        data.qpos[:], data.mocap_pos[:], data.mocap_quat[:] = s.data.qpos, s.data.mocap_pos, s.data.mocap_quat
        s.mujoco.mj_kinematics(self._model, data)
        surfaces: list[Float[np.ndarray, "_ 3 3"]] = [self._floor]
        surfaces += [own @ data.geom_xmat[g].reshape(3, 3).T + data.geom_xpos[g] for g, own, _ in self._shapes]
        return draw_surfaces(surfaces, self._colors, self._camera)
