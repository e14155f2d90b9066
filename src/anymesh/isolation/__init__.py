"""Native code that may crash, hang or exhaust memory, run in child processes with limits."""

from anymesh.isolation.pool import ChildError, ChildLimits, ChildPool, Failure, shared_pool

DECOMPOSER = "anymesh.collision.decomposer"  # the module that children import

__all__ = ["DECOMPOSER", "ChildError", "ChildLimits", "ChildPool", "Failure", "shared_pool"]
