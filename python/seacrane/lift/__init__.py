"""Lifts and studies as files that a person writes: TOML in and out, and the schemas that editors read."""
