"""A pickled joint comes back with its meshes, its description and its answers, to the bit."""

import copy
import multiprocessing
import pickle
import shutil

import numpy as np
import pytest
from common import refused, soup

import condyle

POSE = {"flexion_deg": 140}


def described(joint):
    return (repr(joint), joint.name, joint.kind, joint.joint, joint.side, joint.fixed_name, joint.mobile_name, joint.fixed_parts, joint.mobile_parts,
            joint.translation_frame, joint.X_WF.tolist(), joint.angle_names, joint.reference_pose.tolist(), joint.processing, joint.notes)


def answered(joint):
    depths, rom = joint.depths(POSE), joint.range_of_motion(["flexion", "fadir"])
    return (joint.pairs(POSE).tolist(), depths.mobile.depth_mm.tolist(), depths.fixed.depth_mm.tolist(), [limit.limit_deg for limit in rom.limits],
            [str(limit.contact) for limit in rom.limits], [motion.name for motion in rom.known_motions], rom.bands(samples=20)[0].p5_deg)


def require_same(a, b):
    assert a.fixed == b.fixed and a.mobile == b.mobile
    for of_a, of_b in ((a.fixed, b.fixed), (a.mobile, b.mobile)):
        assert of_a.processing == of_b.processing
        np.testing.assert_array_equal(of_a.vertex_map is None, of_b.vertex_map is None)
    assert described(a) == described(b)
    assert answered(a) == answered(b)


FILE = """
[[motion]]
name = "kick"
vary = "flexion"
range = [-10, 140]
adduction = 5
[uncertainty]
centre = 0.7
seed = 3
[recorded_motion]
flexion = { column = "flexion", unit = "deg" }
[contact]
rule = "face_centre"
region = [{ name = "front", half_space = [ { normal = [1, 0, 0], offset = 2 } ] }]
fixed = { youngs_modulus_mpa = 10, poisson_ratio = 0.45, thickness = 2 }
"""


@pytest.fixture
def joint_path(hip_file, tmp_path):
    folder = tmp_path / "hip"
    shutil.copytree(hip_file.parent, folder)
    path = folder / "hip.toml"
    path.write_text(path.read_text().replace("[0.0, 0.0, 0.0]", '"fit"') + FILE)
    return path


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_a_joint_of_a_file_comes_back_without_its_files(joint_path, protocol):
    joint = condyle.read_joint(joint_path)
    (joint_path.parent / "walk.csv").write_text("time,flexion\n0,0\n1,30\n")
    walk = joint.motion(joint_path.parent / "walk.csv")
    pressed = condyle.ElasticContact.of_file(joint).at(joint.pose(flexion_deg=140))
    state = pickle.dumps(joint, protocol)
    (joint_path.parent / "walk.csv").rename(joint_path.parent.parent / "walk.csv")
    shutil.rmtree(joint_path.parent)
    again = pickle.loads(state)
    require_same(joint, again)
    np.testing.assert_array_equal(again.motion(joint_path.parent.parent / "walk.csv").X_FM, walk.X_FM)
    elastic = condyle.ElasticContact.of_file(again).at(again.pose(flexion_deg=140))
    assert elastic.energy_nmm == pressed.energy_nmm and elastic.force_n.tolist() == pressed.force_n.tolist()
    assert pickle.dumps(again, protocol) == state


def test_a_joint_of_soups_keeps_the_numbers_of_its_corners(hip):
    joint = condyle.Joint(soup(hip.fixed), soup(hip.mobile), centre="fit", name="soup", side="right", landmarks=None, fixed_in_W=np.eye(4))
    again = pickle.loads(pickle.dumps(joint))
    require_same(joint, again)
    np.testing.assert_array_equal(joint.fixed.vertex_map, again.fixed.vertex_map)
    np.testing.assert_array_equal(joint.depths(POSE).mobile.depth_mm, again.depths(POSE).mobile.depth_mm)


