"""Random arguments end in an answer or in an error of the module, one line; CONDYLE_FUZZ_EXAMPLES says how many."""

import os

import numpy as np
import pytest

pytest.importorskip("hypothesis")
from common import CORNERS, FACES  # noqa: E402
from hypothesis import HealthCheck, given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402
from hypothesis.extra import numpy as hnp  # noqa: E402

import condyle  # noqa: E402

EXAMPLES = int(os.environ.get("CONDYLE_FUZZ_EXAMPLES", "60"))
OURS = condyle.FileError, condyle.MeshError, condyle.UsageError
fuzz = settings(max_examples=EXAMPLES, deadline=None, database=None,
                derandomize="CONDYLE_FUZZ_EXAMPLES" not in os.environ, suppress_health_check=list(HealthCheck))

numbers = st.one_of(st.floats(allow_nan=True), st.integers(-2**70, 2**70), st.sampled_from([0, 1, -1, 90, 1e-308, 1e308]))
words = st.one_of(st.text(max_size=8), st.sampled_from(["flexion", "extension", "radial", "normal", "count", "cube",
                                                        "fit", "RAS", "left", "free", "hinge", "knee", "m", "fixed"]))
anything = st.recursive(st.one_of(st.none(), st.booleans(), numbers, words, st.binary(max_size=4)),
                        lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(words, inner, max_size=3)), max_leaves=6)
kinds = st.sampled_from([np.dtype(kind) for kind in ("f8", "f4", "f2", ">f8", "i8", "i4", "u1", "u8", "c16", "?", "O", "U3", "M8[s]", "g")])


def arrays(*shapes):
    def of(kind):
        elements = st.just(None) if kind == object else None
        shape = st.one_of(*(st.tuples(*(st.just(n) if n else st.integers(0, 5) for n in each)) for each in shapes),
                          hnp.array_shapes(min_dims=0, max_dims=4, max_side=5))
        return hnp.arrays(kind, shape, elements=elements)
    laid_out = st.sampled_from([lambda a: a, np.asfortranarray, lambda a: a[::-1] if a.ndim else a, lambda a: a.T,
                                lambda a: np.lib.stride_tricks.as_strided(a, writeable=False)])
    return st.builds(lambda a, layout: layout(a), kinds.flatmap(of), laid_out)


def reals(shape, low=-100.0, high=100.0):
    return hnp.arrays(np.float64, shape, elements=st.floats(low, high))


# Well-formed, so that what lies behind the first checks is reached too.
angles = st.floats(-400, 400)
poses = st.one_of(
    st.builds(lambda f, a, r: joint().pose(flexion_deg=f, adduction_deg=a, internal_rotation_deg=r), angles, angles, angles),
    st.builds(lambda f, t: joint().pose(flexion_deg=f) + np.pad(np.array(t)[:, None], ((0, 1), (3, 0))), angles,
              st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=3)),
    st.builds(lambda f, n: np.tile(joint().pose(flexion_deg=f), (n, 1, 1)), angles, st.integers(0, 5)))
any_pose = st.one_of(poses, arrays((4, 4), (0, 4, 4)), anything)
points = st.one_of(reals((4, 3)), reals((0, 3)), arrays((0, 3)), anything)
meshes = st.one_of(
    st.tuples(reals((5, 3)), hnp.arrays(np.int64, (6, 3), elements=st.integers(0, 4))),
    st.tuples(points, st.one_of(arrays((0, 3)), anything)), anything)

_shared = {}


def joint():
    if not _shared:
        bones = condyle.sample_hip(triangles=(1600, 600))
        _shared["joint"] = condyle.Joint(*bones)
        _shared["rom"] = _shared["joint"].range_of_motion([])
        _shared["table"] = condyle.RadialTable(bones.femur)
    return _shared["joint"]


def refused_in_one_line(act):
    try:
        with np.errstate(all="ignore"):
            answer = act()
        repr(answer)
    except OURS as error:
        assert "\n" not in str(error) and str(error)


@fuzz
@given(meshes, st.one_of(st.none(), st.booleans()))
def test_meshes(mesh, merge):
    def act():
        made = condyle.TriMesh.of(mesh) if merge is None else condyle.TriMesh(*mesh, merge=merge) if (
            isinstance(mesh, tuple) and len(mesh) == 2) else condyle.TriMesh.of(mesh, merge=merge)
        condyle.inspect(made)
        return condyle.RadialTable(made).query(made.vertices)
    refused_in_one_line(act)


@fuzz
@given(any_pose, st.one_of(st.sampled_from(["radial", "tangential", "normal"]), words, anything), st.one_of(st.none(), words, anything))
def test_penetration(pose, method, about):
    refused_in_one_line(lambda: joint().penetration(pose, method, about=about))


@fuzz
@given(any_pose, st.sampled_from(["pairs", "in_contact", "gaps", "depths", "contact_measures", "coordinates"]))
def test_questions(pose, name):
    refused_in_one_line(lambda: getattr(joint(), name)(pose))


@fuzz
@given(st.dictionaries(st.one_of(words, st.sampled_from(["flexion_deg", "abduction_deg", "x_mm"])),
                       st.one_of(numbers, arrays((0,)), anything), max_size=4))
def test_poses(coordinates):
    refused_in_one_line(lambda: joint().pose(**coordinates))


