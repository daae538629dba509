"""Measure every core on a real arm and write what it costs.

    python -m ci.report                  measure what the committed report does not have; write reports/, README
    python -m ci.report --arm mine.toml  another arm: write build/report/mine/ (--out: another folder), nothing else
    python -m ci.report --verdict        and search the verdict at equal accuracy (half an hour on two cores)
    python -m ci.report --fresh          measure everything again, and say where it differs from the committed report
    python -m ci.report --check          does the committed report still follow from the sources? (seconds)
"""

from __future__ import annotations

import argparse
import signal
import sys
import time

from quadrance import arms, cores

from ci.report import DEFAULT_ARM, README, REPORTS, documents, run, search, up5k
from tb.lib import tools

REFRESH = "run `make report` and commit reports/ and README.md"


def check() -> None:
    """Exit with the reasons where the committed report is stale."""
    if problems := [*run.check(), *search.check(), *up5k.check()]:
        raise SystemExit("\n".join(["The committed report no longer follows from the sources:",
                                    *(f"  {problem}" for problem in problems), f"To refresh: {REFRESH}."]))
    print("The committed report follows from the sources.")


def report(arm: str, fresh: bool, verdict: bool = False, out: str | None = None) -> None:
    """Measure, write and print the report of an arm; the verdict is searched, or the committed one shown."""
    started, listed, committed = time.monotonic(), cores.reported(), run.committed()
    arm = DEFAULT_ARM if run.is_default(arm) else arm
    folder = run.folder_of(arm, out)
    if folder == REPORTS and (problems := documents.wrong_marks(README)):
        raise ValueError("\n".join(problems))  # before minutes of measuring, not after
    made, maps, kept = run.put_together(arm, listed, committed, fresh)
    if folder == REPORTS:
        made["engines"] = run.engines(listed, None if fresh else committed)
        made["up5k"] = up5k.put_together(made, listed, committed, fresh)
        made |= {"verdict": search.put_together(arm, committed, fresh)} if verdict else search.standing(arm, committed)
    run.write(made, maps, folder, README)
    documents.show(made)
    count = len(listed)
    print(f"From the committed report, of {count} cores and parameter sets: area of {kept['area']}, clock of "
          f"{kept['clock']}, cycles and errors of {kept['simulation']}.")
    if fresh:
        lines = run.differences(committed, made)
        if verdict:
            lines += search.differences((committed or {}).get("verdict"), made["verdict"])
        print("\n".join(["Other than in the committed report:", *(f"  {line}" for line in lines)]) if lines else
              "Every figure is the one of the committed report.")
    if folder == REPORTS and (problems := search.check(made)):
        print("\n".join(["The verdict at equal accuracy is not that of today; `make verdict` searches what is open:",
                         *(f"  {problem}" for problem in problems)]))
    where = tools.local(folder) if folder.is_relative_to(tools.ROOT) else folder
    print(f"Written to {where}/ (report.json, report.md, plots) in {time.monotonic() - started:.0f} s."
          + ("" if folder == REPORTS else f" Only {DEFAULT_ARM} refreshes reports/ and README.md."))


def main() -> None:
    """Do what the command line says."""
    parser = argparse.ArgumentParser(prog="python -m ci.report", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arm", default=DEFAULT_ARM, help="name of models/quadrance/arms or path of a TOML file")
    parser.add_argument("--out", help="folder of the report of another arm")
    parser.add_argument("--verdict", action="store_true", help="search the verdict at equal accuracy, default arm only")
    parser.add_argument("--fresh", action="store_true", help="measure everything again and compare")
    parser.add_argument("--check", action="store_true", help="only check that the committed report is fresh")
    args = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    try:
        check() if args.check else report(args.arm, args.fresh, args.verdict, args.out)
    except KeyboardInterrupt as stop:
        raise SystemExit(f"report: interrupted; {stop or 'what was finished'} kept in build/cache") from None
    except (arms.ArmError, RuntimeError, ValueError) as error:
        raise SystemExit(f"report: {error}") from None


if __name__ == "__main__":
    main()
