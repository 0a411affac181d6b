"""Writes the arm that franka-sim simulates: the URDF in its wheel without meshes, for which it would
otherwise fetch another model, and with the rotors' inertia and friction, without which the joint
controllers' damping is unstable at a millisecond."""

import sys
import xml.etree.ElementTree as ET
from importlib.resources import files

import mujoco

tree = ET.parse(str(files("franka_sim") / "models" / "fr3.urdf"))
for link in tree.getroot().iter("link"):
    for kind in ("visual", "collision"):
        for part in link.findall(kind):
            link.remove(part)
spec = mujoco.MjSpec.from_string(ET.tostring(tree.getroot(), encoding="unicode"))
for number, joint in enumerate(spec.joints):
    joint.armature = 0.6 if number < 4 else 0.25
    joint.damping = 1.0
    joint.frictionloss = 0.2
spec.compile()
with open(sys.argv[1], "w", encoding="utf-8") as model:
    model.write(spec.to_xml())
