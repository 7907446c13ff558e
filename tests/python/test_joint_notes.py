"""What looks wrong with a joint is warned of at its first answer, and is what the command's JSON has."""

import pickle
import re
import warnings

import numpy as np
import pytest
from common import at_once, changed, json_of_command, refused, run_command, text_of, warnings_of

import condyle
from condyle.plot import sheet_text
from condyle.plot.case_files import read_case


@pytest.fixture
def left(coarse_bones):
    """A right hip that is said to be a left one."""
    return condyle.Joint(*coarse_bones, side="left", name="sample")


AT_ONE_POSE = ("penetration", "pairs", "in_contact", "gaps", "depths", "contact_measures", "normal_contact")
ANSWERS = {
    **{name: lambda joint, name=name: getattr(joint, name)(np.eye(4)) for name in AT_ONE_POSE},
    "tangential": lambda joint: joint.penetration(np.eye(4), "tangential"),
    "normal": lambda joint: joint.penetration(np.eye(4), "normal"),
    "arcs": lambda joint: joint.gaps(np.eye(4), "tangential"),
    "contact_along": lambda joint: joint.contact_along([np.eye(4)]),
    "recorded_contact": lambda joint: joint.recorded_contact([0, 1], [np.eye(4)] * 2),
    "range_of_motion": lambda joint: joint.range_of_motion(["flexion"]),
    "path_limit": lambda joint: joint.path_limit([{}, {"flexion": 1}]),
    "picture": lambda joint: joint.picture(np.eye(4), colour="none", width=64, height=64),
    "DepthRange": lambda joint: condyle.DepthRange(joint, 1.0),
}


@pytest.mark.parametrize("answer", ANSWERS)
def test_the_first_answer_warns_and_the_next_does_not(answer, left):
    first, = warnings_of(lambda: ANSWERS[answer](left))
    assert str(first.message).startswith("sample: wrong_side: the side is left, but ")
    assert first.filename == __file__, "the warning names the line that asked"
    for again in ANSWERS.values():
        assert warnings_of(lambda again=again: again(left)) == []


def test_nothing_is_looked_for_before_the_first_answer(left):
    assert warnings_of(lambda: (left.pose(flexion_deg=[10, 20]), left.coordinates(np.eye(4)), left.X_WF, repr(left),
                                left.processing, pickle.dumps(left))) == []
    assert left._notes is None
    refused(lambda: left.depths({"flexoin_deg": 1}))
    assert left._notes is None, "a refusal comes without a warning"


def test_a_warning_can_be_an_error(left):
    with warnings.catch_warnings():
        warnings.simplefilter("error", condyle.JointWarning)
        for _ in range(2):  # at each answer, as none was given
            refused(lambda: left.in_contact(np.eye(4)), "wrong_side", condyle.JointWarning)
    assert len(warnings_of(lambda: left.in_contact(np.eye(4)))) == 1


def test_what_strict_lets_pass_is_a_remark(sampled, tmp_path):
    file = sampled(tmp_path, "hip", "--alpha-angle", "70") / "hip.toml"
    run_command("resect", file, "--reach", "internal_rotation_at_90_flexion=45", "--curve", "0", "--strict")
    with warnings.catch_warnings():
        warnings.simplefilter("error", condyle.JointWarning)
        with pytest.warns(condyle.JointRemark, match="no_gain"):
            condyle.read_joint(file).resection({"internal_rotation_at_90_flexion": 45}, curve_points=0, band_samples=0)
    assert not issubclass(condyle.JointRemark, condyle.JointWarning)


def test_notes_of_limits_are_known_by_their_codes(source):
    codes = re.search(r"enum class RangeNoteCode.*?{(.*?)^};", (source / "include/condyle/answer/range.hpp").read_text(), re.DOTALL | re.MULTILINE)
    assert set(re.findall(r"^  (\w+),", codes[1], re.MULTILINE)) == condyle._contact_checks.OF_LIMITS


def test_a_joint_that_is_right_warns_of_nothing(hip):
    assert hip.notes == () and warnings_of(lambda: hip.in_contact(np.eye(4))) == []


def test_threads_are_warned_once(left):
    assert len(warnings_of(lambda: at_once(8, lambda: left.in_contact(np.eye(4))))) == 1


def test_whoever_shows_a_warning_may_ask_the_joint(left):
    seen = []
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = lambda message, *rest, **more: seen.append((message, left.in_contact(np.eye(4))))
        left.in_contact(np.eye(4))
    assert len(seen) == 1


