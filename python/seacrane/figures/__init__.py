"""Pictures of runs: the paper's figures 3 to 10, a quick overview, and the paper's findings as numbers."""

from seacrane.crane.skeleton import crane_skeleton
from seacrane.figures.findings import Finding, paper_findings
from seacrane.figures.overview import overview_sheet, plot_overview
from seacrane.figures.paper import PaperRuns, motion_of, save_paper_figures
from seacrane.figures.plots import plot_rao, plot_reactions, plot_spectrum, plot_track
from seacrane.figures.pose import Skeleton, box_lines, hull_lines, plot_scene, save_pose_figure
from seacrane.plotting.panel import Line, Panel, Picture, Sheet, draw, save_figure, save_sheet, save_table

__all__ = [
    "Finding",
    "Line",
    "Panel",
    "PaperRuns",
    "Picture",
    "Sheet",
    "Skeleton",
    "box_lines",
    "crane_skeleton",
    "draw",
    "hull_lines",
    "motion_of",
    "overview_sheet",
    "paper_findings",
    "plot_overview",
    "plot_rao",
    "plot_reactions",
    "plot_scene",
    "plot_spectrum",
    "plot_track",
    "save_figure",
    "save_paper_figures",
    "save_pose_figure",
    "save_sheet",
    "save_table",
]
