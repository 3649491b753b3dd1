"""Named warnings: where a scene, or its run, leaves the range of what is modelled."""
