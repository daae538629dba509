"""Benches of the arm family; stimulus.py beside this file has its corners."""

from tb.lib import suite

test_bench, test_bulk, test_exhaustive = suite.family("arm")
