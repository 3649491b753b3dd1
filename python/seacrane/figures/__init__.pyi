"""Pictures of runs: the paper's figures 3 to 10, a quick overview, and the paper's findings as numbers."""

from seacrane.figures.overview import plot_overview as plot_overview
from seacrane.answers.summary_figure import plot_summary as plot_summary
from seacrane.figures.plots import plot_reactions as plot_reactions
from seacrane.figures.plots import plot_spectrum as plot_spectrum
from seacrane.figures.plots import plot_track as plot_track
from seacrane.figures.pose import plot_scene as plot_scene
from seacrane.answers.load_chart_figure import plot_load_chart as plot_load_chart
from seacrane.figures.plots import plot_rao as plot_rao
from seacrane.statistics.figure import plot_extremes as plot_extremes
from seacrane.operability.figure import plot_allowable_hs as plot_allowable_hs
from seacrane.operability.figure import plot_weather_windows as plot_weather_windows
from seacrane.plotting.panel import save_figure as save_figure
from seacrane.plotting.panel import save_sheet as save_sheet
from seacrane.plotting.panel import save_table as save_table
from seacrane.figures.pose import save_pose_figure as save_pose_figure
from seacrane.plotting.panel import Picture as Picture
from seacrane.plotting.panel import Sheet as Sheet
from seacrane.plotting.panel import Panel as Panel
from seacrane.plotting.panel import draw as draw
from seacrane.figures.findings import Finding as Finding
from seacrane.figures.findings import paper_findings as paper_findings
from seacrane.figures.paper import PaperRuns as PaperRuns
from seacrane.figures.paper import save_paper_figures as save_paper_figures
