"""Does the asset move in a simulator? One file per engine, one report for all."""
