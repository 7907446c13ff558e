"""Pressure and loads: a block on a plane has closed forms, and frames are balanced as single poses are."""

import numpy as np
import pytest
from common import box, lifted, refused, soup

import condyle

PLANE, BLOCK = box((-40, -10, -40), (40, 0, 40)), box((-5, 0, -5), (5, 5, 5))
LAYER = condyle.ElasticLayer(youngs_modulus_mpa=10, poisson_ratio=0.25, thickness_mm=2)
# A layer that cannot spread sideways: (1 - nu) E / ((1 + nu) (1 - 2 nu)) = 12 MPa, so 6 MPa per mm of 2 mm.
STIFFNESS = 12 / 2
AREA = 100.0
FREE = {"free_directions": [[0, 1, 0]]}


def on_the_plane(**options: object) -> condyle.ElasticContact:
    return condyle.ElasticContact(PLANE, BLOCK, fixed_layer=LAYER, casting="mobile", **options)


def test_a_block_on_a_plane_is_pushed_by_stiffness_times_depth() -> None:
    found = on_the_plane().at(lifted(-0.3))
    assert found.force_n == pytest.approx([0, STIFFNESS * 0.3 * AREA, 0], rel=1e-12, abs=1e-9)
    assert found.mobile.totals.area_mm2 == pytest.approx(AREA, rel=1e-12)
    assert found.mobile.totals.max_pressure_mpa == pytest.approx(STIFFNESS * 0.3, rel=1e-12)
    assert found.fixed is None


def test_a_thickness_for_each_vertex_counts_as_the_constant_one_does() -> None:
    everywhere = condyle.ElasticLayer(10, 0.25, np.full(8, 2.0))
    contact = condyle.ElasticContact(PLANE, BLOCK, fixed_layer=everywhere, casting="mobile")
    assert contact.at(lifted(-0.3)).force_n == pytest.approx(on_the_plane().at(lifted(-0.3)).force_n, rel=1e-12)


def test_frames_are_balanced_where_the_closed_form_says() -> None:
    contact = on_the_plane()
    forces = np.array([[0, -120.0, 0], [0, -300.0, 0], [0, -600.0, 0]])
    found = contact.balance_along([lifted(-0.1)] * 3, forces, **FREE)
    assert [pose.outcome for pose in found] == ["balanced"] * 3
    assert all(pose.carries_load for pose in found)
    depths = [-pose.X_FM[1, 3] for pose in found]
    assert depths == pytest.approx(-forces[:, 1] / (STIFFNESS * AREA), abs=1e-9)
    one_load = contact.balance_along([lifted(-0.1)] * 2, [0, -300, 0], **FREE)
    assert [-pose.X_FM[1, 3] for pose in one_load] == pytest.approx([0.5, 0.5], abs=1e-9)


def test_one_force_with_moments_of_each_frame_and_the_reverse_are_balanced() -> None:
    contact = on_the_plane()
    expected = contact.balance_along([lifted(-0.1)] * 2, [[0, -300, 0]] * 2, moment_nmm=[[0, 0, 0]] * 2, **FREE)
    for force, moment in (([0, -300, 0], [[0, 0, 0]] * 2), ([[0, -300, 0]] * 2, [0, 0, 0]), ([[0, -300, 0]], [0, 0, 0])):
        found = contact.balance_along([lifted(-0.1)] * 2, force, moment_nmm=moment, **FREE)
        assert [pose.X_FM.tolist() for pose in found] == [pose.X_FM.tolist() for pose in expected]
    refused(lambda: contact.balance_along([lifted(-0.1)] * 2, [[0, -300, 0]] * 2, moment_nmm=[[0, 0, 0]] * 3, **FREE), "3 moments for 2 forces")
    refused(lambda: contact.balance_along([lifted(-0.1)] * 2, [0, -300, 0], moment_nmm=[[0, 0, 0], [0, 0, 1]], **FREE), "needs free_rotations")


def test_gaps_of_a_motion_stay_gaps() -> None:
    contact = on_the_plane()
    gap = np.full((4, 4), np.nan)
    found = contact.balance_along([lifted(-0.1), gap, lifted(-0.1)], [0, -300, 0], **FREE)
    assert found[1] is None and [pose.outcome for pose in (found[0], found[2])] == ["balanced"] * 2
    torn = lifted(-0.1)
    torn[0, 0] = np.nan
    refused(lambda: contact.balance_along([lifted(-0.1), torn], [0, -300, 0], **FREE), "pose 1: finite numbers are needed")


def test_a_search_for_balance_ends_where_its_options_say() -> None:
    contact = on_the_plane()
    near = contact.balance([0, -300, 0], start=lifted(3), options=condyle.BalanceOptions(farthest_mm=1), **FREE)
    assert near.outcome == "pulled_apart"
    assert contact.balance([0, -300, 0], start=lifted(3), **FREE).outcome == "balanced"
    jump = on_the_plane(reach_mm=0.5)
    strict = condyle.BalanceOptions(most_left_at_jump=0.001)
    assert jump.balance([0, -303, 0], start=lifted(-0.3), options=strict, **FREE).outcome == "over_the_rim"
    for wrong in ({"farthest_mm": -1}, {"most_steps": 1.5}, {"most_left_at_jump": 2}):
        refused(lambda: contact.balance([0, -300, 0], options=condyle.BalanceOptions(**wrong), **FREE))


