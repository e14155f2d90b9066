"""Being here puts this folder on the path, so that every test can import `assets` and `contract`."""

from hypothesis import HealthCheck, settings

settings.register_profile("repeatable", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("repeatable")  # the same examples each time, however slow the machine
