"""The vessel of the time domain."""
