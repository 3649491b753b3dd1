"""Lifts as files that a person writes: TOML in and out, and the schema that editors read."""
