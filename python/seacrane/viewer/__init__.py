"""A result or a scene as one self-contained page in three dimensions."""
