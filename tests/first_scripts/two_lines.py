from seacrane import Scene, simulate
scene = Scene()
scene.add_body("beam", mass=5e3, size=(8, 1, 1), position=(0, 0, -10))
scene.add_line("fore", first="ground", second="beam", first_point=(4, 0, 0), second_point=(4, 0, 0.5), EA=2e7)
scene.add_line("aft", first="ground", second="beam", first_point=(-4, 0, 0), second_point=(-4, 0, 0.5), EA=2e7)
result = simulate(scene, 10)
print(f"each carries {result.select('line_tension', line='fore').mean() / 1e3:.1f} kN")
# each carries 24.
