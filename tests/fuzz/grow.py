"""Small files made large, so that a cost that grows faster than the file shows."""

from __future__ import annotations

import random
import re

TOKEN = re.compile(rb"[^\s,]+")


def grown(data: bytes, size: int, rng: random.Random) -> bytes:
    """The file with one line, word, number or run of blanks repeated until it has about that many bytes."""
    lines = data.splitlines(keepends=True) or [b"\n"]
    place = rng.randrange(len(lines))
    room = max(size - len(data), 1)
    operation = rng.randrange(5)
    words = list(TOKEN.finditer(lines[place]))
    if operation == 0 or not words:
        more = [lines[place]] * max(1, room // len(lines[place]))
    elif operation == 1:  # the same line with another number each time
        word = rng.choice(words)
        start, end = lines[place][: word.start()], lines[place][word.end() :]
        count = max(1, room // (len(start) + len(end) + 6))
        more = [b"%s%d%s" % (start, i, end) for i in range(count)]
    else:
        word = rng.choice(words)
        filling = {2: b" ", 3: rng.choice((b"9", b"x", b"0")), 4: word.group() + b" "}[operation]
        long = filling * (room // len(filling))
        more = [lines[place][: word.end()] + long + lines[place][word.end() :]]
    return b"".join([*lines[:place], *more, *lines[place + (operation > 1) :]])
