"""Lifts as sequences: stages with commands, connections and conditions to end, run as one result."""
