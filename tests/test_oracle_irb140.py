"""The IRB-140 compared with reference cases that were computed independently of robokin and of the
document.
"""

import json

import numpy as np
import pytest
from machines import oracle, transform, turns
from test_spherical_wrist import compare

from robokin import (
    IRB140,
    blend,
    differentiate,
    follow,
    lin,
    lin_lin,
    linear,
    mm,
    nearest,
    ptp,
    within,
)

CASES = oracle("irb140")["cases"]
MOTIONS = {case["law"]: case for case in oracle("trajectories_irb140")["cases"]}
NAMED = oracle("examples")["irb140_named"]
POSES = {
    c["kind"].removeprefix("named:"): transform(c["T"], mm)
    for c in CASES
    if c["kind"].startswith("named:")
}
STEP, TOTAL = 0.01, 20.0
T = np.arange(0, TOTAL, STEP)


@pytest.mark.parametrize("case", CASES, ids=[f"{i}-{case['kind']}" for i, case in enumerate(CASES)])
def test_ik_returns_every_solution_in_its_row(case):
    rows = compare(IRB140, case, mm)
    if "q" in case and not case["singular"]["wrist"]:  # the original joint values of the pose
        assert np.nanmin(turns(rows, case["q"]).max(-1)) < 1e-6


@pytest.mark.parametrize(
    "case",
    [c for c in CASES if c["reachable"]],
    ids=[f"{i}-{case['kind']}" for i, case in enumerate(CASES) if case["reachable"]],
)
def test_within_matches_the_oracle(case):
    rows = IRB140.ik(transform(case["T"], mm))
    for solution in case["solutions"]:
        q, inside = np.array(solution["q"]), solution["representatives_in_limits"]
        assert within(IRB140, q).tolist() == [bool(values) for values in inside]
        assert within(IRB140, q).all() == solution["in_limits"]
        row = rows[np.nanargmin(turns(rows, q).max(-1))]
        assert within(IRB140, row).tolist() == [bool(values) for values in inside]
        for joint, values in enumerate(inside):
            for value in values:  # near a representative, `nearest` must return this representative
                near = np.array([v[0] if v else qi for v, qi in zip(inside, q, strict=True)])
                near[joint] = value
                assert abs(nearest(IRB140, q[None], near)[joint] - value) < 1e-9


@pytest.mark.parametrize(
    "case", [c for c in CASES if not c["reachable"]], ids=lambda case: case["kind"]
)
def test_unreachable_pose_has_no_rows(case):
    assert np.isnan(IRB140.ik(transform(case["T"], mm))).all()


@pytest.mark.parametrize("name", NAMED)
def test_named_poses_agree_to_the_last_digits(name):
    rows = IRB140.ik(POSES[name if name in POSES else "task3_" + name])
    for flags, q in NAMED[name].items():
        row = rows[IRB140.branch(*json.loads(flags.replace("(", "[").replace(")", "]")))]
        assert np.isnan(row).all() if q is None else turns(row, q).max() < 1e-12


def motion(law):
    """The poses of one of the document's motions at the times T, computed with robokin."""
    s = linear(TOTAL)(T)
    start, via, goal = POSES["chain_s"], POSES["chain_i"], POSES["chain_e"]
    if law == "LIN s->e":
        return lin(POSES["task3_s"], POSES["task3_e"], s)
    if law == "LIN-LIN s,i,e":
        return lin_lin(start, via, goal, s)
    return blend(start, via, goal, float(law.rsplit(" ", 1)[1]), s)


CARTESIAN = [law for law in MOTIONS if law not in ("task1", "PTP s->e", "LIN-LIN blend 0.55")]


@pytest.mark.parametrize("law", CARTESIAN)
def test_motions_match_the_oracle(law):
    case = MOTIONS[law]
    poses = motion(law)
    q = follow(IRB140, IRB140.ik(poses), IRB140.branch(*case["flags"]))
    for sample in case["samples"]:
        i = int(round(sample["t"] / STEP))
        if i == len(T):  # t = 20 is one step past the document's last sample
            continue
        given = transform(sample["T"], mm)
        assert abs(poses[i].as_matrix() - given.as_matrix()).max() < 1e-12
        assert turns(q[i], sample["q"]).max() < 1e-9
    v = np.diff(q, axis=0) / STEP
    a = np.diff(v, axis=0) / STEP
    assert np.allclose(abs(v).max(0), case["max_abs_speed"], rtol=0, atol=1e-12)
    assert np.allclose(abs(a).max(0), case["max_abs_acc"], rtol=1e-9, atol=1e-9)
    assert np.allclose(T[abs(a).argmax(0)], case["t_max_acc"], rtol=0, atol=1e-9)
    assert (~within(IRB140, q)).any(-1).sum() == case["limit_violation_count"] == 0


def test_motions_end_at_the_goal():
    for law, goal in (("LIN s->e", POSES["task3_e"]), ("LIN-LIN s,i,e", POSES["chain_e"])):
        last = MOTIONS[law]["samples"][-1]
        row = IRB140.ik(goal)[IRB140.branch(*MOTIONS[law]["flags"])]
        assert last["t"] == 20.0 and turns(row, last["q"]).max() < 1e-9


def test_ptp_matches_the_oracle():
    case = MOTIONS["PTP s->e"]
    row = IRB140.branch(*case["flags"])
    start, goal = IRB140.ik(POSES["task3_s"])[row], IRB140.ik(POSES["task3_e"])[row]
    q = ptp(start, goal, linear(TOTAL)(T))
    for sample in case["samples"]:
        i = int(round(sample["t"] / STEP))
        if i < len(T):
            assert abs(q[i] - sample["q"]).max() < 1e-9
    assert np.allclose(differentiate(q, T), case["speed"], rtol=0, atol=1e-11)


def test_printed_blend_of_0_55_is_refused():
    assert "LIN-LIN blend 0.55" in MOTIONS
    with pytest.raises(ValueError, match=r"\[0, 0.5\], got 0.55"):
        motion("LIN-LIN blend 0.55")