@fuzz
@given(points, points, st.one_of(st.none(), arrays((0,)), anything))
def test_tables(vertices, asked, moved):
    table = condyle.RadialTable(condyle.TriMesh([[9, 9, 9], [-9, 9, -9], [-9, -9, 9], [9, -9, -9]], [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]))
    refused_in_one_line(lambda: table.update(vertices, moved=moved))
    refused_in_one_line(lambda: table.query(asked))


@fuzz
@given(st.one_of(reals(3), points), st.one_of(reals(3), points), points)
def test_rings(point, direction, asked):
    joint()
    refused_in_one_line(lambda: condyle.RingTable(joint().mobile, point, direction).query(asked))


@fuzz
@given(st.dictionaries(st.sampled_from(["kind", "joint", "side", "units", "translation_frame", "centre", "fit_body", "fit_within", "axes", "anterior",
                                        "superior", "landmarks", "reference_pose", "fixed_in_W", "mobile_in_W", "name", "fixed_name"]),
                       st.one_of(words, anything, arrays((3,), (4, 4))), max_size=3))
def test_joints(arguments):
    refused_in_one_line(lambda: condyle.Joint((CORNERS, FACES), (CORNERS, FACES), **arguments))


@fuzz
@given(st.one_of(st.none(), anything), st.one_of(words, anything), st.one_of(numbers, anything),
       st.dictionaries(words, st.one_of(numbers, anything), max_size=2))
def test_ranges(motions, vary, range_deg, start):
    joint()
    refused_in_one_line(lambda: _shared["rom"].limit(condyle.Motion("mine", vary, range_deg, start)))
    refused_in_one_line(lambda: _shared["rom"].free_angles(vary, start))
    if motions is not None:
        refused_in_one_line(lambda: joint().range_of_motion(motions))


@fuzz
@given(anything, anything, anything)
def test_grids_bands_and_zones(column, row, number):
    joint()
    rom = _shared["rom"]
    refused_in_one_line(lambda: rom.map(column, row))
    refused_in_one_line(lambda: rom.map({"flexion": column}, {"adduction": row}, start_deg=number))
    refused_in_one_line(lambda: rom.bands(column, samples=number))
    refused_in_one_line(lambda: rom.zones(past_deg=number))


@fuzz
@given(st.one_of(reals(3), anything, arrays((0,))), any_pose, st.one_of(numbers, anything))
def test_recorded_contact(times, pose, resolution):
    refused_in_one_line(lambda: joint().recorded_contact(times, pose, resolution_s=max(resolution, 1e-3) if isinstance(
        resolution, float) else resolution))


@fuzz
@given(st.one_of(numbers, anything), st.one_of(numbers, anything), st.one_of(numbers, points), any_pose,
       st.one_of(reals(3), anything), st.one_of(reals((2, 3)), anything))
def test_layers(modulus, ratio, thickness, pose, force, directions):
    def act():
        contact = condyle.ElasticContact(joint().fixed, joint().mobile, fixed_layer=condyle.ElasticLayer(modulus, ratio, thickness))
        contact.at(pose)
        return contact.balance(force, start=pose, free_directions=directions)
    refused_in_one_line(act)
    steady = condyle.ElasticContact(joint().fixed, joint().mobile, fixed_layer=condyle.ElasticLayer(10, 0.4, 2))
    refused_in_one_line(lambda: steady.balance(force, free_directions=directions))


@fuzz
@given(anything, anything)
def test_files_spheres_and_samples(path, number):
    for read in (condyle.read_mesh, condyle.read_joint, condyle.read_motion_table):
        refused_in_one_line(lambda: read(path))
    refused_in_one_line(lambda: condyle.fit_sphere(path))
    refused_in_one_line(lambda: condyle.find_sphere(joint().mobile, within=path, smallest_radius_mm=number))
    refused_in_one_line(lambda: condyle.sample_hip(triangles=path, head_radius_mm=number))


@fuzz
@given(st.one_of(reals((9, 3)), points), st.one_of(reals(3), anything), st.one_of(reals(3), anything), st.one_of(st.floats(0, 100), anything))
def test_cylinders_and_clocks(given, point, direction, radius):
    refused_in_one_line(lambda: condyle.fit_cylinder(given, point, direction, radius))
    refused_in_one_line(lambda: condyle.find_cylinder(joint().mobile, within=(point, radius)))
    refused_in_one_line(lambda: condyle.clock_face(direction).hour_of(given))
    refused_in_one_line(lambda: condyle.neck_clock(direction).angle_deg_of(point))
    refused_in_one_line(lambda: condyle.find_rim_clock(joint().fixed, (point, radius)))
    refused_in_one_line(lambda: condyle.find_neck_axis(joint().mobile, radius))


@fuzz
@given(any_pose, st.one_of(reals(3), anything), st.one_of(reals(3), anything), st.one_of(numbers, anything), st.one_of(reals(3), anything))
def test_first_contacts_depths_and_frames(pose, point, direction, number, normal):
    refused_in_one_line(lambda: condyle.FirstContact(joint().fixed, joint().mobile, point, direction).limits(pose, positive_deg=number))
    refused_in_one_line(lambda: condyle.DepthRange(joint(), number).deepest({"flexion": number}))
    refused_in_one_line(lambda: joint().contact_along(pose, reach_mm=number))
    faces = joint().normal_contact({"flexion_deg": 140}, casting="mobile").mobile
    refused_in_one_line(lambda: faces.within((normal, number)))
