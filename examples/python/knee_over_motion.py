#!/usr/bin/python3
"""A knee over its motion: contact and pressure of a passively bent knee, with what is published of it drawn over ours.

Usage: CONDYLE_DATA=... knee_over_motion.py GEOMETRY [PICTURE [FRAMES]]

The knee, its motion and the published contact are those of Lenhart et al. 2015 as OpenSim-JAM comes with them
(docs/knee.md). The joint is made of the model as it is, osim_lenhart2015/lenhart2015.osim in the folder CONDYLE_DATA;
GEOMETRY is the folder of the meshes that it names. Every FRAMES-th frame is computed, all if not given.
"""
import os
import sys
from pathlib import Path

import condyle
import condyle.plot as figures
import numpy as np

DATA = Path(os.environ.get("CONDYLE_DATA", ""))
KNEE = DATA / "knee_lenhart2015_right"
MODEL = DATA / "osim_lenhart2015" / "lenhart2015.osim"
# Column of curves.csv: of the published table, and how many of our units are one of its.
PUBLISHED = {"area_mm2": ("contact_area", 1e6), "mean_depth_mm": ("mean_proximity", 1e3),
             "max_depth_mm": ("max_proximity", 1e3), "mean_pressure_mpa": ("mean_pressure", 1e-6),
             "max_pressure_mpa": ("max_pressure", 1e-6), "force_x_n": ("contact_force_x", 1),
             "force_y_n": ("contact_force_y", 1), "force_z_n": ("contact_force_z", 1)}


def published():
    table = condyle.read_motion_table(KNEE / "passive_flexion_contact_reference.sto")
    columns = {name: factor * table[f"tf_contact.casting.total.{column}"]
               for name, (column, factor) in PUBLISHED.items()}
    return {"time_s": table["time"], **columns}


def main(geometry, picture=None, every=1):
    joint = condyle.Joint.from_model(condyle.read_model(MODEL, geometry=geometry), "knee_r")
    contact = condyle.ElasticContact.of_file(joint)
    motion = joint.motion(KNEE / "passive_flexion_states.sto")
    chosen = slice(None, None, int(every))
    ours = figures.table_of(motion.time[chosen], contact.at(motion.X_FM[chosen]))
    theirs = {name: values[chosen] for name, values in published().items()}
    worst = max(np.max(np.abs(ours[name] - theirs[name])) / np.max(np.abs(theirs[name])) for name in PUBLISHED)
    print(f"{len(ours['time_s'])} frames, {len(PUBLISHED)} numbers each: "
          f"off by at most {worst:.0e} of the largest published")
    if picture:
        figures.save(figures.panels(ours, label="Condyle", reference=theirs, reference_label="published"), picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