def test_rays_cut_off_by_the_reach_are_counted() -> None:
    assert on_the_plane().cut_off_by_reach(lifted(-0.3)) == 0
    assert on_the_plane(reach_mm=0.2).cut_off_by_reach(lifted(-0.3)) > 0


def test_a_load_that_no_pose_carries_is_reported() -> None:
    pulled = on_the_plane().balance([0, 10, 0], start=lifted(-0.1), **FREE)
    assert pulled.outcome == "pulled_apart" and not pulled.carries_load and "pulls the bodies apart" in pulled.reason


def test_a_force_that_jumps_is_reported_with_its_residual() -> None:
    # At the reach of 0.5 mm the block carries 300 N, and nothing beyond.
    contact = on_the_plane(reach_mm=0.5)
    found = contact.balance([0, -303, 0], start=lifted(-0.3), **FREE)
    assert found.outcome == "at_jump" and found.carries_load
    assert 3 <= np.linalg.norm(found.residual_force_n) <= 0.02 * 303


@pytest.mark.parametrize("forces", [[[0, -1, 0]] * 2, [[0, 1], [2]], "much", [[0, 0, 0]]])
def test_wrong_loads_are_refused_in_one_line(forces: object) -> None:
    refused(lambda: on_the_plane().balance_along([lifted(-0.1)] * 3, forces))


def test_forces_of_a_sliding_block_have_their_closed_form() -> None:
    contact, N = on_the_plane(), STIFFNESS * 0.3 * AREA
    found = contact.forces(lifted(-0.3), velocity_mm_s=[3, -2, 4], friction=0.2, slip_velocity_mm_s=0.5, damping_s_per_mm=0.1)
    pressed, slides = N * (1 + 0.1 * 2), 5 / np.hypot(5, 0.5)
    along = np.array([0.6, 0, 0.8])
    assert found.force_n == pytest.approx(pressed * ([0, 1, 0] - 0.2 * slides * along), rel=1e-12)
    assert found.friction_power == pytest.approx(0.2 * pressed * slides * 5, rel=1e-12)
    assert found.damping_power == pytest.approx((pressed - N) * 2, rel=1e-11)
    assert found.energy_nmm == pytest.approx(N * 0.3 / 2, rel=1e-12)
    assert found.factor == 1
    assert found.stiffness is found.on_fixed is found.on_mobile is found.vertex_stiffness is found.patches is None


def test_forces_on_vertices_and_their_stiffness_add_up() -> None:
    contact = on_the_plane()
    turned = lifted(-0.3)
    turned[:3, :3] = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    found = contact.forces(turned, stiffness=True, vertex_stiffness=True, patches=True)
    k = STIFFNESS * AREA
    assert found.stiffness.shape == (6, 6)
    assert found.stiffness[:3, :3] == pytest.approx(np.diag([0, k, 0]), abs=1e-9)
    for on, rotation, sign in ((found.on_fixed, np.eye(3), -1), (found.on_mobile, turned[:3, :3], 1)):
        assert (np.diff(on.vertex.astype(int)) > 0).all() and on.force_n.shape == (len(on), 3)
        assert rotation @ on.force_n.sum(axis=0) == pytest.approx(sign * found.force_n, rel=1e-12, abs=1e-9)
    blocks = found.vertex_stiffness
    size = len(found.on_fixed) + len(found.on_mobile)
    dense = np.zeros((size, 3, size, 3))
    dense[blocks.row, :, blocks.column, :] = blocks.block
    moved = np.tile([0.0, 1, 0], (size, 1))
    moved[:len(found.on_fixed)] = 0
    pushed = np.einsum("aibj,bj->ai", dense, moved)
    assert pushed[len(found.on_fixed):].sum(axis=0) == pytest.approx([0, k, 0], abs=1e-9)
    assert pushed[:len(found.on_fixed)].sum(axis=0) == pytest.approx([0, -k, 0], abs=1e-9)
    (patch,) = found.patches
    assert patch.casting == "mobile" and patch.face.tolist() == contact.at(turned).mobile.face.tolist()
    assert patch.area_mm2 == pytest.approx(AREA) and patch.load_n == pytest.approx(k * 0.3)
    assert patch.max_pressure_mpa == pytest.approx(STIFFNESS * 0.3)
    assert patch.centre_of_pressure[[0, 2]] == pytest.approx([0, 0], abs=1e-9)
    assert not patch.force_n.flags.writeable and not found.stiffness.flags.writeable


