"""Limits, maps, bands and zones are those of the command line, double by double."""

import copy
import json
import pickle

import numpy as np
import pytest
from common import FREE, changed, joint_file, json_of_command, refused, rows_of, run_command, soup, text_of

import condyle


@pytest.fixture(scope="module")
def rom(hip):
    return hip.range_of_motion()


def test_what_soft_tissue_ends_has_its_source(rom):
    assert all(isinstance(limit.caveats, list) and limit.caveats for limit in rom)
    assert [caveat.code for caveat in rom["extension"].caveats] == ["soft_tissue_ends"]
    assert "PMC3589629" in rom["extension"].caveats[0].source


def test_living_hips_are_those_of_the_command_for_the_same_person(hip_file, tmp_path):
    whose = changed(hip_file, tmp_path, more='\n[person]\nage = 45\nsex = "male"\n')
    said = json_of_command("rom", whose)
    joint = pickle.loads(pickle.dumps(condyle.read_joint(whose)))
    assert joint.person == {"age": 45, "sex": "male"}
    for theirs, ours in zip(said["motions"], joint.range_of_motion().limits):
        assert theirs.get("living") == (None if ours.living is None else json_of(ours.living))
    flexion = joint.range_of_motion(["flexion"])["flexion"]
    assert flexion.living.expected_deg == pytest.approx(flexion.limit_deg - 3.1)
    assert flexion.living.gap.closeness == "close" and flexion.living.people.who == "clinical estimate"


def json_of(record):
    return {key: json_of(value) if isinstance(value, condyle.Record) else value for key, value in vars(record).items()}


def test_a_person_of_arrays_has_an_age_and_a_sex():
    bones = condyle.sample_hip()
    joint = condyle.Joint(*bones, person={"age": 7, "sex": "female"}, reference_pose={})
    assert joint.person == {"age": 7, "sex": "female"}
    assert joint.range_of_motion(["flexion"])["flexion"].living.people.low_deg == 140.8
    animal = condyle.Joint(*bones, person={"species": "gorilla"}, reference_pose={})
    assert animal.person == {"species": "gorilla"} and animal.range_of_motion(["flexion"])["flexion"].living is None
    for person, what in (({"age": 121}, "person: age"), ({"sex": "f"}, "person: sex"), ({"years": 7}, "person"), (7, "person")):
        refused(lambda: condyle.Joint(*bones, person=person), what)


def test_notes_of_limits_are_the_same_everywhere(hip_file, tmp_path):
    """The hip bone is 1.3 mm too far forwards: head and socket have different centres."""
    moved = changed(hip_file, tmp_path, ("[fixed]", "[fixed]\npose = [1, 0, 0, 1.3, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]"))
    ran = run_command("rom", moved, "--json", "--strict")
    note, = json.loads(ran.stdout)["notes"]
    assert note["code"] == "centre_moves_limits" and "1.3 mm apart" in note["text"]
    assert f"note: {note['code']}: {note['text']}" in ran.stderr

    with pytest.warns(condyle.JointRemark, match="centre_moves_limits"):
        rom = condyle.read_joint(moved).range_of_motion()
    assert [vars(each) for each in rom.notes] == [note]

    (tmp_path / "hips.csv").write_text("id,joint\nmoved,changed.toml\n")
    run_command("study", tmp_path / "hips.csv", "--out", tmp_path / "out")
    row, = rows_of(tmp_path / "out/hips.csv")
    assert row["notes"] == note["code"]
    with pytest.warns(condyle.JointRemark, match="moved: centre_moves_limits"):
        condyle.run_study(tmp_path / "hips.csv", tmp_path / "ours", motions=["flexion"])


def test_surfaces_that_slide_by_nature_are_noted_everywhere(hip_file, tmp_path):
    """The sample hip called an elbow: every contact ends a motion."""
    elbow = changed(hip_file, tmp_path, ('kind = "ball"', 'kind = "ball"\njoint = "elbow"'))
    ran = run_command("rom", elbow, "--json")
    note, = [each for each in json.loads(ran.stdout)["notes"] if each["code"] == "sliding_surfaces"]
    assert note["text"].startswith("the surfaces of an elbow slide on each other by nature")
    assert f"note: {note['code']}: {note['text']}" in ran.stderr
    with pytest.warns(condyle.JointRemark, match="sliding_surfaces"):
        rom = condyle.read_joint(elbow).range_of_motion()
    assert [vars(each) for each in rom.notes] == [note]
    assert rom.bearing is None


