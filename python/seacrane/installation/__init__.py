"""What is installed, how it was built, and how fast it is here."""
