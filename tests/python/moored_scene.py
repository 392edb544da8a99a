"""A scene with bodies, lines, ropes and waves, for what draws it."""

from __future__ import annotations

MOORED = """
title = "Float on lines </script><b>"
[environment]
water_density = 1025.0
water_depth = 20.0
[sea]
ramp = 2.0
[[wave]]
name = "swell"
type = "regular"
height = 0.5
period = 4.0
[[body]]
name = "float"
mass = 1000.0
center_of_gravity = [0.0, 0.0, -1.0]
inertia = [500.0, 500.0, 500.0]
[[body]]
name = "arm.1"
motion = "planar"
mass = 10.0
center_of_gravity = [0.0, 0.0, 1.0]
inertia = [4.0, 4.0, 4.0]
[[joint]]
name = "hinge"
type = "revolute"
body_a = "float"
body_b = "arm.1"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
[[marker]]
name = "tip"
body = "arm.1"
point = [0.0, 0.0, 2.0]
[[force]]
name = "water"
type = "mooring_matrix"
body = "float"
stiffness = [100.0, 100.0, 1e4, 1e5, 1e5, 1e5]
damping = [1e3, 1e3, 1e3, 1e4, 1e4, 1e4]
[[force]]
name = "pto"
type = "pto_linear"
joint = "hinge"
stiffness = 1000.0
damping = 100.0
[[morison]]
name = "drag"
body = "float"
point = [0.0, 0.0, -1.0]
area = 0.1
volume = 0.01
drag_coefficient = 1.0
[[force]]
name = "chain"
type = "catenary"
body_b = "float"
point_a = [40.0, 0.0, -20.0]
point_b = [1.0, 0.0, -1.0]
length = [10.0, 30.0]
weight = [200.0, 200.0]
stiffness = [1e8, 1e8]
pretension = 6000.0
[[force]]
name = "rope"
type = "rope"
bodies = ["ground", "float"]
points = [[-30.0, 0.0, -20.0], [-1.0, 0.0, -1.0]]
stiffness = 1e5
pretension = 3000.0
[solver]
end_time = 2.0
[output]
step = 0.1
"""
