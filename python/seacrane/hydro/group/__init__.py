"""Several hulls in one water: `HydroGroup`, one file for each thing that it does."""
