"""What a joint says of itself, and slices of what many poses show."""

import numpy as np
import pytest

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
    with pytest.raises(IndexError):
        many[5]


@pytest.fixture(scope="module")
def layered(tmp_path_factory):
    """A hip whose femur is of its bone and its cartilage, which is called bearing."""
    folder = tmp_path_factory.mktemp("layered")
    bones, layers = condyle.sample_hip(scenario=1), condyle.sample_cartilages()
    meshes = {"hip_bone": bones.hip_bone, "femur": bones.femur, "cartilage": layers.femoral}
    for name, mesh in meshes.items():
        condyle.write_mesh(folder / f"{name}.vtp", mesh)
    (folder / "hip.toml").write_text("""
        condyle = 1
        name = "hip"
        kind = "ball"
        side = "right"
        units = "mm"
        fixed = { name = "hip bone", mesh = "hip_bone.vtp" }
        mobile = { name = "femur", meshes = [{ name = "bone", mesh = "femur.vtp" },
                             { name = "cartilage", mesh = "cartilage.vtp", bearing = true }] }
        frame = { centre = [0.0, 0.0, 0.0], anterior = [1.0, 0.0, 0.0], superior = [0.0, 1.0, 0.0] }
        """)
    return condyle.read_joint(folder / "hip.toml"), meshes


def test_parts_of_a_body_are_told_by_name(layered):
    joint, meshes = layered
    assert joint.fixed_parts == ()
    bone, cartilage = joint.mobile_parts
    assert (bone.name, cartilage.name) == ("bone", "cartilage")
    assert bone.first_vertex == 0 and cartilage.first_vertex == bone.vertices == len(meshes["femur"].vertices)
    assert cartilage.triangles == len(meshes["cartilage"].triangles)
    assert joint.translation_frame == "fixed"
