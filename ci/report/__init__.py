"""What every core costs: measured on a real arm, compared, written to `reports/` and the README.

measure (simulation), ci.synth (area, clock) -> run (what is kept, measured, stale) -> tables, comparison, figures ->
documents (page, headline, terminal).

The verdict at equal accuracy: designs (a core with codecs, at any parameters) -> reach (the shortest words) -> search
(measured or kept) -> comparison (who wins). Only on the default arm.
"""

from tb.lib import tools

DEFAULT_ARM = "cobra600"
REPORTS = tools.ROOT / "reports"  # of the default arm, committed
OTHERS = tools.BUILD / "report"  # of any other arm, a folder each
README = tools.ROOT / "README.md"
PLOTS = ("area_latency.png", "accuracy.png", "tip_error_map.png", "verdict.png")
