"""Figures and players for notebooks: arrays in, pictures out."""

from .player import Player, animate
from .plots import JOINT_STYLES, figure, plot_frames, plot_joints, plot_postures

__all__ = ["JOINT_STYLES", "Player", "animate", "figure", "plot_frames", "plot_joints", "plot_postures"]
