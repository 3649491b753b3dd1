"""In which seas a lift may go ahead: allowable Hs, availability, weather windows, waiting for them."""

from seacrane.operability.allowable import allowable_hs as allowable_hs
from seacrane.operability.allowable_table import AllowableHs as AllowableHs
from seacrane.operability.criterion import Criterion as Criterion
from seacrane.operability.phase import Phase as Phase
from seacrane.operability.phase_sheet import phase_sheet as phase_sheet
from seacrane.operability.phase_table import PhaseSheet as PhaseSheet
from seacrane.operability.alpha import AlphaFactor as AlphaFactor
from seacrane.operability.availability import availability as availability
from seacrane.operability.availability import Availability as Availability
from seacrane.operability.availability import ScatterDiagram as ScatterDiagram
from seacrane.operability.windows import weather_windows as weather_windows
from seacrane.operability.windows import WeatherWindows as WeatherWindows
from seacrane.operability.hindcast import WaveHindcast as WaveHindcast
from seacrane.operability.go import go_or_no_go as go_or_no_go
from seacrane.operability.go import GoNoGo as GoNoGo
