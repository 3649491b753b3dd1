"""Values from outside: their checks, how they are shown, frames, and the line of the caller."""
