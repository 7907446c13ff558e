"""A range of motion says what `condyle rom --json` says: every key that both have, bit for bit."""

import pickle

import numpy as np
import pytest
from common import FREE, joint_file, json_of_command, refused, rows_of, run_command, text_of

import condyle
import condyle.plot
from test_parts import PARTS

def said_of(value):
    """A limit, or a value of one, as rom.json has it."""
    if isinstance(value, condyle.MotionLimit):
        return {key: said_of(each) for key, each in vars(value).items() if key not in ("motion", "soft_contact")}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, list):
        return [said_of(each) for each in value]
    return {key: said_of(value[key]) for key in value} if hasattr(value, "keys") else value


def require_same_limits(joint, rom, said):
    assert len(rom.limits) == len(said["motions"]) > 0
    for limit, theirs in zip(rom.limits, said["motions"]):
        assert said_of(limit) == theirs
        assert (limit.contact is None) == (theirs["features"] is None)
    assert rom.caveats == said["caveats"]
    assert [vars(note) for note in (*joint.notes, *rom.notes)] == said["notes"]


def require_same(joint, file, *options, **asked):
    """Python's answer and the command's."""
    rom, said = joint.range_of_motion(**asked), json_of_command("rom", file, *options)
    require_same_limits(joint, rom, said)
    for key in ("clock_plane", "held_translation_mm", "arcs", "normal_range_source", "scope"):
        assert getattr(rom, key) == said[key], key
    assert rom.implant == said.get("implant")
    bearing = said["bearing"]
    assert (rom.bearing_rule, rom.why_no_bearing) == (bearing["rule"], bearing.get("why_none", ""))
    if rom.bearing is not None:
        ours = dict(rom.bearing)
        assert {"centre_mm": ours.pop("head_centre").tolist(), "radius_mm": ours.pop("head_radius_mm")} == bearing["head"]
        assert ours.pop("triangles").sum() == bearing["triangles"]
        assert ours == {key: bearing.get(key) for key in ours}
    for limit in rom.limits:  # asked again by the tables that were kept
        assert said_of(rom.limit(limit.motion)) == said_of(limit)
    return rom


def test_the_sample_hip(hip, hip_file):
    rom = require_same(hip, hip_file)
    assert rom.clock_plane == "sagittal" and any(limit.clock_hour for limit in rom)
    rim = require_same(hip, hip_file, "--clock", "rim", clock="rim")
    assert rim.clock_plane == "rim" and [limit.clock_hour for limit in rim] != [limit.clock_hour for limit in rom]
    accepted = require_same(hip, hip_file, "--bearing", "count", "--accept-reference-contact", bearing="count", accept_reference_contact=True)
    assert len(accepted.caveats) == 1 and not rom.caveats
    left = require_same(hip, hip_file, "--exclude-reference-contacts", exclude_reference_contacts=True)
    assert left.caveats[0].startswith("left out:")
    again = pickle.loads(pickle.dumps(rom.limits))
    assert [said_of(limit) for limit in again] == [said_of(limit) for limit in rom]
    assert again == rom.limits and hash(again[0]) == hash(rom.limits[0]) and again[0] != again[1]
    vars(again[1])["contact_point_mm"] = np.nextafter(rom.limits[1].contact_point_mm, 100)
    assert again[1] != rom.limits[1]
    for act in (lambda: setattr(rom.limits[0], "limit_deg", 0), lambda: delattr(rom.limits[0], "limit_deg")):
        refused(act, kind=AttributeError)


@pytest.mark.filterwarnings("ignore::condyle.JointWarning", "ignore::condyle.JointRemark")
def test_a_label_map_that_its_image_cuts(sampled, tmp_path):
    sampled(tmp_path, "hip", "--scenario", "2", "--voxel", "1.5")
    labels = condyle.read_labels(tmp_path / "labels.nii.gz")
    to_lps = labels.lps_from_index
    first = round(-to_lps[2, 3] / 1.5) - 30
    voxels = labels.voxels()[:, :, first:first + 60].astype(np.uint8)
    directions = " ".join(str(tuple(column)) for column in to_lps[:3, :3].T.tolist())
    origin = tuple((to_lps @ [0, 0, first, 1])[:3].tolist())
    header = (f"NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {' '.join(map(str, voxels.shape))}\n"
              f"space directions: {directions}\nspace origin: {origin}\nencoding: raw\n\n")
    (tmp_path / "cut.nrrd").write_bytes(header.encode() + voxels.tobytes(order="F"))
    run_command("init", tmp_path / "cut.nrrd", "--fixed", "78", "--mobile", "76", "--side", "right", "-o", tmp_path / "cut.toml")
    joint = condyle.read_joint(tmp_path / "cut.toml")
    assert [note.code for note in joint.notes].count("cut_by_view") == 2
    require_same(joint, tmp_path / "cut.toml")


