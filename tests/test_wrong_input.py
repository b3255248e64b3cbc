"""Invalid input raises the correct exception with the invalid value in its message; unusual input
gives the correct answer. The tables have one line per call.
"""

from types import SimpleNamespace

import numpy as np
import pytest

from robokin import (
    IRB140,
    SCARA,
    Arm,
    Link,
    Quaternion,
    ScaraPose,
    TimeLaw,
    Transform,
    blend,
    dh_links,
    differentiate,
    elbow_arm,
    explain,
    follow,
    itmo_arm,
    lin,
    lin_lin,
    linear,
    nearest,
    ptp,
    quintic,
    scara_arm,
    spbu_arm,
    spherical_wrist,
    three_lever,
    trapezoidal,
)

NAN, INF = np.nan, np.inf
A = Transform(translation=(0.4, 0, 0.5))
B = Transform(Quaternion.from_angle_axis(1.0, (0, 0, 1)), (0.3, 0.2, 0.5))
Z = (0, 0, 1)
S = np.linspace(0, 1, 5)
MIRROR = np.diag([1.0, 1, -1])
LIMITS = [(-1, 1)] * 6
MANY = (1,) * 33
ONE = SimpleNamespace(links=(Link(),), target=Transform, reach=1.0)


class Failing:
    """An object that claims to be an array but cannot be converted to one."""

    def __array__(self, *_, **__):
        raise RuntimeError("no array today")


