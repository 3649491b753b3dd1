"""Statistics of records and of the maxima of seeds: what is exceeded, and how sure that is."""
