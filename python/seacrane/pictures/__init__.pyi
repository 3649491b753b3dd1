"""Pictures: quick overviews, the paper's figures, and the page in three dimensions."""

from seacrane.pictures.plots import plot_overview as plot_overview
from seacrane.answers.reported_curves import plot_summary as plot_summary
from seacrane.pictures.plots import plot_reactions as plot_reactions
from seacrane.pictures.plots import plot_spectrum as plot_spectrum
from seacrane.pictures.plots import plot_track as plot_track
from seacrane.pictures.pose import plot_scene as plot_scene
from seacrane.answers.load_chart import plot_load_chart as plot_load_chart
from seacrane.pictures.plots import plot_rao as plot_rao
from seacrane.statistics.estimate import plot_extremes as plot_extremes
from seacrane.operability.allowable_table import plot_allowable_hs as plot_allowable_hs
from seacrane.operability.windows import plot_weather_windows as plot_weather_windows
from seacrane.plotting.panel import save_figure as save_figure
from seacrane.plotting.panel import save_sheet as save_sheet
from seacrane.plotting.panel import save_table as save_table
from seacrane.pictures.pose import save_pose_figure as save_pose_figure
from seacrane.plotting.panel import Picture as Picture
from seacrane.plotting.panel import Sheet as Sheet
from seacrane.plotting.panel import Panel as Panel
from seacrane.plotting.panel import draw as draw
from seacrane.pictures.findings import Finding as Finding
from seacrane.pictures.findings import paper_findings as paper_findings
from seacrane.pictures.findings import PaperRuns as PaperRuns
from seacrane.pictures.findings import save_paper_figures as save_paper_figures
from seacrane.pictures.view import view as view
from seacrane.pictures.view import View as View
