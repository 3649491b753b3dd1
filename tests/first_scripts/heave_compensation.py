from seacrane import Scene, shipped_database, simulate
scene = Scene()
scene.add_vessel(shipped_database())
scene.add_body("load", mass=20e3, size=(2, 2, 3), position=(10, 20, 0))
scene.add_line("hoist", first="vessel", second="load", first_point=(10, 20, 30), EA=3e7)
scene.add_winch("hoist")
scene.add_heave_compensation("ahc", body="vessel", point=(10, 20, 30), winch="hoist")
scene.add_sea(hs=1.5, tp=7)
result = simulate(scene, 60)
result.plot("line_tension").savefig("tension.png")
print(result)
# Result of 'scene': 601 outputs to 60 s
