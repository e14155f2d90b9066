"""Environments for reinforcement learning from articulated assets, and training on sets of them (paper, 4.2 and table 2)."""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.applications.policy.tasks import NO_RANDOMIZATION, PolicyTask, Randomization

__all__ = ["NO_RANDOMIZATION", "PolicyTask", "Randomization"]
__getattr__ = on_first_use(__name__, dict.fromkeys(__all__, "tasks"))
