"""Implants of sizes: the same meshes and errors as of the command."""
import json
import pickle

import numpy as np
import pytest
from common import refused, run_command

import condyle

ALONE = lambda _, **sizes: condyle.sample_replacement(**sizes)  # noqa: E731
pytestmark = pytest.mark.filterwarnings("ignore::condyle.JointRemark")


def test_the_meshes_are_those_of_the_command(tmp_path):
    made = condyle.sample_replacement(inclination_deg=45, anteversion_deg=20, definition="operative", head_radius_mm=18, facets=96, side="left")
    run_command("sample", "replacement", "--inclination", "45", "--anteversion", "20", "--definition", "operative", "--head-radius", "18", "--facets",
                "96", "--side", "left", "--out", tmp_path)
    for part, mesh in (*made.fixed.items(), *made.mobile.items()):
        written = condyle.read_mesh(tmp_path / f"{part}.ply")
        assert np.array_equal(written.vertices, mesh.vertices) and np.array_equal(written.triangles, mesh.triangles)
    read = condyle.read_joint(tmp_path / "hip.toml")
    assert read.name == made.joint.name and read.side == made.joint.side
    assert np.array_equal(read.mobile.vertices, made.joint.mobile.vertices)
    assert read.range_of_motion().bands(["flexion"], samples=20) == made.joint.range_of_motion().bands(["flexion"], samples=20)


def test_what_is_no_body_of_revolution_has_a_reason():
    lipped = condyle.sample_replacement(bones="none", lip_deg=15)
    assert lipped.half_angle_deg is None
    assert lipped.why_no_half_angle == "a liner with a lip is no body of revolution"


def test_an_implant_in_a_joint_is_that_of_the_command(hip_file, hip, tmp_path):
    placed = hip.implant(inclination_deg=45, definition="anatomic", offset_mm=42, facets=96)
    made = tmp_path / "made"
    run_command("implant", hip_file, "--inclination", "45", "--definition", "anatomic", "--offset", "42", "--facets", "96", "--out", made)
    placed.write(tmp_path / "written")
    files = sorted(path.name for path in made.iterdir())
    assert files == sorted(path.name for path in (tmp_path / "written").iterdir())
    for name in files:
        if name != "implant.json":  # where it comes from
            assert (made / name).read_bytes() == (tmp_path / "written" / name).read_bytes()
    said = json.loads((made / "implant.json").read_text())
    assert said["implant"]["offset_mm"] == placed.sizes["offset_mm"] == 42
    assert said["half_angle_deg"] == placed.half_angle_deg
    assert said["head"] == placed.evidence["head"]
    assert np.array_equal(said["femur_shift_mm"], placed.femur_shift_mm)
    assert placed.of_bones == {"neck_shaft_deg", "stem_version_deg", "cup_radius_mm"}
    read = condyle.read_joint(made / "hip.toml")
    assert read.name == placed.joint.name
    assert np.array_equal(read.mobile.vertices, placed.joint.mobile.vertices)
    assert np.array_equal(read.fixed.triangles, placed.joint.fixed.triangles)
    assert read.parameters["cup.inclination"].value == placed.joint.parameters["cup.inclination"].value


def test_an_implant_in_a_joint_is_asked_as_any_joint(hip):
    placed = hip.implant(neck_shaft_deg=135, stem_version_deg=15, offset_mm=40)
    flexion = placed.joint.range_of_motion(bearing="count").limit("flexion")
    assert flexion.limit_deg == pytest.approx(128.7064, abs=0.002)
    assert flexion.mobile_part == "neck"
    assert placed.cup["radiographic"] == pytest.approx((40, 15))
    assert hip.implant(as_rim=True).cup["radiographic"] == pytest.approx(placed.rim["radiographic"], abs=0.0051)
    assert pickle.loads(pickle.dumps(placed)).sizes == placed.sizes


@pytest.mark.parametrize("ask, arguments, line", [
    (ALONE, {"head_radius_mm": 28}, "a head of radius 28 mm is too large for a cup of radius 27 mm outside: its wall needs 1 mm"),
    (ALONE, {"inclination_deg": float("nan")}, "inclination"),
    (ALONE, {"definition": "surgical"}, "surgical"),
    (ALONE, {"haed_radius_mm": 16}, "haed_radius_mm"),
    (ALONE, {"bones": "some"}, "some"),
    (condyle.Joint.implant, {"as_rim": True, "inclination_deg": 40}, "inclination_deg: not with as_rim"),
    (condyle.Joint.implant, {"centre": "middle"}, "middle"),
    (condyle.Joint.implant, {"head_radius_mm": 28, "cup_radius_mm": 30}, "a head of radius 28 mm does not fit"),
    (condyle.Joint.implant, {"haed_radius_mm": 16}, "haed_radius_mm"),
])
def test_what_does_not_fit_is_one_line(hip, ask, arguments, line):
    assert line in refused(lambda: ask(hip, **arguments))
