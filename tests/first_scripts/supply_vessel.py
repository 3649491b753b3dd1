from seacrane import Scene, shipped_database, simulate
scene = Scene()
scene.add_vessel(shipped_database())
scene.add_vessel(shipped_database(), name="supply", position=(0, 40, 0))
scene.add_crane(payload_mass=20e3)
scene.add_sea(hs=1.5, tp=7)
scene.add_sea(vessel="supply")
result = simulate(scene, 60)
print(result["hook_load"].max())
# .
