"""This package measures how far a core is from the truth: `cases` are its inputs, `tip` its errors at the tip of the
arm, and `primitives` compares other cores with their real-valued functions.

Everything is vectorised over the samples and independent of the family that computed an answer: words are read by the
type of their port (`quadrance.codecs`).
"""

from quadrance.accuracy.arm import AXES, JOINTS, config, configure, limits, mm_per_lsb
from quadrance.accuracy.cases import Case, map_case, sweep_case, trajectory_case, workspace_case
from quadrance.accuracy.primitives import PRIMITIVES
from quadrance.accuracy.tip import Errors, errors, summary

__all__ = ["AXES", "JOINTS", "PRIMITIVES", "Case", "Errors", "config", "configure", "errors", "limits", "map_case",
           "mm_per_lsb", "summary", "sweep_case", "trajectory_case", "workspace_case"]
