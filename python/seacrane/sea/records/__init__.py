"""Records as they are found: what a file of measured motions or sea states looks like, and how it is read."""