def test_a_map_is_that_of_the_command(hip, rom, hip_file, tmp_path):
    run_command("rom", hip_file, "--motion", "flexion", "--map", "flexion=0:120:40", "adduction=-20:20:20", "--out", tmp_path)
    rows = rows_of(tmp_path / "map.csv")
    seen = []
    found = rom.map({"flexion": (0, 120, 40)}, {"adduction": (-20, 20, 20)}, progress=lambda *done: seen.append(done))
    assert len(rows) == found.lower_deg.size == 12
    for n, row in enumerate(rows):
        at = np.unravel_index(n, found.lower_deg.shape)
        assert float(row["flexion_deg"]) == found.column_deg[at[1]]
        assert float(row["adduction_deg"]) == found.row_deg[at[0]]
        assert float(row["internal_rotation_lower_deg"]) == -found.negative.turned_deg[at]
        assert float(row["internal_rotation_upper_deg"]) == found.positive.turned_deg[at]
        if found.free_at_start[at]:
            assert found.lower_deg[at] == -found.negative.turned_deg[at]
            assert found.upper_deg[at] == found.positive.turned_deg[at]
    assert seen == sorted(seen) and all(total == 12 for _, total in seen)
    assert found.to_xarray().lower_deg.shape == (3, 4) and len(found.to_dataframe()) == 12


def test_limits_are_taken_by_name_number_and_slice(rom):
    assert rom[0] is rom["flexion"] is rom.limits[0] and rom[-1] is rom[np.int64(11)] is rom["faber"]
    assert rom[:2] == rom.limits[:2] and rom[-2:] == rom.limits[10:]


def test_a_free_set_and_its_contact_set_fill_the_range(rom):
    free = rom.free_angles("internal_rotation", {"flexion": 90})
    both = np.concatenate([free.intervals_deg, free.contact_set_deg])
    both = both[np.argsort(both[:, 0])]
    assert both[0, 0] == -180 and both[-1, 1] == 180
    np.testing.assert_array_equal(both[1:, 0], both[:-1, 1])
    assert free.intervals_deg[(free.intervals_deg[:, 0] <= 0) & (free.intervals_deg[:, 1] >= 0)][0, 1] == \
        rom["internal_rotation_at_90_flexion"].limit_deg
    np.testing.assert_array_equal(rom.contact_set("internal_rotation", {"flexion": 90}), free.contact_set_deg)


def test_a_limit_touches_just_past_it_and_not_before(hip):
    rom = hip.range_of_motion(["flexion"], bearing="count")
    at = rom["flexion"].limit_deg
    assert rom["flexion"].reason == "contact"
    np.testing.assert_array_equal(hip.in_contact(hip.pose(flexion_deg=[at - 1e-6, at + 1e-6])), [False, True])


def test_the_witness_of_a_limit_lies_on_both_bodies(hip, rom):
    limit = rom["flexion"]
    X_FM = hip.pose(**{f"{name}_deg": value for name, value in limit.at_limit_deg.items()})
    np.testing.assert_allclose((X_FM @ [*limit.contact.mobile_point, 1])[:3], limit.contact.fixed_point, atol=1e-9)
    kind, *numbers = limit.contact.fixed_feature
    if kind == "vertex":
        np.testing.assert_allclose(hip.fixed.vertices[numbers[0]], limit.contact.fixed_point, atol=1e-9)


def test_a_motion_of_ones_own_is_the_built_in_one_where_it_says_the_same(rom):
    own = condyle.Motion("mine", "extension", 90, {})
    assert rom.limit(own).limit_deg == rom["extension"].limit_deg
    fadir = condyle.Motion("mine", "internal_rotation", 120, {"flexion": 90, "adduction": 15})
    assert rom.limit(fadir).limit_deg == rom["fadir"].limit_deg


