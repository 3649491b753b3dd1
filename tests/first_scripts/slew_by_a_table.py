import numpy as np
from seacrane import Curve, Scene, shipped_database, simulate
scene = Scene()
scene.add_vessel(shipped_database())
scene.add_crane(payload_mass=20e3)
scene.add_driver("slew", curve=Curve.table([0, 10, 40, 60], np.radians([0, 0, 30, 30])))
scene.record_coordinate("A")
result = simulate(scene, 60)
print(f"slewed to {np.degrees(result['slew_angle'][-1]):.1f} deg")
# slewed to 30.0 deg
