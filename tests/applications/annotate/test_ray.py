"""A collection on a real Ray cluster of several nodes on this machine.

pytest -m slow tests/applications/annotate/test_ray.py
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from ledger_rows import column, states, trace

from anymesh.applications.annotate.annotate import Speed, annotate
from anymesh.errors import OptionError
from anymesh.isolation import ChildLimits

pytestmark = pytest.mark.slow
ray = pytest.importorskip("ray")
HERE = Path(__file__).parent
LIMITS = ChildLimits(memory=2 << 30, seconds=30.0, wall=30.0)


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """A head without cores, and two nodes with two each."""
    from ray.cluster_utils import Cluster

    store = 80 << 20  # [bytes] of each node's object store, the least that is allowed
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", os.pathsep.join([str(HERE), os.environ.get("PYTHONPATH", "")]))
        head = {"num_cpus": 0, "object_store_memory": store, "include_dashboard": False}
        made = Cluster(initialize_head=True, head_node_args=head)
        made.nodes_to_kill = [made.add_node(num_cpus=2, object_store_memory=store) for _ in range(2)]
        made.wait_for_nodes()
        yield made
        ray.shutdown()
        made.shutdown()


def workers(cluster: Any) -> Any:
    from anymesh.applications.annotate.ray_ import RayWorkers

    return RayWorkers(cluster.address, LIMITS, target=("fake_work", "run"))


def test_an_address_without_a_cluster_is_an_error_of_ours(tmp_path, collection) -> None:
    with pytest.raises(OptionError, match=r"found no cluster at '127\.0\.0\.1:1'"):
        annotate(str(collection(a="ok")), tmp_path / "out", speed=Speed(ray="127.0.0.1:1"))


def test_the_budget_holds_over_all_nodes(tmp_path, collection, cluster, metered) -> None:
    source, out = collection(**{f"n{k}": "pay" for k in range(12)}), tmp_path / "out"
    found = annotate(str(source), out, work=workers(cluster), max_cost=0.95)
    assert found.ended is not None
    assert found.ended.exit_code == 7
    assert found.found.cost == pytest.approx(0.1 * found.found.counts["done"])
    assert 5 <= found.found.calls == found.found.counts["done"] <= 5 + 8  # a call of at most .5 USD fits up to .45; eight tasks


def test_a_node_that_is_killed_loses_nothing(tmp_path, collection, cluster) -> None:
    words = {f"n{k}": "slow 0.5" for k in range(40)}
    source, out = collection(**words, crash="crash", bad="bad"), tmp_path / "out"

    def kill() -> None:
        while len(trace(out)) < 8:
            time.sleep(0.05)
        cluster.remove_node(cluster.nodes_to_kill[0], allow_graceful=False)

    killer = threading.Thread(target=kill)
    killer.start()
    annotate(str(source), out, work=workers(cluster), speed=Speed(attempts=2))
    killer.join()
    found = states(out)
    assert (found.pop("crash"), found.pop("bad")) == ("quarantined", "quarantined")
    assert set(found.values()) == {"done"}
    assert column(out, "crash", "error_class") == "CrashError"
    assert {name.partition("-")[0] for name in trace(out)} == set(words)
    assert len(trace(out)) == len(words)
