"""Values and files from outside, checked and bounded; frames; files written whole."""
