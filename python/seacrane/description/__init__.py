"""The bare description of a scene: bodies, joints, loads, limits, waves, and its file."""
