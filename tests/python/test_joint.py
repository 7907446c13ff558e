"""What a joint says of itself, and slices of what many poses show."""

import pickle

import numpy as np
import pytest
from common import box, joint_file, json_of_command, lifted, refused, rows_of, run_command

import condyle


def test_slices_of_many_poses_are_what_their_poses_show(hip):
    many = hip.penetration(hip.pose(flexion_deg=[0, 140, 100, 145, 150]))
    for part in (slice(1, 4), slice(None), slice(None, None, -2), slice(4, 1), slice(-2, None)):
        some = many[part]
        expected = [many[n] for n in range(5)[part]]
        assert isinstance(some, condyle.Penetrations) and len(some) == len(expected)
        for one, other in zip(some, expected):
            np.testing.assert_array_equal(one.mobile.depth_mm, other.mobile.depth_mm)
            np.testing.assert_array_equal(one.fixed.vertex, other.fixed.vertex)
        np.testing.assert_array_equal(some.depths_mm, many.depths_mm[part])
    assert many[1:3].mobile.depth_mm.base is not None, "neighbours are not copied"
    refused(lambda: many[5], kind=IndexError)


@pytest.fixture(scope="module")
def layered(coarse_bones, tmp_path_factory):
    """A hip whose femur is of its bone and its cartilage, which is called bearing."""
    folder = tmp_path_factory.mktemp("layered")
    bones, layers = coarse_bones, condyle.sample_cartilages()
    meshes = {"hip_bone": bones.hip_bone, "femur": bones.femur, "cartilage": layers.femoral}
    for name, mesh in meshes.items():
        condyle.write_mesh(folder / f"{name}.vtp", mesh)
    path = joint_file(folder, bodies="""
        fixed = { name = "hip bone", mesh = "hip_bone.vtp" }
        mobile = { name = "femur", meshes = [{ name = "bone", mesh = "femur.vtp" },
                             { name = "cartilage", mesh = "cartilage.vtp", bearing = true }] }
        """)
    return condyle.read_joint(path), meshes


def test_parts_of_a_body_are_listed_by_name(layered):
    joint, meshes = layered
    assert joint.fixed_parts == ()
    bone, cartilage = joint.mobile_parts
    assert (bone.name, cartilage.name) == ("bone", "cartilage")
    assert bone.first_vertex == 0 and cartilage.first_vertex == bone.vertices == len(meshes["femur"].vertices)
    assert cartilage.triangles == len(meshes["cartilage"].triangles)
    assert (bone.contact, cartilage.contact) == ("ends", "bearing")
    assert joint.part("cartilage") == meshes["cartilage"] and joint.part("bone", "mobile") == meshes["femur"]
    refused(lambda: joint.part("labrum"), "cartilage")
    assert joint.translation_frame == "fixed"


def test_a_bearing_surface_is_given_by_its_margin_or_by_named_parts(layered, hip):
    joint, _ = layered
    bearing = joint.range_of_motion([]).bearing
    assert bearing["parts"] == ["cartilage"] and bearing["margin_mm"] >= 0
    # The cartilage, and the bone under it that lies within the head's margin.
    assert joint.mobile_parts[1].triangles <= bearing["triangles"].sum() < bearing["triangles"].size
    plain = hip.range_of_motion([]).bearing
    assert plain["parts"] == [] and plain["margin_mm"] > 0


@pytest.mark.parametrize("option", [{"side": "right"}, {"joint": "knee"}], ids=["hip", "knee"])
def test_a_joint_is_proposed_as_the_command_does(option, hip_file, tmp_path):
    fixed, mobile, to = hip_file.parent / "hip_bone.ply", hip_file.parent / "femur.ply", tmp_path / "new.toml"
    (name, value), = option.items()
    run_command("init", fixed, mobile, f"--{name}", value, "-o", to)
    proposal = condyle.propose_joint(fixed, mobile, to, **option)
    # A hip is no knee.
    to_fill_in = [] if name == "side" else ["side", "centre", "anterior", "superior"]
    assert proposal.toml == to.read_text() and [line.split(":")[0] for line in proposal.to_fill_in] == to_fill_in
    assert ('joint = "knee"  # given' in proposal.toml) == (name == "joint") != bool(proposal.evidence)
    assert all(f"# {line}\n" in proposal.toml for line in proposal.evidence)
    refused(lambda: condyle.propose_joint("nowhere.stl", mobile, to), "nowhere.stl", condyle.FileError)
    refused(lambda: condyle.propose_joint(fixed, mobile, to, joint="wrist"), "joint: there are hip, knee")


