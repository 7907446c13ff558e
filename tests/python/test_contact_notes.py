"""What looks wrong with layers, loads and motions: docs/checks.md."""

from __future__ import annotations

import numpy as np

from common import lifted

import condyle

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
