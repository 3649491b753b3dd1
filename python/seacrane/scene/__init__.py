"""What is added to a scene from hydrodynamics, seas, winds and limits."""