def test_frames_of_a_motion_show_what_their_poses_show(hip):
    poses = hip.pose(flexion_deg=[0, 140, 0, 150])
    poses[2] = np.nan
    seen = []
    frames = hip.contact_along(poses, progress=lambda *now: seen.append(now))
    assert frames[2] is None and seen[-1] == (4, 4)
    for n in (0, 1, 3):
        alone = hip.normal_contact(poses[n], casting="mobile").mobile
        np.testing.assert_array_equal(frames[n].surface.area_mm2, alone.area_mm2)
        assert frames[n].surface.totals.max_depth_mm == alone.totals.max_depth_mm
        assert frames[n].in_contact == hip.in_contact(poses[n])
        assert frames[n].intersecting_pairs == len(hip.pairs(poses[n]))
        assert frames[n].smallest_gap_mm == hip.contact_measures(poses[n]).smallest_gap_mm
    gaps = [np.inf if frame is None else frame.smallest_gap_mm for frame in frames]
    assert frames.nearest == np.argmin(gaps)
    assert hip.contact_along(poses[2:3]).nearest is None
    # By 150 degrees the bones are deeper than rays go.
    assert frames[0].cut_off_by_reach == 0 < frames[3].cut_off_by_reach
    refused(lambda: hip.contact_along([np.eye(4), 2 * np.eye(4) - np.diag([0, 0, 0, 1])]), "pose 1: the rotation is not orthonormal")


def test_arcs_go_about_any_axis_as_the_command_says(hip, hip_file):
    pose, axis, point = hip.pose(flexion_deg=140), [0.6, 0, -0.8], [5, -40, 7]
    for about, text in (("adduction", "adduction"), (axis, "0.6 0 -0.8"), ((axis, point), "0.6 0 -0.8 5 -40 7")):
        reported = json_of_command("depth", hip_file, "--pose", "flexion=140", "--method", "tangential", "--about", text, "--json")
        inside, gaps = (ask(pose, "tangential", about=about) for ask in (hip.penetration, hip.gaps))
        for body, here in (("mobile", inside.mobile), ("fixed", inside.fixed)):
            assert reported["bodies"][body]["max_tangential_depth_mm"] == max(here.depth_mm[np.isfinite(here.depth_mm)]), (text, body)
        np.testing.assert_array_equal(-gaps.mobile.gap_mm[inside.mobile.vertex], inside.mobile.depth_mm)
    assert len(hip.penetration(lifted(3) @ pose, "tangential", about=(axis, point)).mobile)
    assert hip.picture(pose, about=(axis, point), width=80, height=64).shape == (64, 80, 3)
    refused(lambda: hip.penetration(pose, "tangential", about=[0, 0, 0]), "joint axis: its direction is zero")
    refused(lambda: hip.penetration(pose, "tangential", about=[0, np.nan, 1]), "joint axis: a coordinate is not finite")
    refused(lambda: hip.penetration(pose, "tangential", about=[0, 1]), "about: three numbers, or an axis and a point")


def test_frames_have_the_screws_of_the_command(hip, hip_file, tmp_path):
    (tmp_path / "swing.csv").write_text("time,flexion_deg,adduction_deg\n0,100,0\n1,130,5\n2,138,7\n3,138,7\n")
    run_command("motion", hip_file, "--motion", tmp_path / "swing.csv", "--screws", "--out", tmp_path / "out")
    poses, rows = hip.motion(tmp_path / "swing.csv").X_FM, rows_of(tmp_path / "out" / "curves.csv")
    screws = [frame.screw for frame in hip.contact_along(poses, screws=True)]
    assert screws[0] is None and screws[3].is_slide and screws[3].axis is None and screws[3].depth_deg is None
    for screw, row in zip(screws[1:3], rows[1:3]):
        reported = [float(row[f"screw_{of}"]) for of in ("rotation_deg", "axis_x", "axis_y", "axis_z", "point_x_mm", "point_y_mm", "point_z_mm",
                                                     "depth_deg", "depth_mm")]
        assert reported == [screw.rotation_deg, *screw.axis, *screw.point_mm, screw.depth_deg, screw.depth_mm]
    inside = hip.penetration(poses[2], "tangential", about=(screws[2].axis, screws[2].point_mm))
    assert 0 < screws[2].depth_mm == pytest.approx(max(*inside.mobile.depth_mm, *inside.fixed.depth_mm), abs=1e-10)
    assert hip.contact_along(poses)[2].screw is None


