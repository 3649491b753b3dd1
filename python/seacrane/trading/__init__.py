"""Speed traded for accuracy: the measured cost and error of every setting, and the choice among them."""

from __future__ import annotations

from seacrane.trading.trade_answer import Trade
from seacrane.trading.trade_study import trade

__all__ = ["Trade", "trade"]
