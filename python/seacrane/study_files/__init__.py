"""Studies as files that a person writes: what varies, what is kept, until when; run, resumed and shown."""