def test_a_name_is_printed_in_one_line(coarse_bones):
    joint = condyle.Joint(*coarse_bones, side="left", name="a\n\x1b[31mb")
    said, = warnings_of(lambda: joint.in_contact(np.eye(4)))
    assert str(said.message).isprintable()


def test_notes_and_processing_are_those_of_the_json(hip_file, tmp_path):
    path = changed(hip_file, tmp_path, ('side = "right"', 'side = "left"'), ("[0.0, 0.0, 0.0]", '"fit"'))
    said, joint = json_of_command("frame", path), condyle.read_joint(path)
    assert [(note["code"], note["text"]) for note in said["notes"]] == [(each.code, each.text) for each in joint.notes]
    assert joint.notes and said["processing"] == list(joint.processing) != []


def test_a_study_warns_of_its_joints(hip_file, tmp_path):
    (tmp_path / "table.csv").write_text(f"id,fixed,mobile,side\nhip7,{hip_file.parent}/hip_bone.ply,{hip_file.parent}/femur.ply,left\n")
    said, = warnings_of(lambda: condyle.run_study(tmp_path / "table.csv", tmp_path / "out", motions=["flexion"]))
    assert str(said.message) == "hip7: wrong_side"


LEFT_OUT = {"pieces_left_out": "hip bone is in 2 pieces: 900 mm3 are left out", "gap_in_bone": "2 pieces of hip bone are one bone",
            "interpolated_labels": "31 % of the border of hip bone is one voxel thick", "two_affines": "voxels are placed in two ways",
            "two_voxel_sizes": "voxels have two sizes", "unknown_units": "no unit of length", "more_bytes": "the file holds 2 bytes more",
            "simplified_away": "hip bone was simplified", "touching": "hip bone and femur touch at 3 faces of voxels"}
"""What a label map can leave out of a bone or in doubt; thick_slices follows from its voxels."""


def test_what_a_map_leaves_out_stands_in_every_document(sampled, tmp_path):
    file = sampled(tmp_path, "hip") / "hip.toml"
    notes = "".join(f'[[fixed.image.note]]\ncode = "{code}"\ntext = "{text}"\n' for code, text in LEFT_OUT.items())
    file.write_text(f"{file.read_text()}\n[fixed.image]\nvoxel_i = [1, 0, 0]\nvoxel_j = [0, 1, 0]\nvoxel_k = [0, 0, 5]\n{notes}")
    joint = condyle.read_joint(file)
    said = {note.code: note.text for note in joint.notes}
    assert set(said) == {*LEFT_OUT, "thick_slices"} and LEFT_OUT.items() <= said.items()

    (tmp_path / "walk.csv").write_text("time,flexion_deg\n0,0\n1,1\n")
    (tmp_path / "table.csv").write_text("id,joint\na,hip.toml\n")
    asked = {"rom": ["--motion", "flexion", "--out", "case/limits"], "measure": ["--out", "case/measures"], "depth": [], "frame": [],
             "resect": ["--reach", "flexion=+2", "--curve", "0", "--margin", "1", "--out", "case/plan"], "motion": ["--motion", "walk.csv", "--out", "walk"],
             "report": ["--out", "hip.html"], "picture": ["--out", "hip.png"]}
    for name, more in asked.items():
        ran = run_command(name, "hip.toml", *more, cwd=tmp_path)
        assert all(code in ran.stderr for code in said), name
        strict = run_command(name, "hip.toml", "--strict", *more, check=False, cwd=tmp_path)
        assert strict.returncode == 4 and all(code in strict.stderr for code in said), name
    for name in ("depth", "frame", "rom", "measure"):
        assert said.items() <= {note["code"]: note["text"] for note in json_of_command(name, file)["notes"]}.items(), name
    run_command("study", "table.csv", "--motion", "flexion", "--out", "study", cwd=tmp_path)
    assert set(said) <= set(re.search("^a,.*", (tmp_path / "study" / "hips.csv").read_text(), re.MULTILINE)[0].replace(",", " ").split())

    for document in ("limits/rom.json", "limits/limits.csv", "measures/measures.json", "measures/measures.csv", "plan/resection.json",
                     "plan/limits.csv", "../walk/motion.json"):
        text = (tmp_path / "case" / document).read_text()
        assert all(each in text for each in said.values()), document
    page = str(text_of(tmp_path / "hip.html"))
    assert all(each in page for each in said.values())
    sheet = [note.text.lower() for note in sheet_text.notes(read_case([tmp_path / "case" / part for part in ("limits", "measures", "plan")]))]
    assert all(any(each.lower() in line for line in sheet) for each in said.values())
