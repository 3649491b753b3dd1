"""In which seas a lift may go ahead: allowable Hs, availability, weather windows, waiting for them."""
