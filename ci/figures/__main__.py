"""Draw all pictures and fill the pages."""

from quadrance.cores import ROOT

from ci.figures import FOLDER, gradient, newton, parallel

for paper in (parallel, gradient, newton):
    paper.main()
print("\n".join(f"{path.relative_to(ROOT)} {path.stat().st_size // 1024} KiB" for path in sorted(FOLDER.iterdir())))
