"""Many runs of one lift: what varies, what each run keeps, and where the results go."""
