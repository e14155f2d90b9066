"""Grasps of the moving parts of an asset for a parallel gripper, ranked by moving the joints in MuJoCo."""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.applications.grasps.grasps import Grasp, GraspKind, JointGrasps, read_grasps, write_grasps
    from anymesh.applications.grasps.ranking_ import rank_grasps

__all__ = ["Grasp", "GraspKind", "JointGrasps", "rank_grasps", "read_grasps", "write_grasps"]
__getattr__ = on_first_use(__name__, {**dict.fromkeys(__all__, "grasps"), "rank_grasps": "ranking_"})