@pytest.mark.filterwarnings("ignore::condyle.JointRemark")
def test_an_implant(sampled, tmp_path):
    file = sampled(tmp_path, "replacement", "--bones", "none", "--facets", "60") / "hip.toml"
    rom = require_same(condyle.read_joint(file), file)
    assert rom.implant["why_no_closed_form"] if rom["flexion"].closed_form is None else rom.implant["half_angle_deg"] > 0
    assert all(limit.closed_form for limit in rom)


def test_an_implant_whose_meshes_are_not_those_of_its_sizes(sampled, tmp_path):
    file = sampled(tmp_path, "replacement", "--bones", "none", "--facets", "60") / "hip.toml"
    file.write_text(file.read_text().replace("neck_radius = 6", "neck_radius = 7"))
    with pytest.warns(condyle.JointRemark, match="differs_from_closed_form"):
        rom = require_same(condyle.read_joint(file), file)
    assert "differs_from_closed_form" in [note.code for note in rom.notes]


@pytest.mark.filterwarnings("ignore::condyle.JointWarning")
def test_parts_at_moved_values(default_bones, tmp_path):
    file = joint_file(tmp_path, PARTS, fixed=default_bones.hip_bone, mobile=default_bones.femur)
    moved = condyle.read_joint(file).with_parameters({"pelvis.tilt": 10, "femur.version": -8})
    require_same(moved, file, "--set", "pelvis.tilt=10", "--set", "femur.version=-8")


@pytest.mark.filterwarnings("ignore::condyle.JointWarning")
def test_a_shoulder(sampled, tmp_path):
    file = sampled(tmp_path, "reverse-shoulder") / "shoulder.toml"
    rom = require_same(condyle.read_joint(file), file)
    assert rom.clock_plane is None and {limit.clock_hour for limit in rom} == {None} and "superior" in [limit.contact_side for limit in rom]


def test_a_translation_that_is_held_and_one_that_follows(coarse_bones, tmp_path):
    joint_file(tmp_path, kind=FREE, fixed=coarse_bones.hip_bone, mobile=coarse_bones.femur)
    (tmp_path / "record.csv").write_text("time,flexion_deg,x_mm,y_mm\n" + "".join(f"{i * 0.1},{2 * i},{0.02 * i},{-0.01 * i}\n" for i in range(40)))
    joint = condyle.read_joint(tmp_path / "hip.toml")
    held = require_same(joint, tmp_path / "hip.toml", "--translation", "x=0.5 y=-0.25", translation_mm=[0.5, -0.25, 0])
    assert held.held_translation_mm == [0.5, -0.25, 0] and held.caveats[0].startswith("translation held at x 0.5")
    at = held["flexion"].contact.fixed_point
    assert held.free_angles("flexion").positive.contact.fixed_point.tolist() == at.tolist()
    assert held.zones(["flexion"])[0].limit.contact.fixed_point.tolist() == at.tolist()
    found = held.map({"adduction": (0, 1, 1)}, {"internal_rotation": (0, 1, 1)}, vary="flexion")
    assert found.positive.fixed_point[0, 0].tolist() == at.tolist()
    free = held.map({"x": (-1, 1, 1)}, {"flexion": (0, 90, 45)}, vary="y", held_deg={"adduction": 5})
    run_command("rom", tmp_path / "hip.toml", "--motion", "flexion", "--translation", "x=0.5 y=-0.25", "--map", "x=-1:1:1", "flexion=0:90:45", "adduction=5",
                "--vary", "y", "--out", tmp_path / "map")
    lines = rows_of(tmp_path / "map" / "map_intervals.csv")
    assert [[float(line["y_low_mm"]), float(line["y_high_mm"])] for line in lines] == (free.start_mm + free.intervals_mm).tolist()
    grid = condyle.plot.files.read_rom(tmp_path / "map")["grid"]
    assert grid.units == ("mm", "deg", "mm") and np.array_equal(grid.upper_deg, free.upper_mm) and not hasattr(free, "upper_deg")
    X_FM = joint.pose(flexion_deg=held["flexion"].limit_deg, x_mm=0.5, y_mm=-0.25)
    np.testing.assert_allclose((X_FM @ [*held["flexion"].contact.mobile_point, 1])[:3], at, atol=1e-9)
    free = condyle.Joint(*coarse_bones, kind="free", reference_pose={"x": 0.5, "y": -0.25})
    of_arrays = free.range_of_motion(["flexion"])
    of_arrays.write_report(tmp_path / "hip.html")
    shown, = text_of(tmp_path / "hip.html")["rom"]["motions"]
    assert shown["contact_point_mm"] == of_arrays["flexion"].contact.fixed_point.tolist()
    with pytest.warns(condyle.JointRemark, match="translation_ends"):
        found = joint.range_following(poses=joint.motion(tmp_path / "record.csv").X_FM)
    require_same_limits(joint, found, json_of_command("rom", tmp_path / "hip.toml", "--follow", tmp_path / "record.csv"))