def test_depths_and_measures_of_many_poses_are_those_of_each(hip):
    poses = hip.pose(flexion_deg=[0, 140, 150])
    seen = []
    depths = hip.depths(poses, progress=lambda *now: seen.append(now))
    measures = hip.contact_measures(poses)
    assert len(depths) == len(measures) == 3 and seen[-1] == (3, 3)
    for n in range(3):
        alone = hip.depths(poses[n])
        np.testing.assert_array_equal(depths[n].mobile.depth_mm, alone.mobile.depth_mm)
        np.testing.assert_array_equal(depths[n].fixed.kind, alone.fixed.kind)
        assert measures[n].volume_mm3 == hip.contact_measures(poses[n]).volume_mm3
    assert depths[0].max_depth_mm == 0 < depths[1].max_depth_mm
    assert hip.depths(np.empty((0, 4, 4))) == []
    refused(lambda: hip.depths([np.eye(4), 2 * np.eye(4) - np.diag([0, 0, 0, 1])]), "pose 1: the rotation is not orthonormal")


def test_depths_say_what_they_must_be_read_with(hip):
    moved = np.eye(4)
    moved[:3, 3] = 0, 0.3, -0.4
    assert hip.depths(np.eye(4)).caveats == ()
    (caveat,) = hip.depths(moved).caveats
    assert "0.500 mm" in caveat and "no depths along arcs" in caveat


def test_faces_within_a_region_and_outside_of_it_are_all(hip):
    faces = hip.normal_contact({"flexion_deg": 145}, casting="fixed").fixed
    centres = hip.fixed.vertices[hip.fixed.triangles[faces.face]].mean(axis=1)
    offset = float(np.median(centres[:, 0]))
    inner, outer = faces.within(([1, 0, 0], offset)), faces.within(([-1, 0, 0], -offset), ([0, 1, 0], -1e9))
    assert set(inner.face) == set(faces.face[centres[:, 0] > offset]) and len(inner) > 0 < len(outer)
    assert not set(inner.face) & set(outer.face)
    assert inner.totals.area_mm2 == pytest.approx(inner.area_mm2.sum(), rel=1e-12)
    np.testing.assert_array_equal(faces.within().overlap_mm3, faces.overlap_mm3)
    for wrong in (3, ([1, 0], 0.0), ([1, 0, 0], "far")):
        refused(lambda: faces.within(wrong), "region")


def test_faces_in_contact_are_copied_without_their_mesh(hip):
    faces = hip.normal_contact({"flexion_deg": 145}, casting="fixed").fixed
    copied = pickle.loads(pickle.dumps(faces))
    np.testing.assert_array_equal(copied.area_mm2, faces.area_mm2)
    assert copied.totals.area_mm2 == faces.totals.area_mm2
    refused(lambda: copied.within(([1, 0, 0], 0.0)), "not for a copy")


