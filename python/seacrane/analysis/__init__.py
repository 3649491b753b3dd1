"""Rest, statics, inverse dynamics and linear theory of a scene."""