def test_bands_are_those_of_the_command(hip, hip_file):
    said = json_of_command("rom", hip_file, "--motion", "flexion", "--band=20")
    band, = hip.range_of_motion(["flexion"]).bands(samples=20)
    theirs = said["motions"][0]["band"]
    assert (band.p5_deg, band.median_deg, band.p95_deg) == (theirs["p5_deg"], theirs["median_deg"], theirs["p95_deg"])


def test_bands_are_a_table(coarse_bones):
    pytest.importorskip("pandas")
    rom = condyle.Joint(*coarse_bones).range_of_motion(["flexion", "faber"])
    bands = rom.bands(samples=20)
    table = bands.to_dataframe()
    assert table.motion.tolist() == ["flexion", "faber"] and table.p95_deg.tolist() == [band.p95_deg for band in bands]
    assert bands[0].text == f"{bands[0].p5_deg:.0f}–{bands[0].p95_deg:.0f}" and bands[1].text == f"{bands[1].p5_deg:.0f}–>120"
    assert f"<td>flexion</td><td>{bands[0].text}, median {bands[0].median_deg:.1f}</td>" in bands._repr_html_()
    assert isinstance(bands, tuple) and type(pickle.loads(pickle.dumps(bands))) is condyle.LimitBands
    old = pickle.loads(pickle.dumps(rom[0]))
    vars(old)["key_of_then"] = None
    assert "<td>limit_deg</td>" in old._repr_html_() and "key_of_then" not in old._repr_html_()


def test_a_zone_grows_past_its_limit(hip):
    rom = hip.range_of_motion(["flexion"])
    near, = rom.zones(past_deg=2)
    far, = rom.zones(past_deg=6)
    assert 0 < near.fixed.area_mm2 < far.fixed.area_mm2
    assert len(near.fixed.radial_depth_mm) == len(hip.fixed.vertices)
    assert near.limit.limit_deg == rom["flexion"].limit_deg


def touching(hip):
    return condyle.Joint(hip.fixed, (hip.mobile.vertices + [0, 5, 0], hip.mobile.triangles))  # the joint space is 3.5 mm


def test_bodies_in_contact_in_the_reference_pose_are_refused_or_accepted(hip):
    bones = touching(hip)
    refused(lambda: bones.range_of_motion(["flexion"], bearing="count"), kind=condyle.ReferenceContactError)
    limit, = bones.range_of_motion(["flexion"], bearing="count", accept_reference_contact=True)
    assert limit.reason == "contact_at_start" and limit.limit_deg == 0


def test_a_path_along_one_angle_ends_short_of_its_exact_limit(hip):
    exact = hip.range_of_motion(["flexion"])["flexion"].limit_deg
    path = hip.path_limit([{}, {"flexion": 170}], tolerance_deg=0.01)
    assert path.reason == "contact" and path.angles_deg["flexion"] <= exact


def test_soups_give_the_limits_and_features_of_the_joined_mesh(hip):
    souped = condyle.Joint(soup(hip.fixed), soup(hip.mobile))
    ours = souped.range_of_motion(["flexion"])["flexion"]
    theirs = hip.range_of_motion(["flexion"])["flexion"]
    assert ours.limit_deg == theirs.limit_deg
    for body, mesh, whole in (("fixed", souped.fixed, hip.fixed), ("mobile", souped.mobile, hip.mobile)):
        kind, *numbers = getattr(ours.contact, f"{body}_feature")
        _, *expected = getattr(theirs.contact, f"{body}_feature")
        if kind == "face":
            assert numbers == expected
        else:
            np.testing.assert_array_equal(mesh.vertices[numbers], whole.vertices[expected])


def test_areas_of_rows_add_up_to_the_volume(rom):
    found = rom.map({"flexion": (0, 60, 30)}, {"adduction": (-20, 20, 20)})
    trapezoid = getattr(np, "trapezoid", None) or np.trapz  # the first is numpy 2's, which drops the other
    np.testing.assert_allclose(found.row_area_deg2, trapezoid(found.free_width_deg, found.column_deg, axis=1), rtol=1e-12)
    assert trapezoid(found.row_area_deg2, found.row_deg) == pytest.approx(found.free_volume_deg3, rel=1e-12)


