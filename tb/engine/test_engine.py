"""Benches of the engines; stimulus.py beside this file has their corners."""

from tb.lib import suite

test_bench, test_bulk, test_exhaustive = suite.family("engine")
