"""Two bodies that deform answer as bodies made anew."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import condyle


@pytest.fixture(scope="module")
def layers() -> condyle.SampleCartilages:
    return condyle.sample_cartilages(clearance_mm=-0.1)


def same(found: condyle.JointContact, anew: condyle.JointContact, pose: np.ndarray) -> None:
    for body in ("mobile", "fixed"):
        one, other = (getattr(contact.penetration(pose), body) for contact in (found, anew))
        order, others = np.argsort(one.vertex), np.argsort(other.vertex)
        for column in ("vertex", "state", "triangle", "depth_mm", "direction"):
            np.testing.assert_array_equal(getattr(one, column)[order], getattr(other, column)[others])
    np.testing.assert_array_equal(found.pairs(pose), anew.pairs(pose))
    assert found.in_contact(pose) == anew.in_contact(pose)


def test_updates_are_those_of_contacts_made_anew(layers: condyle.SampleCartilages) -> None:
    rng = np.random.default_rng(1)
    contact = condyle.JointContact(layers.acetabular, layers.femoral)
    fixed, mobile = np.array(layers.acetabular.vertices), np.array(layers.femoral.vertices)
    inside = 0
    for step in range(6):
        pose = np.eye(4)
        pose[1, 3] = 0.1 * step
        if step % 2:
            fixed = layers.acetabular.vertices + rng.normal(0, 0.05, fixed.shape)
            contact.update("fixed", fixed)
        else:
            moved = rng.choice(len(mobile), 30, replace=False)
            mobile[moved] *= 1.005
            contact.update("mobile", mobile[moved], moved=moved)
        anew = condyle.JointContact((fixed, layers.acetabular.triangles), (mobile, layers.femoral.triangles))
        same(contact, anew, pose)
        inside += len(contact.penetration(pose).mobile)
    assert inside > 1000
    np.testing.assert_array_equal(contact.mobile.vertices, mobile)
    np.testing.assert_array_equal(contact.fixed.vertices, fixed)


def test_many_poses_are_one_after_the_other(layers: condyle.SampleCartilages) -> None:
    contact = condyle.JointContact(layers.acetabular, layers.femoral)
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, 1, 3] = [0, 0.2, 0.4]
    many, pairs, touch = contact.penetration(poses), contact.pairs(poses), contact.in_contact(poses)
    for n, pose in enumerate(poses):
        np.testing.assert_array_equal(many[n].mobile.depth_mm, contact.penetration(pose).mobile.depth_mm)
        np.testing.assert_array_equal(pairs[n], contact.pairs(pose))
        assert touch[n] == contact.in_contact(pose)
    assert contact.penetration(poses[0], bodies="mobile").fixed is None


def test_merged_vertices_move_together(layers: condyle.SampleCartilages) -> None:
    soup = layers.femoral.vertices[layers.femoral.triangles].reshape(-1, 3)
    triangles = np.arange(len(soup)).reshape(-1, 3)
    contact = condyle.JointContact(layers.acetabular, (soup, triangles))
    contact.update("mobile", 1.002 * soup)
    anew = condyle.JointContact(layers.acetabular, (1.002 * soup, triangles))
    same(contact, anew, np.eye(4))
    torn = np.array(soup)
    torn[0] += 1
    with pytest.raises(condyle.UsageError, match="no longer in one place"):
        contact.update("mobile", torn)
    with pytest.raises(condyle.UsageError, match="merged vertices"):
        contact.update("mobile", soup[:1], moved=[0])
    same(contact, anew, np.eye(4))


def test_a_refused_update_changes_nothing(layers: condyle.SampleCartilages) -> None:
    contact = condyle.JointContact(layers.acetabular, layers.femoral)
    vertices = np.array(layers.femoral.vertices)
    before = contact.penetration(np.eye(4))
    with pytest.raises(condyle.UsageError, match="vertices gives 3"):
        contact.update("mobile", vertices[:3])
    with pytest.raises(condyle.UsageError, match="body"):
        contact.update("femur", vertices)  # type: ignore[arg-type]
    with pytest.raises(condyle.UsageError, match="twice"):
        contact.update("mobile", vertices[:2], moved=[4, 4])
    vertices[5] = np.nan
    with pytest.raises(condyle.UsageError, match="vertices"):
        contact.update("mobile", vertices)
    np.testing.assert_array_equal(contact.penetration(np.eye(4)).mobile.depth_mm, before.mobile.depth_mm)


def test_threads_ask_while_another_deforms(layers: condyle.SampleCartilages) -> None:
    contact = condyle.JointContact(layers.acetabular, layers.femoral)
    small, large = np.array(layers.femoral.vertices), 1.002 * layers.femoral.vertices
    known = {len(condyle.JointContact(layers.acetabular, (v, layers.femoral.triangles)).penetration(np.eye(4)).mobile)
             for v in (small, large)}
    seen: set[int] = set()
    done = threading.Event()

    def ask() -> None:
        while not done.is_set():
            seen.add(len(contact.penetration(np.eye(4)).mobile))

    threads = [threading.Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for step in range(100):
        contact.update("mobile", large if step % 2 else small)
    done.set()
    for thread in threads:
        thread.join()
    assert seen <= known


def test_pressure_follows_bodies_to_the_bit(layers: condyle.SampleCartilages) -> None:
    rng = np.random.default_rng(2)
    layer = condyle.ElasticLayer(12, 0.42, 1.65)

    def made(fixed: condyle.MeshLike, mobile: condyle.MeshLike) -> condyle.ElasticContact:
        return condyle.ElasticContact(fixed, mobile, fixed_layer=layer, mobile_layer=layer)

    contact = made(layers.acetabular, layers.femoral)
    mobile = np.array(layers.femoral.vertices)
    for step in range(4):
        moved = rng.choice(len(mobile), 40, replace=False)
        mobile[moved] *= 1 + 0.002 * rng.random((40, 1))
        if step % 2:
            contact.update("mobile", mobile)
        else:
            contact.update("mobile", mobile[moved], moved=moved)
        found, anew = contact.at(np.eye(4)), made(layers.acetabular, (mobile, layers.femoral.triangles)).at(np.eye(4))
        np.testing.assert_array_equal(found.force_n, anew.force_n)
        np.testing.assert_array_equal(found.moment_nmm, anew.moment_nmm)
        assert found.energy_nmm == anew.energy_nmm > 0
    np.testing.assert_array_equal(contact.mobile.vertices, mobile)
    with pytest.raises(condyle.UsageError, match="vertices gives 2"):
        contact.update("fixed", mobile[:2])


def test_a_contact_is_not_deformed_by_the_progress_of_its_own_question(layers: condyle.SampleCartilages) -> None:
    contact = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
    poses = np.tile(np.eye(4), (2, 1, 1))

    def deform(done: int, total: int) -> None:
        contact.update("mobile", 1.001 * layers.femoral.vertices)

    with pytest.raises(condyle.UsageError, match="not while it is asked"):
        contact.at(poses, progress=deform)
    contact.update("mobile", 1.001 * layers.femoral.vertices)


def test_pressure_is_asked_while_another_thread_deforms(layers: condyle.SampleCartilages) -> None:
    layer = condyle.ElasticLayer(12, 0.42, 1.65)
    small, large = np.array(layers.femoral.vertices), 1.002 * layers.femoral.vertices
    known = {condyle.ElasticContact(layers.acetabular, (v, layers.femoral.triangles), mobile_layer=layer).at(
        np.eye(4)).energy_nmm for v in (small, large)}
    contact = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=layer)
    seen: set[float] = set()
    done = threading.Event()

    def ask() -> None:
        while not done.is_set():
            seen.add(contact.at(np.eye(4)).energy_nmm)

    threads = [threading.Thread(target=ask) for _ in range(2)]
    for thread in threads:
        thread.start()
    for step in range(60):
        contact.update("mobile", large if step % 2 else small)
        contact.forces(np.eye(4))
    done.set()
    for thread in threads:
        thread.join()
    assert seen <= known
