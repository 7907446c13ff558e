"""Ligaments of joint files: what Python says of them is what the command does."""

import json
import os
import pickle
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from common import changed, json_of_command, refused, rows_of, run_command

import condyle

BALL = {"shape": "sphere", "body": "mobile", "centre": [0, 0, 0], "radius": 24}
FRONT = {"name": "front", "fixed": [30, 28, 8], "mobile": [[12, -60, 30], [12, -38, 30]], "slack_share": 1.0, "ends_at_strain": 0.06, "wrap": BALL}
BACK = {"name": "back", "fixed": [-28, -15, 10], "mobile": [2, 5, 48], "slack_length": 50, "stiffness_n": 800, "transition_strain": 0.04}


def toml(value):
    return "{ " + ", ".join(f"{key} = {toml(each)}" for key, each in value.items()) + " }" if isinstance(value, dict) else json.dumps(value)


def in_a_file(*ligaments):
    return "".join("\n[[ligament]]\n" + "".join(f"{key} = {toml(value)}\n" for key, value in each.items()) for each in ligaments)


@pytest.fixture(scope="module")
def file(hip_file, tmp_path_factory):
    return changed(hip_file, tmp_path_factory.mktemp("ligaments"), more=in_a_file(FRONT, BACK))


@pytest.fixture(scope="module")
def joint(file):
    return condyle.read_joint(file)


def test_a_joint_has_those_of_its_file(joint):
    front, back = joint.ligaments
    assert (front.name, back.name) == ("front", "back")
    assert front.mobile.tolist() == [[12, -60, 30], [12, -38, 30]]
    assert front.wrap.shape == "sphere" and front.wrap.radius_mm == 24
    assert front.ends_at_strain == 0.06 and back.ends_at_strain is None
    assert (back.slack_length_mm, back.stiffness_n, back.transition_strain) == (50, 800, 0.04)
    assert condyle.Joint.from_file.__doc__ is not None
    assert [each.name for each in pickle.loads(pickle.dumps(joint)).ligaments] == ["front", "back"]


def test_joints_of_meshes_take_them_by_the_keys_of_the_file(joint):
    given = [{**FRONT, "mobile": np.array(FRONT["mobile"])}, {**BACK, "fixed": tuple(BACK["fixed"])}]
    same = condyle.Joint(joint.fixed, joint.mobile, reference_pose={}, ligaments=given)
    for ours, theirs in zip(same.ligaments, joint.ligaments):
        assert (ours.name, ours.slack_length_mm, ours.fixed.tolist()) == (theirs.name, theirs.slack_length_mm, theirs.fixed.tolist())
    assert [limit.ligament for limit in same.range_of_motion().limits] == [limit.ligament for limit in joint.range_of_motion().limits]
    for wrong, why in (([{"name": "a"}], "ligament.0..fixed: is missing"), ({"name": "a"}, "a list of mappings"),
                       ([{**given[1], "slack": 3}], "unknown key"), ([{**given[1], "stiffness_n": float("nan")}], "finite")):
        refused(lambda: condyle.Joint(joint.fixed, joint.mobile, ligaments=wrong), why)


