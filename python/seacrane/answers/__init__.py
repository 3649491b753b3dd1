"""Numbers in an engineer's words: the summary of a run, statics, allowable loads."""
