"""Figures and players for notebooks, made from arrays."""

from .charts import bars, curves
from .clearance_explorer import clearance_explorer
from .conveyor import conveyor_player
from .crossing_explorer import crossing_explorer
from .elbow_explorer import elbow_explorer
from .ellipsoid import plot_velocity_ellipsoid
from .explorer import Explorer
from .explorers import joint_explorer, target_explorer
from .joint_plot import plot_joints
from .levers_explorer import movement_explorer
from .motion_explorer import motion_explorer
from .motors import motor_explorer
from .palette import JOINT_STYLES
from .paths_explorer import paths_explorer
from .plan_explorer import plan_explorer
from .player import Player, animate
from .plots import figure, plot_frames, plot_postures
from .rotation_explorer import rotation_explorer
from .singularity_explorer import singularity_explorer
from .sketch import Sketch
from .tour_explorer import tour_explorer

__all__ = [
    "JOINT_STYLES",
    "Explorer",
    "Player",
    "Sketch",
    "animate",
    "bars",
    "clearance_explorer",
    "conveyor_player",
    "crossing_explorer",
    "curves",
    "elbow_explorer",
    "figure",
    "joint_explorer",
    "motion_explorer",
    "motor_explorer",
    "movement_explorer",
    "paths_explorer",
    "plan_explorer",
    "plot_frames",
    "plot_joints",
    "plot_postures",
    "plot_velocity_ellipsoid",
    "rotation_explorer",
    "singularity_explorer",
    "target_explorer",
    "tour_explorer",
]
