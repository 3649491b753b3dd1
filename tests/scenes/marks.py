"""Marks that tests of several rooms carry."""

from __future__ import annotations

import pytest

from seacrane.run.lanes import module_of

needs_lanes = pytest.mark.skipif(module_of(4) is None, reason="no lanes on this processor, or in this build")
