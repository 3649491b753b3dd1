"""Classic problems of multibody dynamics and ships in waves: scenes, and solutions that owe nothing to the
engine.

One module per problem: `scene(...)` describes it for seacrane, a function beside it gives the solution,
published or computed by other means, and says which. `table.py` prints the table of
README.md.
"""
