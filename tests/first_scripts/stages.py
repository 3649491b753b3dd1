from seacrane import Scene, Stage, simulate_stages
scene = Scene()
scene.add_body("load", mass=10e3, size=(2, 2, 2), position=(0, 0, -20))
scene.add_line("hoist", first="ground", second="load", EA=3e7)
scene.add_winch("hoist")
stages = [Stage(name="wait", duration=10), Stage(name="hoist", duration=20, commands={"hoist.rate": -0.2}), Stage(name="hold", duration=10, commands={"hoist.rate": 0.0})]
result = simulate_stages(scene, stages)
print(result)
# Result of 'scene'
