"""Cases times methods make rows, with errors against a reference: under trades, atlas and benchmarks."""
