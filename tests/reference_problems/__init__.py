"""Classic problems: scenes, and solutions that owe nothing to the engine (README.md)."""
