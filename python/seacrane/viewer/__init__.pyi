"""A result or a scene as one self-contained page in three dimensions."""

from seacrane.viewer.view import view as view
from seacrane.viewer.view import View as View
from seacrane.viewer.stills import still as still
from seacrane.viewer.stills import video as video
