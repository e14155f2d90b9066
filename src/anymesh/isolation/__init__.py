"""Native code that may crash, hang or exhaust memory, run in child processes with limits."""

from anymesh.isolation.pool import ChildError, ChildLimits, ChildPool, Failure, shared_pool

DECOMPOSER = "anymesh.physics.collision.decomposer"  # module whose functions run in child processes
AHEAD = (DECOMPOSER, "manifold3d")  # modules that a child imports before its first call

__all__ = ["AHEAD", "DECOMPOSER", "ChildError", "ChildLimits", "ChildPool", "Failure", "shared_pool"]