def test_what_touches_in_the_reference_pose_is_left_out_by_number(hip):
    bones = touching(hip)
    fixed, mobile = bones.range_of_motion(["flexion"], bearing="count", exclude_reference_contacts=0).left_out
    pairs = bones.pairs(bones.pose())
    assert (fixed, mobile) == (len(set(pairs[:, 0])), len(set(pairs[:, 1]))) and fixed > 0
    assert hip.range_of_motion([]).left_out == (0, 0)


def test_hours_are_those_of_the_clock_of_the_rim(hip):
    rom = hip.range_of_motion(clock="rim")
    bearing = rom.bearing
    rim = condyle.find_rim_clock(hip.fixed, (bearing["head_centre"], bearing["head_radius_mm"]))
    hours = [(limit.clock_hour, rim.hour_of(limit.contact.fixed_point)) for limit in rom if limit.clock_hour is not None]
    assert len(hours) > 5 and all(ours == of_rim for ours, of_rim in hours)


def test_clock_faces_have_twelve_up_and_three_in_front(hip, rom):
    face = condyle.clock_face([0, 0, -2])
    assert (face.twelve.tolist(), face.three.tolist()) == ([0, 1, 0], [1, 0, 0])
    sagittal = condyle.sagittal_clock()
    around = [[0, 1, 0], [1, 0, 0], [0, -1, 0], [-1, 0, 0]]
    assert sagittal.hour_of(around).tolist() == [0, 3, 6, 9] and sagittal.angle_deg_of(around[3]) == 270
    axis = condyle.find_neck_axis(hip.mobile, rom.bearing["head_radius_mm"])
    assert np.linalg.norm(axis) == pytest.approx(1, abs=1e-12) and axis[1] < 0, "the neck goes down from the head"
    assert abs(condyle.neck_clock(axis).three @ axis) < 1e-12
    assert condyle.find_neck_axis(hip.fixed, 1e-3) is None
    refused(lambda: condyle.clock_face([0, 1, 0]))


def test_depth_limits_are_those_of_the_command(hip, hip_file):
    said = json_of_command("rom", hip_file, "--motion", "flexion", "--allow-depth", "1")
    allowed = condyle.DepthRange(hip, 1.0)
    seen = []
    deep, = allowed.limits(["flexion"], progress=lambda *now: seen.append(now))
    assert deep.limit.limit_deg == said["motions"][0]["limit_deg"] and seen == [(1, 1)]
    assert 0 < deep.at_limit.depth_mm <= 1 and deep.start_depth_mm == 0
    at = allowed.deepest({"flexion": deep.limit.limit_deg})
    assert at.depth_mm == deep.at_limit.depth_mm == hip.penetration({"flexion_deg": deep.limit.limit_deg}).max_depth_mm
    for wrong in ({"allowed_depth_mm": -1}, {"allowed_depth_mm": 1, "step_deg": 0}, {"allowed_depth_mm": "deep"}):
        refused(lambda: condyle.DepthRange(hip, **wrong))


def test_first_contact_about_the_axis_of_flexion_is_the_limit_of_flexion(hip):
    counted = hip.range_of_motion(["flexion", "extension"], bearing="count")
    found = condyle.FirstContact(hip.fixed, hip.mobile, [0, 0, 0], [0, 0, 1])
    limits = found.limits()
    assert limits.free_at_start
    assert limits.positive.limit_deg == counted["flexion"].limit_deg
    assert found.limits(positive_deg=10).positive.reason == "end_of_range"
    assert not found.limits(hip.pose(flexion_deg=145)).free_at_start
    for pose, degrees in ((np.eye(3), 10), (np.eye(4), 400), ([np.eye(4)] * 2, 10)):
        refused(lambda: found.limits(pose, positive_deg=degrees))


