"""The benches of every core; tb/stimulus has the corners of each family."""

from tb.lib import suite

test_bench, test_bulk, test_exhaustive = suite.benches()