def test_what_contact_of_each_mesh_means(tmp_path):
    names = {"arm": ([-1, -100, -1], [1, -50, 1]), "sleeve": ([-1.2, -45, -1.2], [1.2, -25, 1.2]), "post": ([40, -120, -10], [60, -80, 10]),
             "pad": ([9, -40, -1], [11, -30, 1]), "labrum": ([5, -60, -1], [6, -55, 1])}
    for name, corners in names.items():
        condyle.write_mesh(tmp_path / f"{name}.ply", box(*corners))
    path = joint_file(tmp_path, kind='kind = "hinge"', bodies="""
        fixed = { name = "frame", meshes = [{ name = "post", mesh = "post.ply" },
                  { name = "pad", mesh = "pad.ply", contact = "bearing" },
                  { name = "labrum", mesh = "labrum.ply", contact = "soft" }] }
        mobile = { name = "limb", meshes = [{ name = "arm", mesh = "arm.ply" },
                   { name = "sleeve", mesh = "sleeve.ply", contact = "bearing" }] }
        """)
    joint = condyle.read_joint(path)
    assert [part.contact for part in joint.fixed_parts] == ["ends", "bearing", "soft"]
    limit = joint.range_of_motion(["flexion"]).limits[0]
    by_command = json_of_command("rom", path, "--motion", "flexion")["motions"][0]
    assert limit.limit_deg == by_command["limit_deg"] and limit.contact.kind == "impingement"
    assert (limit.fixed_part, limit.mobile_part) == ("post", "arm")
    assert limit.soft_contact_deg == by_command["soft_contact_deg"] < limit.bearing_contact_deg < limit.limit_deg
    assert limit.bearing_contact_deg == by_command["bearing_contact_deg"]
    assert limit.soft_contact.kind == "soft"
    assert limit.soft_contact.fixed_point.tolist() == by_command["soft_contact_point_mm"]
    assert {"fixed": limit.soft_fixed_part, "mobile": limit.soft_mobile_part} == by_command["soft_contact_parts"]
    assert limit.soft_fixed_part == "labrum"


def test_measures_are_those_of_the_command(tmp_path, sampled):
    joint = condyle.read_joint(sampled(tmp_path, "hip") / "hip.toml")
    said = json_of_command("measure", tmp_path / "hip.toml", "--tilt", "5", "--band=20")
    shape = joint.measures(pelvic_tilt_deg=5, band_samples=20)
    assert list(shape) == [each["key"] for each in said["measures"]]
    assert shape.pelvis_frame == said["pelvis_frame"] == "as scanned, tilt 5 deg given"
    for each in said["measures"]:
        ours = {key: vars(value) if isinstance(value, condyle.Record) else value for key, value in vars(shape[each["key"]]).items()}
        assert ours == each
    assert shape["femoral_version_deg"].value is None and "knee" in shape["femoral_version_deg"].why_none
    assert [None if np.isnan(a) else a for a in shape.alpha_deg] == [each["alpha_deg"] for each in said["around_neck"]]
    assert shape.rim_points.shape == (len(said["rim"]), 3) and len(shape.centre_edge_deg) == len(said["rim"])
    refused(lambda: shape["alpha_3"], "alpha_3_deg")
    refused(lambda: joint.measures(pelvic_tilt_deg=90))


def test_depths_and_measures_are_tables(coarse_bones):
    pytest.importorskip("pandas")
    joint = condyle.Joint(*coarse_bones)
    depths = joint.depths({"flexion_deg": 140})
    table = depths.to_dataframe()
    assert list(table.columns) == ["body", "vertex", "depth_mm", "kind"] and len(table) == len(depths.mobile) + len(depths.fixed)
    of_fixed = table[table.body == "fixed"]
    assert of_fixed.depth_mm.tolist() == depths.fixed.depth_mm.tolist() and of_fixed.vertex.tolist() == list(range(len(depths.fixed)))
    assert condyle.Depths(None, None).to_dataframe().empty
    measures = joint.measures()
    table = measures.to_dataframe().set_index("key")
    at = table.loc["alpha_12_deg"]
    assert at["value"] == measures["alpha_12_deg"].value and at["normal_high"] == measures["alpha_12_deg"].normal.high
    assert list(table.index) == list(measures) and not {"normal", "patients", "band"} & set(table.columns)
    shown = measures._repr_html_()
    assert f"<td>{measures['alpha_12_deg'].value:.4g} deg</td>" in shown and "ends above the knee" in shown
    assert "<td>normal_high</td><td>66.0</td>" in measures["alpha_12_deg"]._repr_html_() and "why_none" not in measures["alpha_12_deg"]._repr_html_()


