"""Native code that may crash, hang or exhaust memory, run in child processes with limits."""

from anymesh.isolation.pool import ChildError, ChildLimits, ChildPool, Failure, shared_pool

__all__ = ["ChildError", "ChildLimits", "ChildPool", "Failure", "shared_pool"]