def test_states_follow_from_points_and_slack_length(joint):
    poses = joint.pose(flexion_deg=[0, 20, 40], abduction_deg=10)
    states = joint.ligament_states(poses)
    assert states.names == ("front", "back")
    assert states.strain.shape == (2, 3) and states.force_n.shape == (2, 3, 3)
    for k, X in enumerate(poses):
        end = X[:3, :3] @ joint.ligaments[1].mobile[0] + X[:3, 3]
        along = end - joint.ligaments[1].fixed[0]
        length = np.linalg.norm(along)
        strain = length / 50 - 1
        tension = 0 if strain < 0 else 800 * strain**2 / 0.08 if strain < 0.04 else 800 * (strain - 0.02)
        assert states.length_mm[1, k] == pytest.approx(length, rel=1e-14)
        assert states.tension_n[1, k] == pytest.approx(tension, rel=1e-12)
        np.testing.assert_allclose(states.force_n[1, k], -tension * along / length, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(states.moment_nmm[1, k], np.cross(end, states.force_n[1, k]), rtol=1e-12, atol=1e-9)
    one = joint.ligament_states(poses[1])
    assert one.strain.tolist() == states.strain[:, 1].tolist()
    gap = poses.copy()
    gap[0] = np.nan
    assert np.isnan(joint.ligament_states(gap).strain[:, 0]).all()


def test_stiffness_is_the_change_of_force_and_moment(joint):
    poses = joint.pose(flexion_deg=[20, 40])
    stiffness = joint.ligament_stiffness(poses)
    assert stiffness.shape == (2, 2, 6, 6)
    for k, X in enumerate(poses):
        for axis in range(3):
            ahead, behind = X.copy(), X.copy()
            ahead[axis, 3] += 1e-3
            behind[axis, 3] -= 1e-3
            force = [joint.ligament_states(at).force_n for at in (ahead, behind)]
            np.testing.assert_allclose(stiffness[:, k, :3, axis], (force[1] - force[0]) / 2e-3, rtol=1e-5, atol=1e-5)
    gap = poses.copy()
    gap[0] = np.nan
    assert np.isnan(joint.ligament_stiffness(gap)[:, 0]).all()


def test_limits_name_the_ligament_that_ends_them_as_the_command_does(joint, file):
    said = json_of_command("rom", file)
    rom = joint.range_of_motion()
    ended = [limit for limit in rom.limits if limit.reason == "ligament"]
    assert ended and all(limit.ligament == "front" and limit.contact is None for limit in ended)
    for theirs, ours in zip(said["motions"], rom.limits):
        assert (theirs["limit_deg"], theirs["reason"], theirs["ligament"]) == (ours.limit_deg, ours.reason, ours.ligament)
    for limit in ended:
        at = joint.ligament_states(joint.pose(**{f"{name}_deg": value for name, value in limit.at_limit_deg.items()}))
        assert at.strain[0] == pytest.approx(0.06, abs=1e-12)


def test_the_command_writes_the_same_states_along_a_motion(joint, file, tmp_path):
    flexion = [0, 15, 30, 45]
    motion = tmp_path / "walk.csv"
    motion.write_text("time,flexion_deg\n" + "".join(f"{i},{value}\n" for i, value in enumerate(flexion)))
    run_command("motion", file, "--motion", motion, "--out", tmp_path / "walk")
    rows = rows_of(tmp_path / "walk" / "ligaments.csv")
    states = joint.ligament_states(joint.pose(flexion_deg=flexion))
    for k, row in enumerate(rows):
        for i, name in enumerate(states.names):
            assert float(row[f"{name}_length_mm"]) == states.length_mm[i, k]
            assert float(row[f"{name}_tension_n"]) == states.tension_n[i, k]
        in_mobile = joint.pose(flexion_deg=flexion)[k, :3, :3].T @ states.force_n[:, k].sum(axis=0)
        assert float(row["ligaments_force_in_mobile_y_n"]) == pytest.approx(in_mobile[1], abs=1e-12)
    said = json.loads((tmp_path / "walk" / "motion.json").read_text())
    assert [each["name"] for each in said["ligaments"]] == ["front", "back"]
    assert said["ligaments"][1]["largest_tension_n"]["value"] == states.tension_n[1].max()


DAMPED = FRONT, {**BACK, "damping_n_s": 40}


def test_damping_follows_from_strain_and_speed(file):
    joint = condyle.read_joint(with_strings(file, *DAMPED))
    front, back = joint.ligaments
    assert (front.damping_n_s, back.damping_n_s) == (0, 40)
    poses = joint.pose(flexion_deg=[0, 20, 40], abduction_deg=10)
    still = joint.ligament_states(poses)
    assert still.damping_n is still.total_n is still.lengthening_mm_s is None
    v, w = np.array([[3, -20, 5.0], [np.nan, 0, 0], [0, 30, 80]]), np.array([[0, 0.1, -0.5]] * 3)
    states = joint.ligament_states(poses, velocity_mm_s=v, angular_velocity_rad_s=w)
    assert states.damping_n.shape == (2, 3) and np.isnan(states.total_n[:, 1]).all()
    damped = 0
    for k in (0, 2):
        end = poses[k, :3, :3] @ back.mobile[0] + poses[k, :3, 3]
        along = end - back.fixed[0]
        speed = along @ (v[k] + np.cross(w[k], poses[k, :3, :3] @ back.mobile[0])) / np.linalg.norm(along)
        assert states.lengthening_mm_s[1, k] == pytest.approx(speed, rel=1e-12)
        x = min(states.strain[1, k] / 0.01, 1)
        damping = 40 * speed / 50 * (10 * x**3 - 15 * x**4 + 6 * x**5) if x > 0 and speed > 0 else 0
        assert states.damping_n[1, k] == pytest.approx(damping, rel=1e-12)
        damped += damping > 0
    assert damped and (states.damping_n[0, [0, 2]] == 0).all()
    np.testing.assert_array_equal(states.total_n[:, [0, 2]], (states.tension_n + states.damping_n)[:, [0, 2]])
    one = joint.ligament_states(poses[0], velocity_mm_s=v[0], angular_velocity_rad_s=w[0])
    assert one.total_n.tolist() == states.total_n[:, 0].tolist()
    for wrong in ({"velocity_mm_s": v}, {"velocity_mm_s": v[:2], "angular_velocity_rad_s": w}, {"time_s": [0, 1]}, {"time_s": [0, 2, 1]},
                  {"time_s": [0, 1, 2], "velocity_mm_s": v, "angular_velocity_rad_s": w}):
        refused(lambda: joint.ligament_states(poses, **wrong))


def test_the_command_damps_by_the_frames_or_by_the_speeds_of_the_file(file, tmp_path):
    path = with_strings(file, *DAMPED, more='[recorded_motion]\nflexion = { column = "bend", sign = -1 }\nadduction = "tilt"\n')
    joint = condyle.read_joint(path)
    time = np.arange(0, 1.01, 0.1)
    value = np.column_stack([-np.sin(time), 0.2 * np.cos(3 * time)])
    speed = np.column_stack([-np.cos(time), -0.6 * np.sin(3 * time)])
    with_speeds, without = tmp_path / "with.sto", tmp_path / "without.sto"
    for name, columns in ((with_speeds, [time, value[:, 0], speed[:, 0], value[:, 1], speed[:, 1]]), (without, [time, *value.T])):
        names = ["/j/k/bend/value", "/j/k/bend/speed", "/j/k/tilt/value", "/j/k/tilt/speed"]
        names = names if name == with_speeds else names[::2]
        rows = ["\t".join(map(repr, map(float, row))) for row in np.column_stack(columns)]
        name.write_text("inDegrees=no\nendheader\n" + "\n".join(["\t".join(["time", *names]), *rows]) + "\n")
        run_command("motion", path, "--motion", name, "--out", name.with_suffix(""))
    for name, source in ((with_speeds, "recorded"), (without, "frames")):
        folder = name.with_suffix("")
        motion = joint.motion(name)
        velocities = {"time_s": motion.time} if source == "frames" else {
            "velocity_mm_s": motion.velocity_mm_s, "angular_velocity_rad_s": motion.angular_velocity_rad_s}
        assert (motion.velocity_mm_s is None) == (source == "frames")
        states = joint.ligament_states(motion.X_FM, **velocities)
        rows = rows_of(folder / "ligaments.csv")
        said = json.loads((folder / "motion.json").read_text())
        assert said["ligament_speeds_from"] == source
        assert said["ligaments"][1]["largest_total_n"]["value"] == states.total_n[1].max()
        for column, of in (("lengthening_mm_s", states.lengthening_mm_s), ("damping_n", states.damping_n), ("total_n", states.total_n)):
            assert [float(row[f"back_{column}"]) for row in rows] == of[1].tolist()
        sto = condyle.read_motion_table(folder / "ligaments.sto").columns
        np.testing.assert_array_equal(sto["back.force_total"], states.total_n[1])
        np.testing.assert_array_equal(sto["back.force_damping"], states.damping_n[1])
        np.testing.assert_allclose(sto["back.lengthening_speed"], states.lengthening_mm_s[1] / 1000, rtol=1e-15)
        assert states.damping_n[1].max() > 1
    # The speeds are those of the curve, to the error of differences over 1e-4 s.
    motion = joint.motion(with_speeds)
    exact = joint.ligament_states(motion.X_FM, velocity_mm_s=motion.velocity_mm_s, angular_velocity_rad_s=motion.angular_velocity_rad_s)
    beside = [joint.ligament_states(joint.pose(flexion_deg=np.degrees(np.sin(time + by)), adduction_deg=np.degrees(0.2 * np.cos(3 * (time + by)))))
              for by in (-1e-4, 1e-4)]
    np.testing.assert_allclose(exact.lengthening_mm_s, (beside[1].length_mm - beside[0].length_mm) / 2e-4, atol=1e-4)


def test_what_contradicts_the_bones_stands_in_every_answer(file, tmp_path):
    path = with_strings(file, {"name": "off", "fixed": [30, 28, 8], "mobile": [12, -38, 330], "slack_share": 105, "wrap": {
        "shape": "ellipsoid", "body": "mobile", "centre": [0, 0, 0], "radii": [1, 1, 1], "axes": [[1, 0, 0], [0, 1, 0]]}})
    joint = condyle.read_joint(path)
    codes = ["ligament_off_bone", "unlikely_strain"]
    assert [note.code for note in joint.notes] == codes
    with pytest.warns(condyle.JointWarning, match="ligament_off_bone: ligament off: its mobile end is"):
        assert joint.ligament_states(np.eye(4)).notes == ()
    (tmp_path / "walk.csv").write_text("time,flexion_deg\n0,0\n1,15\n")
    (tmp_path / "hips.csv").write_text(f"id,joint\na,{path}\n")
    for words in (["rom"], ["motion", "--motion", tmp_path / "walk.csv"], ["depth", "--pose", "flexion=10"], ["measure"]):
        said = json_of_command(words[0], path, *words[1:])
        assert [note["code"] for note in said["notes"] if "ligament" in note["text"]] == codes, words
        strict = run_command(words[0], path, *words[1:], "--strict", check=False)
        assert strict.returncode == 4 and "ligament off: its mobile end is" in strict.stderr
    run_command("study", tmp_path / "hips.csv", "--out", tmp_path / "study")
    assert rows_of(tmp_path / "study" / "hips.csv")[0]["notes"].split() == codes


def test_lengths_that_are_not_known_and_strains_that_nothing_bears_are_noted(joint):
    given = {"name": "a", "fixed": [30, 28, 8], "mobile": [12, -38, 30], "slack_length": 60}
    round_it = {"wrap": {**BALL, "centre": [12, -38, 30], "radius": 9}}
    for more, code in ((round_it, "unknown_ligament_length"), ({"slack_length": 50}, "unlikely_strain")):
        other = condyle.Joint(joint.fixed, joint.mobile, reference_pose={}, ligaments=[{**given, **more}])
        for ask in (other.ligament_states, other.ligament_stiffness):
            with pytest.warns(condyle.JointWarning, match=code):
                ask(other.pose(extension_deg=[0, 60]))
        assert [note.code for note in other.ligament_states(other.pose(extension_deg=60)).notes] == [code]


def test_what_does_not_look_for_ligaments_refuses_them(joint, file):
    for words, line in ((["rom", file, "--allow-depth", "1"], "ligament front ends motions"),
                        (["load", file, "--ligaments", "--e", "10", "--nu", "0.45", "--thickness", "2"], "--ligaments: needs a force")):
        done = run_command(*words, check=False)
        assert done.returncode == 2 and line in done.stderr
    refused(lambda: joint.path_limit([{"flexion": 0}, {"flexion": 20}]), "ligament front ends motions, which a path")


def with_strings(file, *ligaments, more=""):
    text = in_a_file(*ligaments) + more
    path = file.with_name(f"other_{abs(hash(text))}.toml")
    path.write_text(file.read_text().split("\n[[ligament]]")[0] + text)
    return path


def test_no_bone_goes_for_a_target_that_a_ligament_makes_unreachable(file):
    # Bone ends adduction at 33 degrees, the ligament at 35.
    path = with_strings(file, {"name": "lateral", "fixed": [5, 40, 35], "mobile": [5, -5, 45], "slack_length": 66.58470329263,
                               "ends_at_strain": 0.05})
    joint = condyle.read_joint(path)
    assert joint.range_of_motion(["adduction"]).limits[0].reason == "contact"
    refused(lambda: joint.resection({"adduction": 40}), "ligament lateral ends adduction at 35 degrees", condyle.MeshError)
    assert joint.resection({"adduction": 34}, band_samples=0).targets[0].after.limit_deg >= 34


def test_a_band_does_not_look_for_lengths_beyond_the_contact_that_ends_a_motion(file):
    path = with_strings(file, {
        "name": "long", "fixed": [26.21681052, -17.79178854, 7.90460216], "mobile": [-28.92712403, 34.64839752, 31.8405042], "slack_share": 2,
        "ends_at_strain": 0.2, "wrap": {**BALL, "centre": [3.78365306, 4.38717379, 7.681818], "radius": 25}})
    run_command("rom", path, "--motion", "adduction", "--band=20")


GRID = ["--map", "flexion=-60:0:30", "adduction=-20:20:20"]

TWO_ENDING = ({"name": "front, long", "fixed": [30, 28, 8], "mobile": [12, -38, 30], "slack_share": 1.05, "ends_at_strain": 0.1, "wrap": BALL},
              {"name": "back", "fixed": [-28, -15, 10], "mobile": [2, 5, 48], "slack_share": 1.1, "ends_at_strain": 0.1})


def test_a_map_names_the_ligament_of_each_end(file, tmp_path):
    path = with_strings(file, *TWO_ENDING)
    run_command("rom", path, "--motion", "flexion", *GRID, "--out", tmp_path, "--ascii")
    joint = condyle.read_joint(path)
    found = joint.range_of_motion([]).map({"flexion": (-60, 0, 30)}, {"adduction": (-20, 20, 20)})
    assert found.ligaments == ("front, long", "back")
    rows = rows_of(tmp_path / "map.csv")
    named = set()
    for i, row in enumerate(rows):
        for side, ends, sign in (("lower", found.negative, -1), ("upper", found.positive, 1)):
            which = ends.ligament.ravel()[i]
            assert row[f"{side}_ligament"] == ("" if which < 0 else found.ligaments[which])
            assert (row[f"{side}_reason"] in ("ligament", "strained_at_start")) == (which >= 0)
            if row[f"{side}_reason"] != "ligament":
                continue
            # It is at its strain there, and no other is beyond it.
            at = joint.ligament_states(joint.pose(flexion_deg=float(row["flexion_deg"]), adduction_deg=float(row["adduction_deg"]),
                                                  internal_rotation_deg=sign * ends.turned_deg.ravel()[i]))
            assert at.strain[which] == pytest.approx(0.1, abs=1e-9) and at.strain.max() < 0.1 + 1e-9
            named.add(row[f"{side}_ligament"])
    assert named == {"front, long", "back"}
    # Free intervals name theirs too, and map.vtp numbers them.
    intervals = rows_of(tmp_path / "map_intervals.csv")
    assert {row["low_ligament"] for row in intervals} | {row["high_ligament"] for row in intervals} >= named
    vtp = (tmp_path / "map.vtp").read_text()
    assert 'Name="lower_ligament"' in vtp and 'Name="upper_ligament"' in vtp and 'Name="interval_low_ligament"' in vtp


def test_a_study_counts_the_points_of_a_map_that_ligaments_end(file, tmp_path):
    path = with_strings(file, *TWO_ENDING)
    (tmp_path / "hips.csv").write_text(f"id,joint\na,{path}\n")
    run_command("study", tmp_path / "hips.csv", *GRID, "--out", tmp_path / "study")
    run_command("rom", path, "--motion", "flexion", *GRID, "--out", tmp_path / "rom")
    hip, = rows_of(tmp_path / "study" / "hips.csv")
    points = rows_of(tmp_path / "rom" / "map.csv")
    for end in ("lower", "upper"):
        counts = {reason: int(hip[f"map_{end}_{reason}_points"]) for reason in condyle.REASONS}
        assert counts == {reason: sum(point[f"{end}_reason"] == reason for point in points) for reason in condyle.REASONS}
        assert sum(counts.values()) == int(hip["map_points"]) == len(points)
    assert int(hip["map_lower_ligament_points"]) + int(hip["map_upper_ligament_points"]) > 0


DATA = Path(os.environ["CONDYLE_DATA"])
KNEE = DATA / "osim_lenhart2015"


@pytest.mark.skipif(not (KNEE / "make_geometry.py").exists(), reason="no published knee in CONDYLE_DATA")
def test_without_its_anterior_cruciate_a_knee_goes_farther_and_strains_what_is_left(tmp_path):
    subprocess.run([sys.executable, KNEE / "make_geometry.py", tmp_path / "Geometry"], check=True, capture_output=True)

    def without(*names):
        """Of the published model, made into a joint: ligaments whose names begin so are taken out of it."""
        pattern = rf'<Blankevoort1991Ligament name="(?:{"|".join(names)})[^"]*">.*?</Blankevoort1991Ligament>'
        text, count = re.subn(pattern, "", (KNEE / "lenhart2015.osim").read_text(), flags=re.S)
        assert count
        model = tmp_path / f"without_{'_'.join(names)}.osim"
        model.write_text(text)
        run_command("init", model, "--joint", "knee_r", "-o", model.with_suffix(".toml"))
        found = json_of_command("load", model.with_suffix(".toml"), "--pose", "flexion=10", "--force", "50", "0", "0", "--ligaments")
        assert found["balance"]["outcome"] == "balanced"
        return found["balance"]["moved_mm"][0], {each["name"]: each for each in found["ligaments"]}

    # Over an ellipsoid the superficial medial and the oblique ligament have no length.
    moved, strings = without("MCLs", "MCLp")
    farther, left = without("MCLs", "MCLp", "ACL")
    assert set(strings) - set(left) == {name for name in strings if name.startswith("ACL")} and len(left) == 32
    assert farther > moved + 5
    # What else holds the tibia back: the deep medial ligament and the capsule behind.
    for name in left:
        if name.startswith(("MCLd", "pCAP")):
            assert left[name]["strain"] > strings[name]["strain"], name
    assert sum(each["tension_n"] for each in left.values()) > 2 * sum(strings[name]["tension_n"] for name in left)

    # Contact, ligaments and load of a motion are in one frame, which the columns name, and add up to nothing.
    (tmp_path / "bent.mot").write_text("inDegrees=yes\nendheader\ntime knee_flex_r\n0 10\n")
    for body in ("mobile", "fixed"):
        run_command("motion", tmp_path / "without_MCLs_MCLp.toml", "--motion", tmp_path / "bent.mot", "--force", "50", "0", "0", "--ligaments",
                    "--casting", body, "--out", tmp_path / body)
        table = {name: value for file in ("curves", "ligaments") for name, value in rows_of(tmp_path / body / f"{file}.csv")[0].items()}
        for axis in "xyz":
            forces = [float(table[f"{of}force_in_{body}_{axis}_n"]) for of in ("", "load_", "ligaments_")]
            assert abs(sum(forces)) < 2e-6 and np.abs(forces).max() > 1, (body, axis, forces)  # of each force 1e-6 N may be left


def test_a_load_moves_the_frames_so_that_their_speeds_are_not_those_of_the_file(sampled, tmp_path):
    folder = sampled(tmp_path / "cartilages", "cartilages", "--clearance", "-0.3")
    joint = folder / "cartilages.toml"
    string = {"name": "string", "fixed": [0, 60, 0], "mobile": [0, -30, 0], "slack_length": 80, "damping_n_s": 2}
    joint.write_text(joint.read_text() + in_a_file(string) + '\n[recorded_motion]\nflexion = "bend"\n')
    (tmp_path / "s.sto").write_text("inDegrees=yes\nendheader\ntime\t/j/k/bend/value\t/j/k/bend/speed\n0\t0\t-7\n1\t3\t-7\n2\t6\t-7\n")
    said = {}
    for name, load in (("still", ["--load"]), ("loaded", ["--force", "0", "1500", "0"])):
        said[name] = json_of_command("motion", joint, "--motion", tmp_path / "s.sto", *load, "--e", "12", "--nu", "0.42", "--thickness", "1.5",
                                     "--out", tmp_path / name)["ligament_speeds_from"]
    assert said == {"still": "recorded", "loaded": "frames"}
    rows = {name: rows_of(tmp_path / name / "ligaments.csv") for name in said}
    length = [float(row["string_length_mm"]) for row in rows["loaded"]]
    # Three frames a second apart: in the middle half the difference.
    assert float(rows["loaded"][1]["string_lengthening_mm_s"]) == pytest.approx((length[2] - length[0]) / 2, rel=2e-2)
    assert float(rows["still"][1]["string_lengthening_mm_s"]) * float(rows["loaded"][1]["string_lengthening_mm_s"]) < 0
