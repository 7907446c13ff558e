"""Two meshes without a joint."""

import importlib
import itertools
import re
import sys
from fractions import Fraction

import numpy as np
import pytest
from common import refused

import condyle

CORNERS = np.array(list(itertools.product((0, 1), repeat=3)), float)
FACES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
BOX = CORNERS, FACES


def moved(x, y=0.0, z=0.0):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def test_one_pose_has_the_keys_of_the_files():
    answer = condyle.touch(BOX, BOX, moved(0.75, 0.25, 0.125), along=[[2, 0, 0], [0, 0, -1]], measures=True)
    assert isinstance(answer, condyle.TouchRecord)
    assert answer.in_contact and answer.inside is None and answer.nearest_distance_mm is None
    assert answer.intersecting_pairs == len(condyle.JointContact(BOX, BOX).pairs(moved(0.75, 0.25, 0.125)))
    assert answer.deepest.depth_mm == pytest.approx(0.25, abs=1e-12)
    assert answer.volume_mm3 == pytest.approx(0.25 * 0.75 * 0.875, abs=1e-12)
    assert [each.distance_mm for each in answer.free] == pytest.approx([0.25, 1.125], abs=1e-12)
    assert answer.notes == []
    assert condyle.touch(BOX, BOX, moved(0.75)).volume_mm3 is None


def test_many_poses_are_arrays():
    poses = np.stack([moved(0.75, 0.1, 0.1), moved(3), moved(1)])
    answers = condyle.touch(BOX, BOX, poses)
    assert len(answers) == 3 and isinstance(answers[1:], condyle.Answers)
    assert answers["in_contact"].tolist() == [True, False, True]
    np.testing.assert_allclose(answers["deepest.depth_mm"], [0.25, np.nan, np.nan], atol=1e-12)
    np.testing.assert_allclose(answers["nearest_distance_mm"], [np.nan, 2, np.nan], atol=1e-12)
    assert answers["nearest_fixed_mm"].shape == (3, 3)
    assert [condyle.touch(BOX, BOX, pose) for pose in poses] == list(answers)
    refused(lambda: answers["free"], kind=KeyError)
    refused(lambda: answers["depth"], kind=KeyError)
    assert len(condyle.touch(BOX, BOX, np.empty((0, 4, 4)))) == 0


def test_files_notes_and_one_spelling_for_one_and_many(tmp_path):
    for name, (vertices, faces) in {"a.ply": BOX, "b.ply": (CORNERS, FACES + FACES)}.items():
        condyle.write_mesh(tmp_path / name, condyle.TriMesh(vertices, faces))
    assert condyle.touch(str(tmp_path / "a.ply"), BOX, moved(0.75)) == condyle.touch(BOX, BOX, moved(0.75))
    with pytest.warns(condyle.JointWarning, match="doubled_triangles: the mobile body has 12 of its 24"):
        answer = condyle.touch(tmp_path / "a.ply", tmp_path / "b.ply", moved(0.75, 0.25, 0.125), measures=True)
    assert answer["mobile_covered_again_mm3"] == pytest.approx(0.25 * 0.75 * 0.875, abs=1e-12)
    assert answer["deepest.depth_mm"] == answer.deepest.depth_mm and condyle.touch(BOX, BOX, moved(3))["deepest.depth_mm"] is None
    table = condyle.touch(BOX, BOX, [moved(0.75, 0.1, 0.1), moved(3)]).to_dataframe()
    assert table["deepest.depth_mm"].isna().tolist() == [False, True] and table["nearest_fixed_mm.x"][1] == 1
    assert answer.to_dataframe()["deepest.depth_mm"].tolist() == [answer.deepest.depth_mm]


