"""Keys of a stage in a lift file: `Stage`, with its conditions and commands as tables."""

from __future__ import annotations

from seacrane.description.channels import CHANNELS, units_of
from seacrane.lift.keys import EITHER, Key, keys_of
from seacrane.run.stage import Stage

CHANNEL_UNITS = EITHER.join(dict.fromkeys(unit for name in CHANNELS for unit in units_of(name)))
COMMAND_UNITS = EITHER.join(("m", "rad", "m/s", "N", "N m", "1", "m2"))
WAITS = {
    "tension": "Line whose tension ends the stage.",
    "length": "Line whose unstretched length ends it.",
    "depth": "Body with parts in water, or part, the depth of whose lowest point ends it.",
    "channel": "Channel that ends it.",
    "clear": "Contact whose points are all at least so far from the surface.",
    "contact": "Limit that takes hold, or contact that is touched.",
    "release": "Limit that lets go, or contact that is left.",
}

UNTIL = (
    *(Key(name=name, type="text", text=text) for name, text in WAITS.items()),
    Key(name="minimum", type="number", unit=CHANNEL_UNITS, text="Met at this value and above."),
    Key(name="maximum", type="number", unit=CHANNEL_UNITS, text="Met at this value and below."),
    Key(name="names", type="names", text="One name for each dimension of the channel."),
)
COMMANDS = (
    Key(name="name", type="text", required=True, text='Such as "hoist.rate".'),
    Key(name="to", type="number", unit=COMMAND_UNITS, text="Where a move ends."),
    Key(name="by", type="number", unit=COMMAND_UNITS, text="How far it goes."),
    Key(name="over", type="number", unit="s", text="How long it takes."),
    Key(
        name="value",
        type="number",
        unit=COMMAND_UNITS,
        text="A rate, force or share, reached within 1 s; the area of a hole.",
    ),
    Key(name="curve", type="curve", unit=COMMAND_UNITS, text="On the stage's clock, 0 where it begins."),
)
STAGE = keys_of(
    Stage,
    more={
        "duration": {"unit": "s"},
        "maximum_duration": {"unit": "s"},
        "until": {"type": "tables", "keys": UNTIL, "text": "The first that is met ends the stage."},
        "commands": {"type": "tables", "keys": COMMANDS, "text": "What moves during it."},
        "connect": {"type": "texts"},
        "release": {"type": "texts"},
    },
)