@pytest.mark.parametrize("reach, words", [
    *(({"fadir": value}, 'reach of fadir: must be degrees, or a gain as "\\+10"') for value in ("10", "+", "+nan", "ten", "")),
    *((reach, 'reach: motions and their degrees are needed: {"flexion": 115}') for reach in ("fadir=40", {}, None, [("fadir", 40)]))])
def test_a_resection_says_how_its_targets_are_given(hip, reach, words):
    refused(lambda: hip.resection(reach), words)


def test_the_two_bodies_of_a_sample_are_those_of_a_joint(coarse_bones):
    assert condyle.Joint(*coarse_bones).mobile == coarse_bones.femur
    acetabular, femoral = condyle.sample_cartilages()
    assert len(femoral.vertices) == 1414 < len(acetabular.vertices)


def test_resections_are_those_of_the_command(tmp_path, sampled):
    joint = condyle.read_joint(sampled(tmp_path, "hip", "--alpha-angle", "70") / "hip.toml")
    reach = {"internal_rotation_at_90_flexion": 45}
    said = json_of_command("resect", tmp_path / "hip.toml", "--reach", "internal_rotation_at_90_flexion=45", "--curve", "2", "--band=20", "--out",
                           tmp_path / "plan")
    with pytest.warns(condyle.JointRemark):
        plan = joint.resection(reach, curve_points=2, band_samples=20)
    target, of_command = plan.targets[0], said["targets"][0]
    assert (target.text, target.confidence_reached, target.is_plan) == tuple(of_command[key] for key in ("text", "confidence_reached", "is_plan"))
    assert target.band == tuple(of_command["band"][key] for key in ("p5_deg", "median_deg", "p95_deg")) and target.other_centre is None
    assert [each._asdict() for each in plan.alternatives] == said["alternatives"] and (plan.confidence, plan.displaced) == (0.5, 20)
    cut, = said["cuts"]
    assert plan.fixed is None and plan.mobile.volume_mm3 == plan.volume_mm3 == cut["volume_mm3"]
    assert plan.mobile.depth_mm.max() == cut["deepest_mm"] and plan.margin_mm == said["margin_mm"]
    assert [each.limit_deg for each in plan.after] == [each["after"]["limit_deg"] for each in said["limits"]]
    assert [point._asdict() for point in plan.curve] == said["curve"]
    assert [note.text for note in plan.notes] == [note["text"] for note in said["resection_notes"] + said["notes"]]
    assert list(plan.gain_deg) == [each["gain_deg"] for each in said["limits"]]
    assert plan.joint.name == "sample right hip, resected" and joint.planned == ""
    assert plan.joint.planned == f"without {plan.volume_mm3:.1f} mm3 of femur" == pickle.loads(pickle.dumps(plan.joint)).planned
    gained = joint.resection({"internal_rotation_at_90_flexion": "+5"}, curve_points=0, band_samples=0).targets[0]
    assert gained.reach_deg == pytest.approx(gained.before.limit_deg + 5, abs=1e-9) and gained.after.limit_deg >= gained.reach_deg
    assert plan.measures["alpha_3_deg"] == tuple(next((each["before"], each["after"]) for each in said["measures"] if each["key"] == "alpha_3_deg"))
    # The joint without the bone composes, survives a pickle, and is the one that the command wrote.
    motion = ["internal_rotation_at_90_flexion"]
    limit = plan.joint.range_of_motion(motion).limits[0].limit_deg
    assert limit == plan.targets[0].after.limit_deg >= 45
    assert pickle.loads(pickle.dumps(plan.joint)).range_of_motion(motion).limits[0].limit_deg == limit
    assert condyle.read_joint(tmp_path / "plan" / "resected.toml").range_of_motion(motion).limits[0].limit_deg == limit
    assert joint.with_mobile(plan.mobile.mesh).range_of_motion(motion).limits[0].limit_deg == limit
    assert plan.joint.resection(reach, curve_points=0, band_samples=0).mobile is None
    said = json_of_command("resect", tmp_path / "hip.toml", "--reach", "internal_rotation_at_90_flexion=45", "--curve", "0", "--burr", "11",
                           "--band=0")
    burr = joint.resection(reach, curve_points=0, burr_mm=11, band_samples=0)
    assert burr.mobile.burr_volume_mm3 == said["cuts"][0]["burr_volume_mm3"] > 0
    assert burr.mobile.burr_in_kept_mm == said["cuts"][0]["burr_in_kept_mm"]
    kept = joint.resection(reach, curve_points=0, band_samples=0, keep=np.ones(len(joint.mobile.vertices), bool))
    assert kept.targets[0].blocked.by == "marked" and kept.volume_mm3 == 0
    for given in ({"margin_mm": 0}, {"band_samples": 0}):
        refused(lambda: joint.resection(reach, confidence=0.5, **given), f"confidence: .*{next(iter(given))} is")
    refused(lambda: joint.resection(reach, share=0.5), "share")
    refused(lambda: joint.resection(reach, keep=[True]), "keep")


