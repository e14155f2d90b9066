"""Environments for reinforcement learning from articulated assets, and training on sets of them (paper, 4.2 and table 2)."""

from anymesh.applications.policy.tasks import NO_RANDOMIZATION, PolicyTask, Randomization

__all__ = ["NO_RANDOMIZATION", "PolicyTask", "Randomization"]
