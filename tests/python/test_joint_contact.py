"""Two bodies that deform answer as bodies made anew."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest
from common import lifted, refused, soup

import condyle

LAYER = condyle.ElasticLayer(12, 0.42, 1.65)


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
        pose = lifted(0.1 * step)
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
    corners, triangles = soup(layers.femoral)
    contact = condyle.JointContact(layers.acetabular, (corners, triangles))
    contact.update("mobile", 1.002 * corners)
    anew = condyle.JointContact(layers.acetabular, (1.002 * corners, triangles))
    same(contact, anew, np.eye(4))
    torn = np.array(corners)
    torn[0] += 1
    refused(lambda: contact.update("mobile", torn), "no longer in one place")
    refused(lambda: contact.update("mobile", corners[:1], moved=[0]), "merged vertices")
    same(contact, anew, np.eye(4))


def test_a_refused_update_changes_nothing(layers: condyle.SampleCartilages) -> None:
    contact = condyle.JointContact(layers.acetabular, layers.femoral)
    vertices = np.array(layers.femoral.vertices)
    before = contact.penetration(np.eye(4))
    refused(lambda: contact.update("mobile", vertices[:3]), "vertices gives 3")
    refused(lambda: contact.update("femur", vertices), "body")  # type: ignore[arg-type]
    refused(lambda: contact.update("mobile", vertices[:2], moved=[4, 4]), "twice")
    vertices[5] = np.nan
    refused(lambda: contact.update("mobile", vertices), "vertices")
    np.testing.assert_array_equal(contact.penetration(np.eye(4)).mobile.depth_mm, before.mobile.depth_mm)


def test_pressure_follows_bodies_to_the_bit(layers: condyle.SampleCartilages) -> None:
    rng = np.random.default_rng(2)
    def made(fixed: condyle.MeshLike, mobile: condyle.MeshLike) -> condyle.ElasticContact:
        return condyle.ElasticContact(fixed, mobile, fixed_layer=LAYER, mobile_layer=LAYER)

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
    refused(lambda: contact.update("fixed", mobile[:2]), "vertices gives 2")


def test_a_contact_is_not_deformed_by_the_progress_of_its_own_question(layers: condyle.SampleCartilages) -> None:
    contact = condyle.ElasticContact(layers.acetabular, layers.femoral, mobile_layer=LAYER)
    poses = np.tile(np.eye(4), (2, 1, 1))

    def deform(done: int, total: int) -> None:
        contact.update("mobile", 1.001 * layers.femoral.vertices)

    refused(lambda: contact.at(poses, progress=deform), "not while it is asked")
    contact.update("mobile", 1.001 * layers.femoral.vertices)


def depths(contact: condyle.JointContact) -> object:
    return len(contact.penetration(np.eye(4)).mobile)


def energy(contact: condyle.ElasticContact) -> object:
    return contact.at(np.eye(4)).energy_nmm


@pytest.mark.parametrize("kind, answer, options", [(condyle.JointContact, depths, {}), (condyle.ElasticContact, energy, {"mobile_layer": LAYER})])
def test_threads_ask_while_another_deforms(kind: Any, answer: Any, options: Any, layers: condyle.SampleCartilages) -> None:
    small, large = np.array(layers.femoral.vertices), 1.002 * layers.femoral.vertices
    known = {answer(kind(layers.acetabular, (vertices, layers.femoral.triangles), **options)) for vertices in (small, large)}
    contact = kind(layers.acetabular, layers.femoral, **options)
    seen: set[object] = set()
    done = threading.Event()

    def ask() -> None:
        while not done.is_set():
            seen.add(answer(contact))

    threads = [threading.Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for step in range(100):
        contact.update("mobile", large if step % 2 else small)
        if options:
            contact.forces(np.eye(4))
    done.set()
    for thread in threads:
        thread.join()
    assert seen <= known
