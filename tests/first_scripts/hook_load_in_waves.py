from seacrane import Scene, shipped_database, simulate
scene = Scene(); scene.add_vessel(shipped_database()); scene.add_crane(payload_mass=20e3); scene.add_sea(hs=1.5, tp=7)
print(simulate(scene, 300)["hook_load"].max())
# 3