def test_the_centre_follows_a_recorded_motion_or_a_load(tmp_path, coarse_bones):
    layers = condyle.sample_cartilages(scenario=7)
    joint_file(tmp_path, kind=FREE, fixed=coarse_bones.hip_bone, mobile=coarse_bones.femur)
    joint = condyle.read_joint(tmp_path / "hip.toml")
    degrees = np.arange(0.0, 150.0, 2.0)
    rows = "".join(f"{i * 0.1},{d},{0.01 * d},{-0.005 * d}\n" for i, d in enumerate(degrees))
    (tmp_path / "record.csv").write_text("time,flexion_deg,x_mm,y_mm\n" + rows)
    found = joint.range_following(poses=joint.motion(tmp_path / "record.csv").X_FM)
    assert [limit.motion.name for limit in found.limits] == ["flexion"] and found[-1] is found["flexion"]
    by_command = json_of_command("rom", tmp_path / "hip.toml", "--follow", tmp_path / "record.csv")
    assert found["flexion"].limit_deg == by_command["motions"][0]["limit_deg"]
    assert found["flexion"].translation_ends is by_command["motions"][0]["translation_ends"] is False
    (tmp_path / "short.csv").write_text("time,flexion_deg,x_mm,y_mm\n" + "".join(rows.splitlines(True)[:5]))
    with pytest.warns(condyle.JointRemark, match="recorded motion ends 8 degrees"):
        led = joint.range_following(poses=joint.motion(tmp_path / "short.csv").X_FM)
    short = led["flexion"]
    assert repr(led) == "FollowedRange(flexion 8.0 translation_ends)"
    assert short.translation_ends is True and short.limit_deg == pytest.approx(8, abs=1e-9)
    found.write_report(tmp_path / "python.html", title="hip")
    run_command("report", tmp_path / "hip.toml", "--follow", tmp_path / "record.csv", "--title", "hip", "--out", tmp_path / "command.html")
    pages = [text_of(tmp_path / name) for name in ("python.html", "command.html")]
    assert pages[0]["rom"]["motions"] == pages[1]["rom"]["motions"] == by_command["motions"]
    assert pages[0]["rom"]["exact"] is False and pages[0]["poses"] == pages[1]["poses"]
    (tmp_path / "joints.csv").write_text("id,joint,follow\none,hip.toml,record.csv\n")
    study = condyle.run_study(tmp_path / "joints.csv", tmp_path / "study")
    assert study.limits["limit_deg"].tolist() == [found["flexion"].limit_deg] and study.hips["exact"].tolist() == [0]
    held = joint.range_of_motion(["flexion"])["flexion"]
    assert held.translation_mm is None and 0.1 < abs(held.limit_deg - found["flexion"].limit_deg) < 20
    contact = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=condyle.ElasticLayer(12, 0.42, 1.5))
    loaded = joint.range_following(["flexion"], contact=contact, force_n=[0, 800, 0], step_deg=20)
    assert loaded["flexion"].reason in ("contact", "end_of_range") and "carries the load" in loaded.caveats[0]
    stiff = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=condyle.ElasticLayer(1.2e7, 0.42, 1.5))
    with pytest.warns(condyle.JointWarning, match="unlikely_modulus"):
        noted = joint.range_following(["flexion"], contact=stiff, force_n=[0, 800, 0], step_deg=20)
    copy.copy(noted).write_report(tmp_path / "stiff.html")
    assert {note.code for note in noted.notes} <= {note["code"] for note in text_of(tmp_path / "stiff.html")["rom"]["notes"]}
    refused(lambda: pickle.loads(pickle.dumps(noted)).write_report(tmp_path / "again.html"), "pickled")
    refused(lambda: joint.range_following(), "one of the two")
    for motions in ({"motions": ["flexion"]}, {}):
        refused(lambda: joint.range_following(**motions, poses=joint.pose(flexion_deg=[0, 10, 5, 20])), "turns back")
    (tmp_path / "loads.csv").write_text("id,joint\none,hip.toml\n")
    refused(lambda: condyle.run_study(tmp_path / "loads.csv", tmp_path / "loads", follow_load=condyle.StudyLoad()), "needs force_n")