WRONG = {
    # quaternions
    "three components": (lambda: Quaternion([1, 0, 0]), r"\(3,\)"),
    "a number": (lambda: Quaternion(1.0), r"\(\)"),
    "zero quaternion": (lambda: Quaternion([0, 0, 0, 0]), "length 0"),
    "quaternion of length 2": (lambda: Quaternion([2, 0, 0, 0]), "length 2"),
    "worst of a batch": (
        lambda: Quaternion([[1, 0, 0, 0], [0, 3, 0, 0], [0, 2, 0, 0]]),
        "length 3",
    ),
    "NaN quaternion": (lambda: Quaternion([1, 0, NAN, 0]), r"nan at index \(2,\)"),
    "words": (lambda: Quaternion("abcd"), "abcd"),
    "ragged": (lambda: Quaternion([[1, 0, 0, 0], [1, 0]]), r"\[1, 0\]"),
    "zero axis": (lambda: Quaternion.from_angle_axis(1.0, (0, 0, 0)), r"\[0. 0. 0.\] of length 0"),
    "axis of length 2": (lambda: Quaternion.from_angle_axis(1.0, (0, 0, 2)), "length 2"),
    "axis in a batch": (
        lambda: Quaternion.from_angle_axis(1.0, [Z, (0, 3, 4)]),
        r"\[0. 3. 4.\] of length 5",
    ),
    "flat axis": (lambda: Quaternion.from_angle_axis(1.0, (1, 0)), r"\(2,\)"),
    "NaN angle": (lambda: Quaternion.from_angle_axis(NAN, Z), "angle.*nan"),
    "infinite angle": (lambda: Quaternion.from_angle_axis(INF, Z), "angle.*inf"),
    "two angles, three axes": (
        lambda: Quaternion.from_angle_axis([1, 2], [Z, Z, Z]),
        r"\(2,\).*\(3,\)",
    ),
    "flat matrix": (lambda: Quaternion.from_matrix(np.ones(3)), r"\(3,\)"),
    "matrix 2 x 3": (lambda: Quaternion.from_matrix(np.ones((2, 3))), r"\(2, 3\)"),
    "matrix 4 x 4": (lambda: Quaternion.from_matrix(np.eye(4)), r"\(4, 4\)"),
    "stretched matrix": (lambda: Quaternion.from_matrix(1.01 * np.eye(3)), "0.0201"),
    "mirror": (lambda: Quaternion.from_matrix(MIRROR), "reflection"),
    "mirror in a batch": (lambda: Quaternion.from_matrix([np.eye(3), MIRROR]), "reflection"),
    "NaN matrix": (lambda: Quaternion.from_matrix(np.full((3, 3), NAN)), "nan"),
    "zero matrix": (lambda: Quaternion.from_matrix(np.zeros((3, 3))), "from the identity by 1"),
    "slerp to an array": (
        lambda: B.rotation.slerp(np.eye(3), 0.5),
        r"wanted a Quaternion.*\(3, 3\)",
    ),
    "slerp at NaN": (lambda: B.rotation.slerp(B.rotation, NAN), "nan"),
    "slerp of other shapes": (
        lambda: B.rotation[None][[0, 0]].slerp(B.rotation, [0, 0.5, 1]),
        r"\(2,\).*\(3,\)",
    ),
    "points of a plane": (lambda: B.rotation @ np.ones((5, 2)), r"\(5, 2\)"),
    "infinite point": (lambda: B.rotation @ [0, INF, 0], "inf"),
    "batches do not fit": (
        lambda: Quaternion.identity((2,)) @ Quaternion.identity((3,)),
        r"the two rotations: batch shapes \(2,\) and \(3,\)",
    ),
    # transforms
    "matrix as rotation": (lambda: Transform(np.eye(3)), r"wanted a Quaternion.*\(3, 3\)"),
    "point of a plane": (lambda: Transform(translation=(1, 2)), r"\(2,\)"),
    "NaN translation": (lambda: Transform(translation=(0, NAN, 0)), r"nan at index \(1,\)"),
    "parts do not fit": (
        lambda: Transform(Quaternion.identity((2,)), np.zeros((3, 3))),
        r"\(2,\).*\(3,\)",
    ),
    "3 x 3 as transform": (lambda: Transform.from_matrix(np.eye(3)), r"\(3, 3\)"),
    "last row": (lambda: Transform.from_matrix(np.ones((4, 4))), r"0 0 0 1.*\[1. 1. 1. 1.\]"),
    "transposed": (lambda: Transform.from_matrix(B.as_matrix().T), "0 0 0 1"),
    "lerp to an array": (lambda: A.lerp(np.eye(4), 0.5), r"wanted a Transform.*\(4, 4\)"),
    "lerp to a rotation": (lambda: A.lerp(B.rotation, 0.5), "wanted a Transform.*Quaternion"),
    "lerp of other shapes": (lambda: Transform.identity((2,)).lerp(A, S), r"\(2,\).*\(5,\)"),
    # arms
    "five joints": (lambda: IRB140.fk(np.zeros(5)), r"\(\.\.\., 6\), got \(5,\)"),
    "one number as joints": (lambda: IRB140.fk(0.0), r"got \(\)"),
    "infinite joint": (lambda: IRB140.fk([0, 0, INF, 0, 0, 0]), r"inf at index \(2,\)"),
    "joints as words": (lambda: IRB140.frames(["a"] * 6), "wanted numbers"),
    "Jacobian of seven": (lambda: IRB140.jacobian(np.zeros((2, 7))), r"\(2, 7\)"),
    "matrix to ik": (
        lambda: IRB140.ik(np.eye(4)),
        r"wanted a Transform, got array of shape \(4, 4\).*from_matrix",
    ),
    "list to ik": (lambda: IRB140.ik([A, B]), "wanted a Transform, got"),
    "position to ik": (
        lambda: IRB140.ik((0.4, 0, 0.5)),
        r"wanted a Transform, got \(0.4, 0, 0.5\)",
    ),
    "target to ik": (
        lambda: IRB140.ik(ScaraPose((0.4, 0, 0.5), 0.1)),
        "wanted a Transform, got ScaraPose",
    ),
    "position to SCARA": (lambda: SCARA.ik((0.4, 0, 0.1)), r"\(0.4, 0, 0.1\)"),
    "no such branch": (lambda: IRB140.branch(1, 1), r"3 flags.*\(1, 1\)"),
    "flag 0": (lambda: IRB140.branch(1, 0, 1), r"\(1, 0, 1\)"),
    "reversed limits": (lambda: Arm("x", ONE, [(1, -1)]), r"\[\[1.0, -1.0\]\]"),
    "limits of another arm": (lambda: Arm("x", ONE, LIMITS), "wanted 1 pairs"),
    "NaN limits": (lambda: Arm("x", ONE, [(NAN, 1)]), "nan"),
    "no speed": (lambda: Arm("x", ONE, [(0, 1)], [0.0]), r"\[0.0\]"),
    "speeds of another arm": (lambda: Arm("x", ONE, [(0, 1)], [1, 2]), r"\(2,\)"),
    "link without axis": (lambda: Link(axis=(0, 0, 0)), "axis.*length 0"),
    "link about a long axis": (lambda: Link(axis=(0, 0, 2)), "axis.*length 2"),
    "no geometry": (lambda: Arm("x", None, LIMITS), "geometry with links, target, reach, got None"),
    "no links": (lambda: Arm("x", [], LIMITS), "links: wanted at least one Link, got none"),
    "a pose among links": (lambda: Arm("x", [Link(), A], LIMITS), r"links\[1\]: wanted a Link"),
    "links that stand still": (
        lambda: Arm("x", [Link(after=Transform(translation=(0, 0, 1)))], LIMITS[:1]),
        "links: wanted a flange that can leave axis 1",
    ),
    "links of another kind": (
        lambda: elbow_arm("x", 3, LIMITS[:3]),
        "links: wanted a tuple, got 3",
    ),
    "one of the links": (lambda: elbow_arm("x", [Link(), 1], LIMITS), r"links\[1\]: wanted a Link"),
    "link that slides in words": (lambda: Link(prismatic="yes"), "prismatic: wanted a bool"),
    "three levers explained": (lambda: explain(three_lever(1), (1, 1), 0), "ClosedFormArm"),
    "link about a plane's axis": (lambda: Link(axis=(0, 1)), r"axis.*\(2,\)"),
    "link from a matrix": (lambda: Link(np.eye(4)), r"before.*\(4, 4\)"),
    "link after a matrix": (lambda: Link(after=np.eye(4)), r"after.*\(4, 4\)"),
    "five links": (lambda: spherical_wrist("x", IRB140.links[:5], LIMITS), "six revolute links"),
    "limits of five": (lambda: spherical_wrist("x", IRB140.links, LIMITS[:5]), "wanted 6 pairs"),
    "DH joints in words": (
        lambda: dh_links([0, 1], 0, 0, prismatic=["no", "yes"]),
        "prismatic: wanted True or False",
    ),
    "DH joints as numbers": (lambda: dh_links([0, 1], 0, 0, prismatic=[0, 1]), "got \\[0, 1\\]"),
    "DH joints do not fit": (
        lambda: dh_links([0, 1], 0, 0, prismatic=[True] * 3),
        r"\(2,\).*\(3,\)",
    ),
    "DH columns": (lambda: dh_links([0, 1], [0, 1, 2], 0), r"\(2,\).*\(3,\)"),
    "DH without upper arm": (lambda: itmo_arm(0.1, 0.0, 0.2, 0.2), "a2: wanted one positive"),
    "DH below the floor": (lambda: itmo_arm(-0.1, 0.1, 0.2, 0.2), "d1 and d6.*-0.1"),
    "a link that slides": (
        lambda: elbow_arm("x", [*IRB140.links[:2], Link(prismatic=True)], LIMITS[:3]),
        "three revolute links",
    ),
    "four links": (lambda: elbow_arm("x", IRB140.links[:4], LIMITS[:4]), "links, got 4"),
    "links of no link": (lambda: elbow_arm("x", [], LIMITS[:3]), "at least one Link"),
    "no lever": (lambda: scara_arm("x", 0.2, 0, 0.1, LIMITS[:4]), "upper: .*got 0"),
    "height in words": (lambda: scara_arm("x", "1", 0.2, 0.1, LIMITS[:4]), "height: .*'1'"),
    "link before 0": (lambda: spbu_arm(-5, 4), "l1: .*-5"),
    "arm named 3": (
        lambda: spherical_wrist(3, IRB140.links, LIMITS),
        "name: wanted a string, got 3",
    ),
    "no rows": (
        lambda: nearest(IRB140, np.zeros((0, 6)), np.zeros(6)),
        r"at least one row.*\(0, 6\)",
    ),
    "True as a row": (lambda: explain(IRB140, A, True), "True"),
    "True as a row to follow": (lambda: follow(IRB140, np.zeros((3, 8, 6)), True), "True"),
    "lerp of unfit places": (
        lambda: ScaraPose(np.zeros((2, 3))).lerp(ScaraPose(np.zeros((3, 3))), 0.5),
        r"\(2,\).*\(3,\)",
    ),
    "batch of links": (lambda: Link(Transform.identity((2,))), r"before: .*shape=\(2,\)"),
    # types of numbers
    "numbers as words": (lambda: IRB140.fk(["0"] * 6), "wanted numbers"),
    "complex numbers": (lambda: Transform(translation=(1j, 0, 0)), "translation: wanted numbers"),
    "masked numbers": (lambda: IRB140.fk(np.ma.zeros(6)), "masked"),
    "dates": (lambda: IRB140.fk(np.zeros(6, "datetime64[s]")), "wanted numbers"),
    "a number beyond floats": (lambda: IRB140.fk([10**400] * 6), "wanted numbers"),
    "None among numbers": (lambda: IRB140.fk([0, 0, None, 0, 0, 0]), "wanted numbers"),
    "an array that fails": (lambda: IRB140.fk(Failing()), "q: wanted numbers, got"),
    "shape 3": (lambda: Quaternion.identity(3), "tuple of whole numbers, got 3"),
    "endless shape": (lambda: Transform.identity((10**6, 10**6)), "at most 1e.08"),
    "NaN length": (lambda: itmo_arm(0.1, NAN, 0.2, 0.2), "nan"),
    # laws
    "no times": (lambda: linear(1.0)([]), "empty"),
    "no times, quintic": (lambda: quintic(1.0)(np.empty((0, 3))), "empty"),
    "NaN time": (lambda: quintic(1.0)([0, NAN]), r"nan at index \(1,\)"),
    "no duration": (lambda: linear(0), "got 0"),
    "negative duration": (lambda: quintic(-20), "got -20"),
    "two durations": (lambda: trapezoidal([1, 2]), r"\[1, 2\]"),
    "NaN duration": (lambda: TimeLaw(NAN, np.sin), "nan"),
    "duration in words": (lambda: linear("long"), "long"),
    "no ramp": (lambda: trapezoidal(1.0, 0), "got 0"),
    "long ramp": (lambda: trapezoidal(1.0, 0.6), "got 0.6"),
    # paths
    "blend -0.1": (lambda: blend(A, B, A, -0.1, S), r"\[0, 0.5\], got -0.1"),
    "blend 0.6": (lambda: blend(A, B, A, 0.6, S), r"\[0, 0.5\], got 0.6"),
    "blend 0.55": (lambda: blend(A, B, A, 0.55, S, "quintic"), "got 0.55"),
    "blends, one wrong": (lambda: blend(A, B, A, np.array([0, 0.1, 0.7]), 0.5), "got 0.7"),
    "NaN blend": (lambda: blend(A, B, A, NAN, S), "fraction.*nan"),
    "blend in per cent": (lambda: blend(A, B, A, "10 %", S), "10 %"),
    "corner": (lambda: blend(A, B, A, 0.1, S, "cubic"), "parabola.*quintic.*cubic"),
    "blends do not fit": (lambda: blend(A, B, A, [0.1, 0.2], S), r"\(2,\).*\(5,\)"),
    "blend of arrays": (lambda: blend(np.eye(4), B, A, 0.1, S), "start.*lerp.*ndarray"),
    "blend via an array": (lambda: blend(A, np.eye(4), A, 0.1, S), r"wanted a Transform.*\(4, 4\)"),
    "blend to a list": (lambda: blend(A, B, [0, 0, 0], 0.1, S), "wanted a Transform"),
    "share past the end": (lambda: lin(A, B, 1.5), "1.5"),
    "share before the start": (lambda: lin_lin(A, B, A, [-0.5, 0.5]), "-0.5"),
    "time for a share": (lambda: blend(A, B, A, 0.1, np.linspace(0, 20, 5)), "0 to 20"),
    "no shares": (lambda: lin(A, B, []), "empty"),
    "shares of many axes": (lambda: lin(A, B, np.full(MANY, 0.5)), "s: wanted at most 30 axes.*33"),
    "blends of many axes": (lambda: blend(A, B, A, np.full(MANY, 0.1), 0.5), "at most 30 axes"),
    "joints of many axes": (lambda: IRB140.frames(np.zeros((*MANY, 6))), "q: .*30 axes, got 34"),
    "levers of many axes": (lambda: three_lever(1).family((1, 1), np.ones(MANY)), "30 axes"),
    "identities of many axes": (lambda: Transform.identity(MANY), "shape: .*at most 30.*33"),
    "new axes": (lambda: B[(None,) * 33], "index: .*at most 32 axes.*34"),
    "no shares, blend": (lambda: blend(A, B, A, 0.1, []), "empty"),
    "no shares, ptp": (lambda: ptp([0], [1], []), "empty"),
    "NaN share": (lambda: ptp([0], [1], NAN), "nan"),
    "lin of joints": (lambda: lin(np.zeros(6), np.ones(6), 0.5), "start.*lerp.*ndarray"),
    "lin to joints": (lambda: lin(A, np.zeros(6), 0.5), r"wanted a Transform.*\(6,\)"),
    "ptp of poses": (lambda: ptp(A, B, 0.5), "wanted numbers.*Transform"),
    "ptp of two arms": (lambda: ptp(np.zeros(6), np.zeros(4), 0.5), r"\(6,\) and \(4,\)"),
    "ptp of a number": (lambda: ptp(0.0, 1.0, 0.5), r"\(\) and \(\)"),
    "ptp to a missing row": (lambda: ptp(np.zeros(6), np.full(6, NAN), 0.5), "q1.*nan"),
    "ptp batches": (lambda: ptp(np.zeros((2, 6)), np.zeros(6), S), r"\(2,\).*\(5,\)"),
    # derivatives
    "no samples": (lambda: differentiate([], []), "three"),
    "two samples": (lambda: differentiate([1, 2], [0, 1]), r"three times, got shape \(2,\)"),
    "one sample too many": (
        lambda: differentiate(np.zeros((6, 2)), np.arange(5)),
        r"5 samples.*\(6, 2\)",
    ),
    "transposed samples": (
        lambda: differentiate(np.zeros((6, 50)), np.arange(50)),
        r"50 samples.*\(6, 50\)",
    ),
    "a single value": (lambda: differentiate(1.0, np.arange(5)), r"\(\)"),
    "repeated time": (lambda: differentiate(np.zeros(4), [0, 1, 1, 2]), "increasing"),
    "decreasing times": (lambda: differentiate(np.zeros(4), [3, 2, 1, 0]), "increasing"),
    "times of a batch": (lambda: differentiate(np.zeros((4, 2)), np.zeros((4, 2))), r"\(4, 2\)"),
    "NaN time ": (lambda: differentiate(np.zeros(4), [0, 1, NAN, 2]), "nan"),
    "infinite value": (lambda: differentiate([0, INF, 0, 0], np.arange(4)), "inf"),
    "order 0": (lambda: differentiate(np.zeros(4), np.arange(4), 0), "got 0"),
    "order 1.5": (lambda: differentiate(np.zeros(4), np.arange(4), 1.5), "got 1.5"),
    "step for times": (lambda: differentiate(np.zeros(4), 0.01), r"\(\)"),
}


