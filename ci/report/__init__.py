"""What every core costs: measured on a real arm, compared, written to `reports/` and the README.

measure (simulation), ci.synth (area, clock) -> run (workers, what is kept) -> tables, paper, engines, figures ->
documents (page, headline, terminal); freshness tells what may be kept and whether the committed report still follows.

The verdict at equal accuracy: designs (a core with codecs, at any parameters) -> reach (the shortest words) -> search
(measured or kept) -> verdict (figures, tables). Only on the default arm.
"""

from tb.lib import tools

DEFAULT_ARM = "cobra600"
REPORTS = tools.ROOT / "reports"  # of the default arm, committed
OTHERS = tools.BUILD / "report"  # of any other arm, a folder each
README = tools.ROOT / "README.md"
PLOTS = ("area_latency.png", "accuracy.png", "tip_error_map.png", "verdict.png")
