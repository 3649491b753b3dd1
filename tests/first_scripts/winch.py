from seacrane import Scene, simulate
scene = Scene()
scene.add_body("load", mass=10e3, size=(2, 2, 2), position=(0, 0, -20))
scene.add_line("hoist", first="ground", second="load", EA=3e7)
scene.add_winch("hoist", rate=-0.5)
result = simulate(scene, 20)
print(f"lifted by {result.select('position[load, z]')[-1] + 20:.1f} m")
# lifted by 10.0 m
