"""Water on a load: parts with buoyancy, added mass over depth, slam and drag, for `Scene.add_immersed`."""
