"""Files read and written safely: whole, bounded, atomic."""
