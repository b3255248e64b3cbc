"""Completion: the names that an editor or notebook offers after a dot, without running any code."""

import jedi
import pytest
from conftest import ROOT

HEAD = """\
from robokin import *
from robokin.show import *
T = Transform(translation=(0.4, 0.0, 0.5))
q = IRB140.ik(T)[0]
"""
POSE = {"rotation", "translation", "inverse", "lerp", "as_matrix", "shape"}
ARRAY = {"shape", "T", "max", "reshape"}
ARM = {"fk", "frames", "jacobian", "limits", "name"}

# For each text before the dot: the names that must be offered, and those that must not.
OFFERED = {
    "lin(T, T, .5)": (POSE, ARRAY - {"shape"}),
    "blend(T, T, T, .1, .5)": (POSE, ARRAY - {"shape"}),
    "IRB140.fk(q)": (POSE, ARRAY - {"shape"}),
    "T.inverse()": (POSE, ARRAY - {"shape"}),
    "T[0]": (POSE, ARRAY - {"shape"}),
    "T.rotation": ({"wxyz", "slerp", "inverse", "as_angle_axis"}, {"translation"}),
    "IRB140": (ARM | {"ik", "branch", "branches"}, {"family"}),
    "SCARA": (ARM | {"ik", "branch", "branches"}, {"family"}),
    "two_link(1, 1)": (ARM | {"ik", "branch", "branches"}, {"family"}),
    "three_lever(0.3)": (ARM | {"family", "least", "table"}, {"ik", "branch", "branches"}),
    "three_lever(0.3).family((0.5, 0.5), 1.0)": (ARRAY, {"inverse"}),
    "IRB140.ik(T)": (ARRAY, {"inverse"}),
    "IRB140.jacobian(q)": (ARRAY, {"inverse"}),
    "follow(IRB140, IRB140.ik(T), 0)": (ARRAY, {"inverse"}),
    "within(IRB140, q)": (ARRAY, {"inverse"}),
    "record(IRB140, q, q)": ({"q", "v", "a", "jumps", "greatest_speed"}, ARRAY - {"shape"}),
    "quintic(1.0)": ({"duration"}, ARRAY),
    "quintic(1.0)(0.5)": (ARRAY, {"duration"}),
    "animate(IRB140, q, q)": ({"save"}, ARRAY),
    "plot_joints(IRB140, q, q)": ({"savefig"}, ARRAY),
}


@pytest.mark.parametrize("before", OFFERED)
def test_completion_offers_the_right_names(before):
    wanted, unwanted = OFFERED[before]
    line = HEAD.count("\n") + 1
    script = jedi.Script(f"{HEAD}{before}.", project=jedi.Project(ROOT))
    offered = {completion.name for completion in script.complete(line, len(before) + 1)}
    assert wanted <= offered, f"not offered: {wanted - offered}"
    assert not unwanted & offered
