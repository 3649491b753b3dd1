from seacrane import Scene, shipped_database, statics
scene = Scene()
scene.add_vessel(shipped_database())
scene.add_crane(payload_mass=20e3)
print(statics(scene))
# hook load                   20      t
