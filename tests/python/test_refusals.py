"""Lines of the command say the cause and the way out: of what was mistaken, and of limits as few as a reader needs."""

import os
import re
from pathlib import Path

import pytest
from common import refused, run_command

import condyle

QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
PERSON = "\n[person]\nweight = 80\n"
LIGAMENT = '\n[[ligament]]\nname = "a"\nfixed = [0, 40, 0]\nmobile = [0, -60, 0]\nslack_length = 90\nstifness_n = 3\n'

REFUSED = [
    ("touch labels.nii.gz femur.ply", "condyle surface labels.nii.gz --label NAME --out BONE.ply makes one of a label", 3),
    ("hip hip_bone.ply labels.nii.gz --out x", "condyle hip and condyle init take a label map of both bones", 3),
    ("touch quad.obj femur.ply", "unless polygons are to be split (--polygons split)", 3),
    ("hip quad.obj femur.ply --out x", "(--polygons split)", 3),
    ("hip femur.ply hip_bone.ply --out x", "are the bones exchanged? The hip bone comes first, then the femur", 4),
    ("hip labels.nii.gz --fixed 76 --mobile 78 --out x", "are the bones exchanged?", 4),
    ("init femur.ply femur.ply", "femur.ply and femur.ply are the same mesh", 2),
    ("hip labels.nii.gz --out x", "the image holds 76, 78; --task total would name femur_right and hip_right", 2),
    ("hip labels.nii.gz --task total_mr --out x", "in TotalSegmentator's total_mr: the image holds 76, 78; --task total would", 2),
    ("hip hip.toml --out x", "hip.toml: is a joint file, not a mesh: condyle rom hip.toml has its limits", 3),
    ("init hip.toml", "condyle rom hip.toml has its limits", 3),
    ("hip model.osim --out x", "is a model of OpenSim, not a mesh: condyle init model.osim --joint NAME", 3),
    ("resect hip.toml --reach fadir=+0", "fadir is to gain 0 degrees: a gain is above 0", 2),
    ("hip hip_bone.ply femur.ply --plan fadir=+0 --out x", "a gain is above 0", 2),
    ("hip hip_bone.ply femur.ply --plan fadir=200 --out x", "fadir cannot reach 200 degrees: its range is above 0 and at most 120", 2),
    ("resect hip.toml --reach fadir=+200", "and 200 more are 24", 2),
    ("hip hip_bone.ply femur.ply --plan fadir=+200 --out x", "beyond its range, 120", 2),
    ("hip hip_bone.ply femur.ply --out x --plan fadir=30 fadir=40", 'several targets of --plan stand in quotes, "fadir=30', 2),
    ("resect hip.toml --reach fadir=30 flexion=100", "several values of one option stand in quotes", 2),
    ("hip hip_bone.ply femur.ply --plan --out x", "--plan: needs a value, and the option --out comes after it", 2),
    ("rom hip.toml --motion --json", "--motion: needs a value, and the option --json", 2),
    ("rom person.toml", "unknown key; known here: age, sex", 3),
    ("rom ligament.toml", 'unknown key (did you mean "stiffness_n"?); known here: damping_n_s, ends_at_strain, fixed, mobile, name, '
     "point_sigma, slack_length, slack_share, slack_sigma, stiffness_n, taut_at, transition_strain, wrap", 3),
    ("rom hip.toml --write-limits a.osim --model hip.toml", "hip.toml: is no model of OpenSim", 2),
    ("report hip.toml --sheet x.pdf", "condyle hip makes a sheet", 2),
    ("surface labels.nii.gz", "--out FILE and --label are needed: in labels.nii.gz, the image holds 76, 78", 2),
    ("surface labels.nii.gz --out x.ply", "--label says which one is meant; the image holds 76, 78", 2),
    ("study hip.toml --out x", "hip.toml: is a joint file, not a table: condyle rom hip.toml has its limits", 3),
    ("sample hip --age 30", "condyle help sample hip has those there are", 2),
    ("help tuoch", "unknown command 'tuoch' (did you mean \"touch\"?)", 2),
    ("help sample hpi", "there is no sample 'hpi' (did you mean \"hip\"?)", 2),
]


@pytest.fixture(scope="module")
def files(sampled, tmp_path_factory) -> Path:
    folder: Path = sampled(tmp_path_factory.mktemp("files"), "hip", "--voxel", "2")
    (folder / "quad.obj").write_text(QUAD)
    (folder / "model.osim").write_text("")
    for name, more in (("person", PERSON), ("ligament", LIGAMENT)):
        (folder / f"{name}.toml").write_text((folder / "hip.toml").read_text() + more)
    return folder


@pytest.mark.parametrize(("words", "saying", "code"), REFUSED, ids=[words for words, _, _ in REFUSED])
def test_a_refusal_says_the_cause_and_the_way_out(words, saying, code, files):
    ran = run_command(*words.split(), check=False, cwd=files)
    refusals = [line for line in ran.stderr.splitlines() if not line.startswith("condyle: note: ")]
    assert (ran.returncode, len(refusals), ran.stdout) == (code, 1, ""), ran.stderr
    assert saying in refusals[0]
    assert not (files / "x").exists() or not list((files / "x").iterdir()), "the next run may have the folder"


def test_the_python_module_says_so_too(coarse_bones):
    joint = condyle.Joint(*coarse_bones)
    refused(lambda: joint.range_of_motion(age=39), re.escape('Joint(..., person={"age": 39})'))
    refused(lambda: joint.range_of_motion(aeg=39), "unexpected keyword argument 'aeg'", TypeError)


def test_the_text_of_limits_is_as_short_as_a_reader_needs(files, tmp_path):
    run = lambda *words: run_command(*words, cwd=tmp_path)
    bones = [[files / "hip_bone.ply", files / "femur.ply"],
             [files / "labels.nii.gz", "--task", "total", "--fixed", "hip_right", "--mobile", "femur_right"]]
    if data := os.environ.get("CONDYLE_DATA"):
        bones.append([Path(data) / "hip_vhf_right" / name for name in ("hip_bone.ply", "femur.ply")])
    for i, words in enumerate(bones):
        run("init", *words, "-o", f"{i}.toml")
        for options, most in (([], 24), (["--band=20"], 26)):
            ran = run("rom", f"{i}.toml", *options)
            assert len((ran.stderr + ran.stdout).splitlines()) <= most, ran.stderr + ran.stdout
            whole = run("rom", f"{i}.toml", *options, "--verbose").stdout
            assert "caveats, by studies of other hips:" in whole and ("centre  axes  surface" in whole) == bool(options)
