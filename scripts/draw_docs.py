#!/usr/bin/python3
"""Makes the figures of README.md and docs/ anew, from data that commands make in out/docs.

Usage: PYTHONPATH=build/release/python scripts/draw_docs.py [NAME...]

NAME is one or more of hip, pictures, cut, deformities, cohort (20 minutes of processor time), knee and examples; all if none
is given. Needs a release build with the example `example_deformity_curves`, matplotlib, and for knee and examples
python3-vtk9 and the data that CONDYLE_DATA names. Those of docs/images/bench are made by `make bench`.
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import condyle.plot as figures  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
from condyle import read_study  # noqa: E402
from condyle.plot.folder import drawings  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
OUT, IMAGES = ROOT / "out/docs", ROOT / "docs/images"
DPI = 200  # of screens, not of paper


def run(*command):
    subprocess.run([str(part) for part in command], check=True, cwd=ROOT, stdout=subprocess.DEVNULL)


def condyle(*arguments):
    run(ROOT / "build/release/condyle", *arguments)


def draw(folder, names, **options):
    """Figures of a folder under other names."""
    for name, figure in drawings(folder, **options):
        if name in names:
            save(figure(), names[name])


def save(drawn, name):
    figures.save(drawn, IMAGES / name, dpi=DPI)
    plt.close("all")
    print(f"docs/images/{name}")


def draw_hip():
    """By the commands of docs/figures.md."""
    condyle("sample", "hip", "--out", OUT / "sample")
    condyle("rom", OUT / "sample/hip.toml", "--band=40", "--out", OUT / "rom")
    condyle("rom", OUT / "sample/hip.toml", "--map", "flexion=0:130:5", "adduction=-40:30:5", "--out", OUT / "map")
    condyle("measure", OUT / "sample/hip.toml", "--out", OUT / "shape")
    draw(OUT / "shape", {"hip_shape": "hip_shape.png"})
    draw(OUT / "rom", {"limit_bands": "limits.png", "clock_face": "clock_face.png"})
    draw(OUT / "map", {"map_internal_rotation": "map_internal_rotation.png"})
    condyle("resect", OUT / "sample/hip.toml", "--reach", "fadir=48", "--curve", 0, "--out", OUT / "sheet_plan")
    sheet = figures.sheet([OUT / "rom", OUT / "sheet_plan", OUT / "shape"], case="Case 17", date="2026-11-27")
    figures.save(sheet[0], IMAGES / "sheet.png", dpi=100)
    print("docs/images/sheet.png")


def draw_pictures():
    condyle("sample", "hip", "--scenario", 3, "--out", OUT / "sample3")
    pose = ["--pose", "flexion=110 adduction=15 internal_rotation=35"]
    for name, options in (
        ("impingement", [*pose, "--field", "150", "--size", "600x560"]),
        (
            "impingement_femur",
            [*pose, "--view", "anterior-superior", "--hide", "fixed", "--field", "130", "--size", "700x560"],
        ),
        (
            "hip_measures",
            ["--measures", "--colour", "none", "--view", "anterior-lateral", "--field", "130", "--size", "700x560"],
        ),
    ):
        # A picture names its joint: from the repository's folder, wherever that is.
        condyle("picture", "out/docs/sample3/hip.toml", *options, "--out", IMAGES / f"{name}.png")
        print(f"docs/images/{name}.png")
    condyle("implant", "out/docs/sample3/hip.toml", "--out", OUT / "placed")
    condyle("picture", "out/docs/placed/hip.toml", "--colour", "none", "--field", "170", "--size", "700x560", "--out", IMAGES / "placed_implant.png")
    print("docs/images/placed_implant.png")
    # By the commands of docs/tutorial.md.
    condyle("sample", "hip", "--scenario", 3, "--voxel", 1, "--out", OUT / "scan")
    shutil.rmtree(OUT / "right", ignore_errors=True)
    condyle("init", "out/docs/scan/labels.nii.gz", "--task", "total", "--fixed", "hip_right", "--mobile", "femur_right", "--out", "out/docs/right/hip.toml")
    condyle("picture", "out/docs/right/hip.toml", "--colour", "gap", "--hide", "fixed", "--view", "anterior-medial-superior", "--field", "150", "--size", "800x600",
            "--out", IMAGES / "from_label_map.png")
    print("docs/images/from_label_map.png")


def draw_cut():
    """By the commands of docs/planning.md, of finer meshes."""
    condyle("sample", "hip", "--scenario", 3, "--alpha-angle", 70, "--out", OUT / "sample_cam")
    condyle("resect", "out/docs/sample_cam/hip.toml", "--reach", "internal_rotation_at_90_flexion=45", "--curve", 0,
            "--out", "out/docs/plan")
    shutil.copyfile(OUT / "plan/depth_mobile.png", IMAGES / "cut_femur.png")
    print("docs/images/cut_femur.png")


def draw_deformities():
    run(ROOT / "build/release/example_deformity_curves", OUT / "deformities")
    axes_of = (("alpha_angle", "alpha angle (°)"), ("lateral_centre_edge_angle", "lateral centre-edge angle (°)"))
    with figures.print_style():
        figure, both = plt.subplots(1, 2, sharey=True, layout="constrained", figsize=figures.size_mm(130, 52))
        for ax, (name, label) in zip(both, axes_of):
            curve = figures.files.read_curves(OUT / f"deformities/{name}.csv")
            ax.plot(curve[f"{name}_deg"], curve["internal_rotation_deg"], "o-")
            ax.set_xlabel(label)
            ax.set_ylim(0, 60)
            ax.grid(axis="y")
        both[0].set_ylabel("internal rotation\nat 90° flexion (°)")
    save(figure, "deformities.png")


def draw_cohort():
    """1,000 sample hips. Meshes that lie there are not made again."""
    if not (OUT / "cohort/cohort.csv").exists():
        condyle("sample", "cohort", "--n", 1000, "--seed", 1, "--meshes", "--out", OUT / "cohort")
    condyle("study", OUT / "cohort/cohort.csv", "--out", OUT / "study")
    study = read_study(OUT / "study")
    save(figures.limit_distributions(study), "cohort_limits.png")
    measures = (("bone_alpha_angle_deg", "alpha angle (°)"),
                ("lateral_centre_edge_angle_deg", "lateral centre-edge angle (°)"))
    with figures.print_style():
        figure, both = plt.subplots(1, 2, sharey=True, layout="constrained", figsize=figures.size_mm(160, 66))
        for ax, (measure, label) in zip(both, measures):
            figures.limit_against(study, measure, "internal_rotation_at_90_flexion", ax=ax, label=label)
        both[1].set_ylabel("")
    save(figure, "cohort_internal_rotation.png")


def knee_data():
    """Folder of the knee's data; also for those who ask the environment."""
    data = Path(os.environ.get("CONDYLE_DATA", ROOT.parent / "shared/data")) / "knee_lenhart2015_right"
    if not data.is_dir():
        sys.exit(f"{data}: not a folder: set CONDYLE_DATA")
    os.environ["CONDYLE_DATA"] = str(data.parent)
    return data


