"""Independent NumPy/SciPy reference of the engine's equations, written from the paper and the design alone.

Test-only: nothing here is shipped, and nothing here imports the engine. Clarity is preferred to speed.
"""
