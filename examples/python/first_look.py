"""A first look at a hip: from meshes to limits in twelve lines."""

import condyle

bones = condyle.sample_hip()  # or condyle.read_mesh("hip_bone.stl"), condyle.read_mesh("femur.stl")
print(condyle.inspect(bones.femur))
joint = condyle.Joint(bones.hip_bone, bones.femur, centre="fit", name="right hip")
print(*joint.processing, sep="\n")  # the fit of the centre
for note in joint.notes:  # what looks wrong; the first answer warns of it too
    print(note.code, note.text)

pose = joint.pose(flexion_deg=140)
print(joint.depths(pose))
print(joint.contact_measures(pose))

rom = joint.range_of_motion()
for limit in rom:
    print(f"{limit.motion.name:32} {limit.limit_deg:6.1f} deg  {limit.reason}")