def knee_geometry():
    """The meshes that the knee's model names, made of those of the data."""
    geometry = OUT / "knee_geometry"
    run(sys.executable, knee_data().parent / "osim_lenhart2015/make_geometry.py", geometry)
    return geometry


def draw_knee():
    data, geometry = knee_data(), knee_geometry()
    for joint, name in (("knee_r", "tibiofemoral"), ("pf_r", "patellofemoral")):
        condyle("motion", data.parent / "osim_lenhart2015/lenhart2015.osim", "--joint", joint, "--geometry", geometry,
                "--motion", data / "passive_flexion_states.sto", "--load", "--maps", "--out", OUT / name)
        draw(OUT / name, {"pressure_map": f"{name}_pressure.png"}, frames=[0, 100, 250])


def draw_examples():
    for name, arguments in (("cam_and_internal_rotation", []), ("knee_over_motion", [knee_geometry()])):
        run("/usr/bin/python3", f"examples/python/{name}.py", *arguments, IMAGES / f"{name}.png")
        print(f"docs/images/{name}.png")
    run("/usr/bin/python3", "examples/python/deformable_cartilage.py", IMAGES / "python")
    print("docs/images/python")


DRAWN = {
    "hip": draw_hip,
    "pictures": draw_pictures,
    "cut": draw_cut,
    "deformities": draw_deformities,
    "cohort": draw_cohort,
    "knee": draw_knee,
    "examples": draw_examples,
}


if __name__ == "__main__":
    asked = sys.argv[1:] or list(DRAWN)
    if not set(asked) <= set(DRAWN):
        sys.exit(__doc__)
    for one in asked:
        DRAWN[one]()
