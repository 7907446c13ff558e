"""Answers of the module that is imported, as text, for the wheel's to be held against the built one's: wheel_answers.py README
FIGURE. Where matplotlib is missing, what `import condyle.plot` says of it."""

import hashlib
import importlib.metadata
import os
import re
import sys
import tempfile
from pathlib import Path

import condyle

readme, figure = map(Path, sys.argv[1:])
code, = re.findall(r"```python\n(.*?)```", readme.read_text(encoding="utf-8"), re.DOTALL)
exec(compile(code, "README.md", "exec"), {})

bones = condyle.sample_hip(scenario=2)
joint = condyle.Joint(bones.hip_bone, bones.femur)
limits = joint.range_of_motion()
print(*(limit.limit_deg for limit in limits.limits))
print(joint.depths({"flexion_deg": 140}).max_depth_mm)
print(hashlib.sha256(joint.picture({"flexion_deg": 140}).tobytes()).hexdigest())
with tempfile.TemporaryDirectory() as folder:
    table = Path(folder) / "hips.csv"
    table.write_text("id,sample\na,1\n", encoding="utf-8")
    condyle.run_study(table, Path(folder) / "out", motions=["flexion"])
    print(*(hashlib.sha256((Path(folder) / "out" / name).read_bytes()).hexdigest() for name in ("limits.csv", "study.h5")))
print(condyle.__version__)

# Lines that are no answers are kept apart: where the module comes from, what is loaded, and whether figures can be drawn.
print("module", condyle.__file__, file=sys.stderr)
try:
    print("installed", importlib.metadata.version("condyle"), file=sys.stderr)
except importlib.metadata.PackageNotFoundError:
    pass
for path in sorted(set(re.findall(r"/\S+\.so\S*$", Path("/proc/self/maps").read_text(), re.MULTILINE))):
    print("loaded", path, file=sys.stderr)
try:
    import condyle.plot as figures
except ImportError as error:
    print("no figures:", error, file=sys.stderr)
else:
    os.environ.setdefault("MPLBACKEND", "Agg")
    figures.save(figures.limits(limits), figure)
    print("drawn", figure, file=sys.stderr)