def test_vertices_of_a_soup_have_the_numbers_given() -> None:
    vertices, _ = block = soup(BLOCK)
    contact = condyle.ElasticContact(PLANE, block, fixed_layer=LAYER, casting="mobile")
    found = contact.forces(lifted(-0.3), vertex_forces=True).on_mobile
    assert found.vertex.max() >= 8
    assert (vertices[found.vertex][:, 1] == 0).all()


def test_a_ramp_brings_an_overlap_in() -> None:
    contact = on_the_plane()
    ramp = condyle.ContactRamp(contact, lifted(-0.3), 0.2)
    assert ramp.has_overlap and ramp.max_depth_mm == pytest.approx(0.3) and ramp.duration_s == 0.2
    assert ramp.energy_nmm == pytest.approx(STIFFNESS * AREA * 0.3**2 / 2)
    assert [ramp.factor_at(t) for t in (-1, 0, 0.1, 0.2, 9)] == [0, 0, 0.5, 1, 1]
    half = contact.forces(lifted(-0.3), factor=ramp.factor_at(0.1))
    assert half.factor == 0.5 and half.force_n[1] == pytest.approx(STIFFNESS * 0.3 * AREA / 2)
    assert condyle.ContactRamp(contact, lifted(1), 0.2).factor_at(0) == 1


@pytest.mark.parametrize("wrong", [{"friction": -0.1}, {"slip_velocity_mm_s": 0}, {"damping_s_per_mm": -1}, {"factor": 1.5},
                                   {"factor": "all"}, {"velocity_mm_s": [0, 1]}, {"angular_velocity_rad_s": [0, np.nan, 0]}])
def test_wrong_options_of_forces_are_refused_in_one_line(wrong: dict[str, object]) -> None:
    refused(lambda: on_the_plane().forces(lifted(-0.3), **wrong))
    refused(lambda: condyle.ContactRamp(on_the_plane(), lifted(-0.3), 0))


def test_forces_say_as_pressure_does_that_layers_are_compressed_beyond_their_thickness() -> None:
    layers = condyle.sample_cartilages(clearance_mm=-0.3)
    contact = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
    with pytest.warns(condyle.JointWarning, match="no layer is compressed so far"):
        found = contact.forces(np.eye(4), factor=0.5)
    with pytest.warns(condyle.JointWarning, match="no layer is compressed so far"):
        expected = contact.at(np.eye(4))
    assert found.max_strain == max(expected.fixed.max_strain, expected.mobile.max_strain) > 1
    assert "deeper_than_layers" in [note.code for note in found.notes]


# What looks wrong with layers, loads and motions: docs/checks.md.
CARTILAGES = condyle.sample_cartilages(clearance_mm=0)


def contact_of(e_mpa: float = 12, nu: float = 0.42, thickness_mm: float = 1.65, **more: str) -> condyle.ElasticContact:
    layer = condyle.ElasticLayer(e_mpa, nu, thickness_mm)
    return condyle.ElasticContact(CARTILAGES.acetabular, CARTILAGES.femoral, mobile_layer=layer, **more)


def codes(notes: tuple[condyle.ContactNote, ...]) -> list[str]:
    assert all(note.text for note in notes)
    return [note.code for note in notes]


def test_layers_that_nothing_has_are_noted() -> None:
    assert codes(contact_of().notes) == []
    assert codes(contact_of(e_mpa=1e9).notes) == ["unlikely_modulus"]
    assert codes(contact_of(nu=0.4999).notes) == ["unlikely_poisson_ratio"]
    assert codes(contact_of(thickness_mm=1500).notes) == ["unlikely_thickness"]


def test_loads_and_strains_are_noted() -> None:
    contact = contact_of(casting="mobile")
    assert codes(contact.at(lifted(0.2)).notes) == []
    assert codes(contact.at(lifted(1.0)).notes)[0] == "large_strain"
    assert codes(contact.at(lifted(2.0)).notes)[0] == "deeper_than_layers"
    assert codes(contact.balance([0, 800, 0]).notes) == []
    assert codes(contact.balance([0, 9000, 0]).notes)[0] == "unlikely_load"
    assert contact.at(lifted(1.0)).mobile.max_strain > 0.3


def test_motions_that_leave_the_bodies_apart_are_noted() -> None:
    joint = condyle.Joint(CARTILAGES.acetabular, CARTILAGES.femoral, kind="free")
    frames = joint.contact_along([lifted(-100)] * 3, contact_of())
    assert len(frames) == 3 and codes(frames.notes) == ["mostly_apart"]
    assert codes(joint.contact_along([lifted(0.2)] * 3, contact_of()).notes) == []


def test_the_force_of_finer_rays_is_stated() -> None:
    found = contact_of().at(lifted(0.2))
    refined = contact_of().refined_force_n(lifted(0.2))
    assert refined.shape == (3,) and 0 < np.linalg.norm(refined - found.force_n) < 0.1 * np.linalg.norm(found.force_n)
    assert contact_of(rule="face_centre").refined_force_n(lifted(0.2)) is None
    assert found.mobile.oblique_area_mm2 >= 0 and not found.mobile.peak_is_oblique