def balls_on_a_shaft(turned_deg=0.0):
    """A femur of balls, a head and two condyles 50 mm apart, turned about the vertical: outwards of a right hip below zero."""
    steps = np.linspace(0, np.pi, 25)
    around = np.linspace(0, 2 * np.pi, 49)[:-1]

    def ball(centre, radius):
        rings = [centre + radius * np.array([np.sin(s) * np.cos(a), np.cos(s), np.sin(s) * np.sin(a)]) for s in steps[1:-1] for a in around]
        points = np.array([centre + [0, radius, 0], *rings, centre - [0, radius, 0]])
        n, last = len(around), len(points) - 1
        faces = [(0, 1 + (k + 1) % n, 1 + k) for k in range(n)]
        for i in range(len(steps) - 3):
            for k in range(n):
                a, b = 1 + i * n + k, 1 + i * n + (k + 1) % n
                faces += [(a, b, a + n), (b, b + n, a + n)]
        faces += [(last, last - n + k, last - n + (k + 1) % n) for k in range(n)]
        return points, np.array(faces)

    balls = [ball(np.array(centre, float), radius) for centre, radius in (((0, 0, 0), 24), ((0, -380, 25), 20), ((0, -380, -25), 20))]
    points = np.concatenate([points for points, _ in balls])
    faces = np.concatenate([faces + n * len(balls[0][0]) for n, (_, faces) in enumerate(balls)])
    c, s = np.cos(np.radians(turned_deg)), np.sin(np.radians(turned_deg))
    return points @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T, faces


def test_where_angles_count_from_is_said_stated_and_taken_from_the_anatomy(coarse_bones):
    bone = coarse_bones.hip_bone
    scanned = condyle.Joint(bone, balls_on_a_shaft(-25))
    assert scanned.zero.known_by == "as_given" and not scanned.zero.is_neutral
    np.testing.assert_allclose(scanned.zero.femur_deg, (0, 0, -25), atol=1e-3)
    assert "turned_leg" in [note.code for note in scanned.notes]
    neutral = condyle.Joint(bone, balls_on_a_shaft(-25), reference_pose={"from": "anatomy"})
    assert neutral.zero.known_by == "anatomy" and neutral.zero.is_neutral
    np.testing.assert_allclose(neutral.zero.femur_deg, (0, 0, 0), atol=1e-3)
    np.testing.assert_allclose(np.asarray(neutral.reference_pose)[0, 2], -np.sin(np.radians(25)), atol=1e-4)
    assert "turned_leg" not in [note.code for note in neutral.notes]
    assert pickle.loads(pickle.dumps(neutral)).zero == neutral.zero


def test_a_femur_without_condyles_does_not_say_how_the_leg_lay(coarse_bones):
    assert condyle.Joint(*coarse_bones).zero.femur_deg is None and not condyle.Joint(*coarse_bones).zero.is_neutral
    stated = condyle.Joint(*coarse_bones, reference_pose={})
    assert stated.zero.known_by == "stated" and stated.zero.is_neutral
    for pose, words, kind in (({"from": "anatomy"}, "shows no condyles", condyle.MeshError),
                              ({"from": "guess"}, "reference_pose: from", condyle.UsageError),
                              ({"from": "anatomy", "flexion": 3}, "leave them out", condyle.UsageError)):
        refused(lambda: condyle.Joint(*coarse_bones, reference_pose=pose), words, kind)
