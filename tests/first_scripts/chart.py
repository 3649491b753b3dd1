from seacrane import Scene, load_chart, shipped_database
scene = Scene()
scene.add_vessel(shipped_database())
scene.add_crane(payload_mass=20e3)
chart = load_chart(scene, radii=[14, 18], limits={"heel_deg": 8.0})
print(chart)
# radius