@pytest.mark.parametrize("name", WRONG)
def test_error_names_the_invalid_input(name):
    call, evidence = WRONG[name]
    with pytest.raises(
        TypeError if name in OF_ANOTHER_KIND else ValueError, match=evidence
    ) as caught:
        call()
    text = str(caught.value)
    assert len(text) < 200 and "\n" not in text


# Calls with an argument that should be an object of a class, but is not.
OF_ANOTHER_KIND = {
    "slerp to an array",
    "matrix as rotation",
    "lerp to an array",
    "lerp to a rotation",
    "matrix to ik",
    "list to ik",
    "position to ik",
    "target to ik",
    "position to SCARA",
    "no geometry",
    "a pose among links",
    "links of another kind",
    "one of the links",
    "link from a matrix",
    "link after a matrix",
    "link that slides in words",
    "three levers explained",
    "blend of arrays",
    "blend via an array",
    "blend to a list",
    "lin of joints",
    "lin to joints",
}


def same(a, b):
    return np.allclose(a.as_matrix(), b.as_matrix(), rtol=0, atol=1e-15)


RIGHT = {
    "start equal to goal, lin": lambda: same(lin(A, A, S), A),
    "start equal to goal, ptp": lambda: (ptp(np.ones(6), np.ones(6), S) == 1).all(),
    "start equal to goal, blend": lambda: same(blend(B, B, B, 0.3, S), B),
    "the smallest blend": lambda: same(blend(A, B, A, 5e-324, S), lin_lin(A, B, A, S)),
    "start equal to via": lambda: same(blend(A, A, B, 0.0, S), lin_lin(A, A, B, S)),
    "via and back": lambda: same(blend(A, B, A, 0.2, 1.0), A),
    "whole numbers": lambda: same(
        Transform(Quaternion([0, 1, 0, 0]), (1, 2, 3)).inverse().inverse(),
        Transform(Quaternion([0, 1, 0, 0]), (1, 2, 3)),
    ),
    "lists": lambda: np.allclose(B @ [[0, 0, 0], [0, 0, 1]], [[0.3, 0.2, 0.5], [0.3, 0.2, 1.5]]),
    "an empty batch of poses": lambda: IRB140.ik(Transform.identity((0,))).shape == (0, 8, 6),
    "an empty batch of joints": lambda: IRB140.fk(np.zeros((0, 6))).shape == (0,),
    "no points": lambda: (B @ np.zeros((0, 3))).shape == (0, 3),
    "a share past the end by a rounding error": lambda: same(lin(A, B, 1 + 1e-15), B),
    "NaN joints": lambda: np.isnan(IRB140.fk(np.full(6, NAN)).translation).all(),
    "a missing pose": lambda: np.isnan(IRB140.ik(IRB140.fk(np.full((2, 6), NAN)))).all(),
    "a missing row stays missing": lambda: np.isnan(
        differentiate(np.full((4, 2), NAN), np.arange(4))
    ).all(),
    "a far pose": lambda: np.isnan(IRB140.ik(Transform(translation=(1e100, 0, 0)))).all(),
    "a pose at the base": lambda: IRB140.ik(Transform()).shape == (8, 6),
    "a duration in an array without axes": lambda: linear(np.array(20))(5) == 0.25,
    "one quarter": lambda: trapezoidal(2, np.float32(0.25))(1) == 0.5,
}


@pytest.mark.parametrize("name", RIGHT)
def test_unusual_input_gives_the_correct_answer(name):
    with np.errstate(over="raise", divide="raise", invalid="raise"):
        assert RIGHT[name]()
