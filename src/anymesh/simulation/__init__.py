"""Tests of an asset's motion in simulators: one file per engine, one report format for all."""
