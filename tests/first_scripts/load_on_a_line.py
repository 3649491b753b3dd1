from seacrane import Scene, simulate
scene = Scene(); scene.add_body(name="load", mass=20e3, size=(2, 2, 3), position=(0, 0, -10))
scene.add_line(name="hoist", first="ground", second="load", EA=3e7); print(simulate(scene, 10))
# Result of 'scene': 101 outputs to 10 s