def test_frames_of_every_kind_come_back(hip):
    pelvis = {"right_asis": (0, 80, 120), "left_asis": (0, 80, -120), "right_psis": (-150, 80, 40), "left_psis": (-150, 80, -40)}
    femur = {"medial_epicondyle": (0, -400, -40), "lateral_epicondyle": (0, -400, 40)}
    for landmarks in (pelvis, {**pelvis, **femur}, femur, {**femur, "hip_centre": (0, 0, 0)}):
        joint = condyle.Joint(hip.fixed, hip.mobile, landmarks=landmarks, centre=None if "hip_centre" in landmarks else
                              (1, 2, 3), kind="free", joint="hip", translation_frame="joint_axes")
        assert described(pickle.loads(pickle.dumps(joint))) == described(joint)


def test_copies_of_a_joint_are_the_joint(hip):
    assert copy.copy(hip) is hip and copy.deepcopy([hip])[0] is hip


def test_a_range_of_motion_comes_back_and_is_asked_on(tmp_path, coarse_bones):
    joint = condyle.Joint(*coarse_bones, kind="free", name="hip")
    rom = joint.range_of_motion(["flexion", condyle.Motion("mine", "extension", 90, {})], translation_mm=np.array([0.1, 0.2, 0.3]))
    again = pickle.loads(pickle.dumps(rom))
    for each in (lambda rom: rom.limits, lambda rom: rom.notes, repr, lambda rom: rom._said, lambda rom: rom.held_translation_mm,
                 lambda rom: rom.known_motions):
        assert each(again) == each(rom)
    assert again._made is None, "nothing is asked anew before it is needed"
    assert again.bands(samples=20) == rom.bands(samples=20) and again.limit("fadir") == rom.limit("fadir")
    assert again.bearing["triangles"].tolist() == rom.bearing["triangles"].tolist() and again.left_out == rom.left_out
    for name, each in (("a", rom), ("b", again)):
        each.write_report(tmp_path / f"{name}.html")
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()
    assert copy.copy(rom) is rom and copy.deepcopy([rom])[0] is rom


def test_copies_of_plans_are_the_plans(coarse_bones):
    """A copy lost what a report shows of it."""
    joint = condyle.Joint(*coarse_bones)
    plan = joint.resection({"flexion": 5}, curve_points=0, band_samples=0)
    assert copy.deepcopy(plan) is copy.copy(plan) is plan


def band_of(rom):
    return rom.bands(samples=20)


def limit_of(joint):
    return joint.range_of_motion(["flexion"]).limits[0].limit_deg


def test_another_process_answers_the_same(hip):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(limit_of, [hip]) == [limit_of(hip)]
        rom = hip.range_of_motion(["flexion"])
        assert pool.map(band_of, [rom]) == [band_of(rom)]


def test_what_is_cut_off_or_of_another_version_is_refused(hip):
    state = hip._native.__getstate__()
    remade = type(hip._native).__new__(type(hip._native))
    for wrong, says in ((state[:200], "is cut off"), (b"", "is cut off"),
                        (state.replace(condyle.__version__.encode(), b"9.9.9"[:len(condyle.__version__)], 1), "9.9.9")):
        refused(lambda: remade.__setstate__(wrong), says)


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_what_is_pickled_comes_back_or_raises_by_every_protocol(hip, protocol):
    """Protocols 0 and 1 ended the process for everything that holds a compiled object."""
    assert limit_of(pickle.loads(pickle.dumps(hip, protocol))) == limit_of(hip)
    assert limit_of(condyle.Joint._of_native(pickle.loads(pickle.dumps(hip._native, protocol)))) == limit_of(hip)
    rom = hip.range_of_motion(["flexion"])
    assert pickle.loads(pickle.dumps(rom, protocol)).limits == rom.limits
    holders = [rom, hip.fixed, condyle.RadialTable(hip.fixed), condyle.JointContact(hip.fixed, hip.mobile),
               condyle.FirstContact(hip.fixed, hip.mobile, (0, 0, 0), (0, 0, 1)), condyle.DepthRange(hip, 1),
               condyle.RingTable(hip.fixed, (0, 0, 0), (0, 0, 1))]
    compiled = [getattr(holder, name) for holder in holders for name in dir(holder)
                if not name.startswith("__") and type(getattr(holder, name)).__module__ == "condyle._native"]
    assert len(compiled) >= 5
    for each in [*holders, *compiled]:
        try:
            pickle.loads(pickle.dumps(each, protocol))
        except TypeError as error:
            assert "pickle" in str(error)
