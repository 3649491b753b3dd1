"""What a scene requires: each choice of modelling made simpler, one at a time, with its cost and its loss."""

from seacrane.needs.required import required as required
from seacrane.needs.answer import Requirements as Requirements
from seacrane.needs.answer import Loss as Loss
from seacrane.needs.choices import Choice as Choice
from seacrane.needs.choices import choices_of as choices_of
from seacrane.needs.choices import missing_from as missing_from
from seacrane.needs.choices import uncoupled as uncoupled
from seacrane.accuracy.simpler_scenes import strongest as strongest
from seacrane.accuracy.simpler_scenes import with_memory as with_memory
from seacrane.accuracy.simpler_scenes import locked as locked
from seacrane.accuracy.simpler_scenes import scattered as scattered