def test_a_slide_and_a_turn_are_closed_forms():
    slide = condyle.slide(BOX, BOX, [3, 0, 0], moved(-4, 0.5))
    assert slide.free_at_start and slide.negative.moved_mm is None
    assert slide.positive.moved_mm == pytest.approx(3, abs=1e-12)
    assert [each.low_mm for each in slide.free] == [None, pytest.approx(5, abs=1e-12)]
    # Turned by t about z, the corner (2, 0) of B is at 2 (cos t, sin t), and meets the face y = 1 of A at 30 degrees.
    corner = [[1, 1, -1], [3, 1, -1], [1, 2, -1], [1, 1, 2]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    turn = condyle.turn(corner, (CORNERS * [2, -0.1, 1], np.array(FACES)[:, ::-1]), [0, 0, 1])
    assert turn.positive.turned_deg == pytest.approx(30, abs=1e-9)
    assert turn.free[0].high_deg == turn.positive.turned_deg
    assert condyle.turn(BOX, BOX, [0, 0, 1], [5, 5, 0], [moved(9)])["free_at_start"].tolist() == [True]


def test_features_have_the_numbers_that_were_given():
    soup = CORNERS[np.array(FACES).reshape(-1)], np.arange(36).reshape(12, 3)  # merged for the search
    tip = [[-0.5, 0.3, 0.4], [-2, 0, 0], [-2, 1, 0], [-2, 0, 1]], [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]
    centre = np.array([0.5, 3, 0])
    turn = condyle.turn(tip, soup, [0, 0, 1], centre)
    assert turn.free_at_start
    for sense, end in ((-1, turn.negative), (1, turn.positive)):
        t = np.radians(sense * end.turned_deg)
        rotation = np.array([[np.cos(t), np.sin(t), 0], [-np.sin(t), np.cos(t), 0], [0, 0, 1]])
        turned = (soup[0] - centre) @ rotation + centre
        feature = end.features.mobile
        ids = [feature.id] if feature.kind == "vertex" else feature.vertices or soup[1][feature.id]
        ends = turned[ids] - end.contact_point_mm
        # The point of contact is on the feature: the least singular value of its corners seen from there is 0.
        assert np.linalg.svd(ends, compute_uv=False)[-1] < 1e-9


@pytest.mark.parametrize("pose", [np.diag([2.0, 2, 2, 1]), np.diag([-1.0, 1, 1, 1]), np.full((4, 4), np.nan), np.eye(3)])
def test_what_is_no_pose_is_refused(pose):
    refused(lambda: condyle.touch(BOX, BOX, pose))
    refused(lambda: condyle.turn(BOX, BOX, [0, 0, 1], pose=pose))
    refused(lambda: condyle.slide(BOX, BOX, [0, 0, 1], pose))


def test_what_is_no_direction_or_mesh_is_refused():
    refused(lambda: condyle.slide(BOX, BOX, [0, 0, 0]))
    refused(lambda: condyle.turn(BOX, BOX, [0, np.nan, 1]))
    refused(lambda: condyle.touch(BOX, BOX, along=[1, 0, 0]))
    refused(lambda: condyle.touch(BOX, ([[0, 0, 0]], np.empty((0, 3), int))), kind=condyle.MeshError)
    sheet = [[0, 0, 0.5], [2, 0, 0.5], [0, 2, 0.5]], [[0, 1, 2]]
    answer = condyle.touch(BOX, sheet)
    assert answer.in_contact and [note.code for note in answer.notes] == ["unlikely_size", "open_mesh"]


def test_the_lines_of_the_page_for_others_run(source):
    page = (source / "docs/coming-from.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) == 2
    for block in blocks:
        if "vtkmodules" in block:
            pytest.importorskip("vtkmodules")
        exec(compile(block, "coming-from.md", "exec"), {})


FACE = [(0, 0, 0), (2, 0, 0), (0, 2, 0)]
EDGE = [(-1, 0, 0), (1, 0, 0)]
BESIDE = 1e-12


@pytest.mark.parametrize("kind, points, way, meets", [
    (0, [(0.5, 0.5, 1), *FACE], (0, 0, -1), True),
    (0, [(0.5, 0.5, 1), *FACE], (0, 0, -1 + BESIDE), False),  # ends before it
    (0, [(1, 1, 1), *FACE], (0, 0, -1), True),  # on the long side
    (0, [(1, 1 + BESIDE, 1), *FACE], (0, 0, -1), False),
    (0, [(0.5, 0.5, 1), *FACE], (0.5, 0.5 - BESIDE, -1), True),  # beside it, from a side
    (0, [(0.5, 0.5, 1), *FACE], (0.5, 0.5 + BESIDE, -1), False),
    (0, [(3, 0.5, 0), *FACE], (-2, 0, 0), True),  # in the plane of the face
    (0, [(3, 0.5, BESIDE), *FACE], (-2, 0, 0), False),
    (0, [(1, 1, 0), *FACE], (0, 0, 0), True),  # at rest
    (0, [(1, 1 + BESIDE, 0), *FACE], (0, 0, 0), False),
    (1, [(0, -1, 1), (0, 1, 1), *EDGE], (1 - BESIDE, 0, -1), True),
    (1, [(0, -1, 1), (0, 1, 1), *EDGE], (1 + BESIDE, 0, -1), False),
    (1, [(0, 0, 1), (3, 0, 1), *EDGE], (1, 0, -1), True),  # parallel
    (1, [(0, 0, 1), (3, 0, 1), *EDGE], (1 + BESIDE, 0, -1), False),
    (1, [(2, 0, 0), (3, 0, 0), *EDGE], (-1, 0, 0), True),  # along each other
    (1, [(2, BESIDE, 0), (3, BESIDE, 0), *EDGE], (-1, 0, 0), False),
])
def test_slides_answer_queries_of_vertices_and_edges(source, monkeypatch, kind, points, way, meets):
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.syspath_prepend(source / "bench/other_suites")
    queries = importlib.import_module("slide_queries")
    exact = [tuple(Fraction(x) for x in p) for p in [*points, way]]
    assert queries.Translation(kind, exact[:4], exact[4]).holds_contact() == meets
    assert queries.meet(kind, exact[:4], exact[4]) == meets
