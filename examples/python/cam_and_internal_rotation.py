#!/usr/bin/python3
"""Effect of a cam on internal rotation: 20 sample hips of different shape, each without and with one.

Usage: cam_and_internal_rotation.py [PICTURE [HIPS]]

Each hip has a femur and a socket drawn from how living hips differ; its cam has an alpha angle of 75 degrees. Internal
rotation at 90 degrees of flexion ends where bone meets bone. PICTURE is a .pdf, .svg or .png.
"""
import sys

import condyle
import condyle.plot as figures
import matplotlib.pyplot as plt
import numpy as np

MOTION = "internal_rotation_at_90_flexion"
ALPHA_DEG = 75.0
# Mean and standard deviation of adults, degrees, rounded: neck and socket vary by some 5 to 8 degrees between people.
SHAPES = {"femoral_anteversion_deg": (15, 8), "neck_shaft_angle_deg": (127, 4), "acetabular_version_deg": (18, 5),
          "lateral_centre_edge_angle_deg": (32, 4)}


def internal_rotation_deg(**measures):
    bones = condyle.sample_hip(**measures)
    joint = condyle.Joint(bones.hip_bone, bones.femur, side="right")
    return joint.range_of_motion([MOTION])[MOTION].limit_deg


def hips(count):
    """Measures of hips; nothing beyond two standard deviations, where shapes become odd."""
    random = np.random.default_rng(2009)
    for _ in range(count):
        yield {name: mean + deviation * np.clip(random.normal(), -2, 2) for name, (mean, deviation) in SHAPES.items()}


def draw(anteversion_deg, without, with_cam):
    with figures.print_style():
        figure, (left, right) = plt.subplots(1, 2, figsize=figures.size_mm(130, 60), layout="constrained")
        left.plot([0, 1], np.stack((without, with_cam)), "o-", color=figures.style.BLUE, linewidth=0.6, markersize=2.5,
                  alpha=0.7)
        left.plot([0, 1], [np.mean(without), np.mean(with_cam)], "D-", color=figures.style.VERMILION, label="mean",
                  zorder=3)
        left.set_xticks([0, 1], ["no cam", f"alpha {ALPHA_DEG:g}°"])
        left.set_xlim(-0.2, 1.2)
        left.set_ylim(bottom=min(0, with_cam.min()))
        left.set_ylabel("internal rotation\nat 90° flexion (°)")
        left.legend()
        right.plot(anteversion_deg, without - with_cam, "o", color=figures.style.BLUE, markersize=3)
        right.set_xlabel("femoral anteversion (°)")
        right.set_ylabel("taken by the cam (°)")
        right.set_ylim(0, 5 * np.ceil(np.max(without - with_cam) / 5))
    return figure


def main(picture=None, count=20):
    shapes = list(hips(int(count)))
    without = np.array([internal_rotation_deg(**shape) for shape in shapes])
    with_cam = np.array([internal_rotation_deg(**shape, alpha_angle_deg=ALPHA_DEG) for shape in shapes])
    lost = without - with_cam
    print(f"{len(shapes)} hips: internal rotation {without.mean():.1f} deg without a cam, "
          f"{with_cam.mean():.1f} with one; "
          f"it takes {lost.min():.1f} to {lost.max():.1f} deg")
    if picture:
        figures.save(draw(np.array([shape["femoral_anteversion_deg"] for shape in shapes]), without, with_cam), picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
