"""Draw all pictures and fill the pages."""

from quadrance.cores import ROOT

from ci.figures import FOLDER, diagrams, front, gradient, newton, parallel

for page in (diagrams, front, parallel, gradient, newton):
    page.main()
print("\n".join(f"{path.relative_to(ROOT)} {path.stat().st_size // 1024} KiB" for path in sorted(FOLDER.iterdir())))
