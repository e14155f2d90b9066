"""Functions run in child processes: native code that may crash, hang or exhaust memory, and work that a page can end.

This is the one protocol for child processes. `ChildPool.run` calls a function of a module by name, with limits on processor
time, elapsed time and memory (or none), and passes on the messages that the function reports while it runs. A failure of any
kind is a ChildError, and harms no other call. `ChildPool.close` ends all children at once; they also end with the parent:

    pool = ChildPool(1, ChildLimits(seconds=math.inf, memory=0))
    pool.run("anymesh.some.module", "work", {"mesh": path}, on_message=print)  # work(mesh, report) calls report("load", 3)
"""

from anymesh.isolation.pool import ChildError, ChildLimits, ChildPool, Failure, shared_pool

DECOMPOSER = "anymesh.physics.decompose"  # module whose functions run in child processes
AHEAD = (DECOMPOSER, "manifold3d")  # modules that a child imports before its first call

__all__ = ["AHEAD", "DECOMPOSER", "ChildError", "ChildLimits", "ChildPool", "Failure", "shared_pool"]
