"""Statistics of records and of the maxima of seeds: what is exceeded in an exposure time, and how sure that is."""
