"""Two links in the plane (source 002): the reference cases, the document's formula and errata S2,
and the code that a computer algebra system generates from the general solution.
"""

import ctypes
import math
import shutil
import subprocess

import numpy as np
import pytest
import sympy as sp
from machines import SHAPES, oracle, turns

from robokin import Transform, explain, follow, two_link, within

CASES = oracle("planar2")["cases"]
cases = pytest.mark.parametrize(
    "case", CASES, ids=[f"{i}-{case['kind']}" for i, case in enumerate(CASES)]
)
lengths = pytest.mark.parametrize("l1, l2", [(1, 1), (1, 1.5), (2, 0.3), (0.3, 2)])


def elbows(arm, rows):
    """The positions (x2, y2) of the elbow, the unknowns of the document."""
    return arm.frames(rows)[..., 1].translation[..., :2]


# ---- the arm


@cases
def test_ik_matches_the_reference_cases(case):
    arm = two_link(case["l1"], case["l2"], case["base"])
    rows = arm.ik(case["target"])
    if not case["reachable"]:
        assert np.isnan(rows).all() and "does not exist" in explain(arm, case["target"], 0)
        return
    np.testing.assert_allclose(arm.fk(rows).translation[:, :2], [case["target"]] * 2, atol=1e-12)
    if not case["solutions"]:  # the links are equal and the tip is at the base, so q1 is free
        assert abs(rows[:, 1]) == pytest.approx(np.pi) and (rows[:, 0] == 0).all()
    tolerance = 1e-4 if case["singular"] else 1e-9
    for row, solution in zip(rows, [*case["solutions"], *case["solutions"]][:2], strict=False):
        assert turns(row, solution).max() < tolerance
    for point, elbow in zip(
        elbows(arm, rows), [*case["elbows"], *case["elbows"]][:2], strict=False
    ):
        np.testing.assert_allclose(point, elbow, atol=tolerance)
    if "q" in case:
        assert turns(rows, case["q"]).max(axis=-1).min() < 1e-9


@lengths
@pytest.mark.parametrize("base", [(0, 0), (-3.2, 0.7)])
@pytest.mark.parametrize("shape", SHAPES)
def test_ik_contains_the_original_joint_values(l1, l2, base, shape):
    arm = two_link(l1, l2, base)
    q = np.random.default_rng(3).uniform(-np.pi, np.pi, (*shape, 2))
    q[..., 1] = np.where(abs(q[..., 1]) < 0.1, 1.0, q[..., 1])
    pose = arm.fk(q)
    rows = arm.ik(pose)
    assert rows.shape == (*shape, 2, 2) and (np.sign(rows[..., 1]) == [1, -1]).all()
    assert turns(rows, q[..., None, :]).max(-1).min(-1).max() < 1e-9
    assert abs(arm.fk(rows).translation - pose.translation[..., None, :]).max() < 1e-14 * 20
    np.testing.assert_array_equal(arm.ik(pose.translation), rows)
    np.testing.assert_array_equal(arm.ik(pose.translation[..., :2]), rows)
    assert within(arm, rows).all()
    # The elbow is l1 away from the base and l2 away from the tip. In each row, it stays on one side
    # of the line from the base to the tip.
    elbow, tip = elbows(arm, rows), pose.translation[..., None, :2]
    assert np.linalg.norm(elbow - base, axis=-1) == pytest.approx(l1)
    assert np.linalg.norm(elbow - tip, axis=-1) == pytest.approx(l2)
    way, out = tip - base, elbow - base
    assert (np.sign(way[..., 0] * out[..., 1] - way[..., 1] * out[..., 0]) == [-1, 1]).all()


@pytest.mark.parametrize("x3", [0.0, -0.0, 1e-300, -1e-300, 5e-324, 1e-9, -1e-9])
def test_ik_is_correct_at_and_near_x3_equal_to_zero(x3):
    arm, near = two_link(1, 1), two_link(1, 1).ik((1e-7, 0.3))
    rows = arm.ik((x3, 0.3))
    assert abs(rows - near).max() < 1e-6
    np.testing.assert_allclose(arm.fk(rows).translation, [(x3, 0.3, 0)] * 2, atol=1e-15)
    tiny = arm.ik((x3, 0.0))  # the tip is at the base or very close to it
    np.testing.assert_allclose(arm.fk(tiny).translation, [(x3, 0, 0)] * 2, atol=1e-15)
    assert abs(tiny[:, 1]) == pytest.approx(np.pi, abs=2e-9)
    if x3:  # link 1 is then perpendicular to the line to the tip and may be on either side
        ahead = 0 if x3 > 0 else np.pi
        assert turns(tiny[:, 0], [ahead - np.pi / 2, ahead + np.pi / 2]).max() < 1e-9


@lengths
def test_stretched_and_folded_arms_are_reachable_and_points_beyond_are_not(l1, l2):
    arm = two_link(l1, l2, (0.4, -0.2))
    for angle in np.linspace(-3, 3, 13):
        way = np.array([np.cos(angle), np.sin(angle)])
        for d, q2 in ((l1 + l2, 0), (abs(l1 - l2), np.pi)):
            rows = arm.ik((0.4, -0.2) + d * way)
            assert turns(rows[:, 1], q2).max() < 1e-7
            np.testing.assert_allclose(
                arm.fk(rows).translation[:, :2] - (0.4, -0.2), [d * way] * 2, atol=1e-14
            )
            if d:
                assert (
                    turns(rows[:, 0], angle if q2 == 0 or l1 > l2 else angle + np.pi).max() < 1e-7
                )
            assert arm.geometry.singularities(rows)["elbow"].all()
        assert np.isnan(arm.ik((0.4, -0.2) + (l1 + l2) * (1 + 1e-9) * way)).all()
        if l1 != l2:
            assert np.isnan(arm.ik((0.4, -0.2) + abs(l1 - l2) * (1 - 1e-9) * way)).all()
    x, y = 0.4, -0.2 + max(l1, l2)
    np.testing.assert_array_equal(
        two_link(l1, l2).ik((-max(l1, l2), -0.0)), two_link(l1, l2).ik((-max(l1, l2), 0.0))
    )
    mixed = arm.ik([(x, y), (99, 0)])
    assert np.isfinite(mixed[0]).all() and np.isnan(mixed[1]).all()
    assert np.isnan(arm.ik((x, y, 1e-3))).all() and np.isfinite(arm.ik((x, y, 0))).all()


def test_explain_states_each_reason():
    arm = two_link(1, 1.5)
    assert "does not exist: the target is 500.0 mm beyond the reach of the arm" in explain(
        arm, (3, 0), 0
    )
    assert "400.0 mm too near to the base" in explain(arm, (0.1, 0), 1)
    assert "1.0 mm off the plane" in explain(arm, (1, 0, 1e-3), 0)
    assert "is usable: it is inside every limit and not singular" in explain(arm, (1, 1), 0)
    assert "did you mean millimetres" in explain(arm, (1200, 0), 0)
    assert "stretched or folded" in explain(arm, Transform(translation=(0, 2.5, 0)), 0)


def test_follow_goes_through_the_base_with_one_elbow():
    arm = two_link(1, 1)
    x = np.linspace(-1, 1, 201)  # at x = 0 the tip is at the base, where q1 is free
    q = follow(arm, arm.ik(np.stack([x, 0 * x], axis=-1)), arm.branch(+1))
    np.testing.assert_allclose(arm.fk(q).translation[:, 0], x, atol=1e-12)
    assert abs(np.diff(q, axis=0)).max() < 0.03


def test_invalid_arguments_are_refused():
    for call, complaint in (
        (lambda: two_link(0, 1), "l1: wanted one positive length"),
        (lambda: two_link(1, -2), "l2: wanted one positive length"),
        (lambda: two_link(1, np.inf), "l2: wanted finite"),
        (lambda: two_link(1, 1, (0, 0, 0)), r"base: wanted shape \(..., 2\)"),
        (lambda: two_link(1, 1, [(0, 0)]), r"base: wanted one point"),
        (lambda: two_link(1, 1).ik(3.0), r"\(\.\.\., 2\) or \(\.\.\., 3\)"),
        (lambda: two_link(1, 1).ik((np.nan, 0)), "finite"),
        (lambda: two_link(1, 1).branch(0), "flags"),
    ):
        with pytest.raises(ValueError, match=complaint):
            call()


# ---- the document's formula (2) and its errors


def printed(x3, y3, l):  # noqa: E741  (the document's letter)
    """The first root of (2) as printed."""
    root = math.sqrt(-(x3**2) * (x3**2 + y3**2) * (-4 * l**2 + x3**2 + y3**2))
    below = 2 * x3 * (x3**2 + y3**2)
    return (x3**4 + x3**2 * y3**2 - y3 * root) / below, (x3**2 * y3 + y3**3 + root) / below


def test_the_printed_y2_has_a_wrong_denominator():
    x2, y2 = printed(1.2, 0.7, 1)  # errata S2-a
    assert (x2, y2) == pytest.approx((0.2375279178, 0.8094839269))
    assert math.hypot(x2, y2) == pytest.approx(0.8436, abs=1e-4)  # instead of l = 1
    arm = two_link(1, 1)
    right = elbows(arm, arm.ik((1.2, 0.7)))
    assert right[1] == pytest.approx((x2, 1.2 * y2)) and right[1, 1] == pytest.approx(0.9713807123)
    assert right[0] == pytest.approx((0.9624720822, -0.2713807123))
    with pytest.raises(ZeroDivisionError):  # errata S2-d
        printed(0.0, 0.3, 1)


def test_the_printed_root_swaps_the_elbow_when_x3_changes_sign():
    sides = []
    for x3 in (0.1, -0.1):
        x2, y2 = printed(x3, 1, 1)
        # the cross product of the vectors to the tip and to the elbow, with y2 corrected
        sides.append(x3 * (x3 * y2) - 1 * x2)
    assert sides == pytest.approx([0.8689, -0.8689], abs=1e-4)  # errata S2-d


# ---- code generation: the same derivation as in lab 12


def document():
    """x2 of (2), and all four coordinates with the denominator of y2 corrected: (symbols, [x2],
    [x2, y2, x2, y2]).
    """
    x3, y3, l = symbols = sp.symbols("x3 y3 l")  # noqa: E741
    root = sp.sqrt(-(x3**2) * (x3**2 + y3**2) * (-4 * l**2 + x3**2 + y3**2))
    x2 = [
        (x3**4 + x3**2 * y3**2 + side * y3 * root) / (2 * x3 * (x3**2 + y3**2)) for side in (-1, 1)
    ]
    y2 = [(x3**2 * y3 + y3**3 - side * root) / (2 * (x3**2 + y3**2)) for side in (-1, 1)]
    return symbols, x2[:1], [x2[0], y2[0], x2[1], y2[1]]


def general():
    """Both elbows for any lengths and base: (symbols, [x2, y2, x2, y2])."""
    x1, y1, x3, y3, l1, l2 = symbols = sp.symbols("x1 y1 x3 y3 l1 l2")
    dx, dy = x3 - x1, y3 - y1
    d2 = dx**2 + dy**2
    # the foot of the perpendicular from the elbow to the line from base to tip, as a fraction of
    # the length of that line
    along = (d2 + l1**2 - l2**2) / (2 * d2)
    across = sp.sqrt(l1**2 / d2 - along**2)
    return symbols, [
        c
        for side in (1, -1)
        for c in (x1 + along * dx + side * across * dy, y1 + along * dy - side * across * dx)
    ]


def operations(expressions):
    """SymPy's operation counts before and after common subexpressions are extracted."""
    steps, results = sp.cse(expressions)
    return sum(map(sp.count_ops, expressions)), sum(
        sp.count_ops(e) for e in [*results, *(step for _, step in steps)]
    )


def test_the_operation_counts_match_the_errata():
    _, x2, four = document()  # errata S2-f
    assert operations(x2) == (28, 19)
    assert operations(four) == (108, 33)
    assert operations(general()[1]) == (208, 30)
    # so for both elbows, (2) saves no operations, but it does for x2 alone
    assert operations(general()[1][:1]) == (52, 24)


def test_the_general_solution_solves_the_two_circles():
    (x1, y1, x3, y3, l1, l2), (xa, ya, xb, yb) = general()
    for x2, y2 in ((xa, ya), (xb, yb)):
        assert sp.factor((x2 - x1) ** 2 + (y2 - y1) ** 2 - l1**2) == 0
        assert sp.factor((x2 - x3) ** 2 + (y2 - y3) ** 2 - l2**2) == 0


def c_source(name, symbols, expressions):
    """A C function of doubles with out[] as its last argument, without the document's casts to int
    (errata S2-c).
    """
    steps, results = sp.cse(expressions)
    lines = [f"    const double {target} = {sp.ccode(step)};" for target, step in steps]
    lines += [f"    out[{i}] = {sp.ccode(result)};" for i, result in enumerate(results)]
    arguments = ", ".join(f"double {symbol}" for symbol in symbols)
    return (
        f"#include <math.h>\nvoid {name}({arguments}, double *out) {{\n"
        + "\n".join(lines)
        + "\n}\n"
    )


def compiled(source, name, folder, arguments):
    """The C function as a Python function of one row of arguments."""
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        pytest.skip("no C compiler on this machine")
    (folder / "elbow.c").write_text(source)
    library = folder / "elbow.so"
    subprocess.run(
        [
            compiler,
            "-O2",
            "-Wall",
            "-Werror",
            "-shared",
            "-fPIC",
            "-o",
            library,
            folder / "elbow.c",
            "-lm",
        ],
        check=True,
        capture_output=True,
        text=True,
    )
    function = getattr(ctypes.CDLL(str(library)), name)
    function.argtypes, function.restype = (
        [ctypes.c_double] * arguments + [ctypes.POINTER(ctypes.c_double)],
        None,
    )

    def call(row):
        out = (ctypes.c_double * 4)()
        function(*row, out)
        return list(out)

    return call


def targets(count):
    """Rows x1 y1 x3 y3 l1 l2 with the tip well within reach."""
    rng = np.random.default_rng(7)
    l1, l2 = rng.uniform(0.3, 2, (2, count))
    x1, y1 = rng.uniform(-2, 2, (2, count))
    d = abs(l1 - l2) + rng.uniform(0.05, 0.95, count) * (l1 + l2 - abs(l1 - l2))
    angle = rng.uniform(-np.pi, np.pi, count)
    return np.stack([x1, y1, x1 + d * np.cos(angle), y1 + d * np.sin(angle), l1, l2], axis=1)


def test_generated_python_agrees_with_the_arm():
    symbols, expressions = general()
    generated = sp.lambdify(symbols, expressions, "numpy", cse=True)
    for row in targets(200):
        *_, l1, l2 = row
        arm = two_link(l1, l2, row[:2])
        assert elbows(arm, arm.ik(row[2:4])).ravel() == pytest.approx(generated(*row), abs=1e-12)


def test_generated_c_agrees_with_generated_python(tmp_path):
    symbols, expressions = general()
    in_c = compiled(c_source("elbow", symbols, expressions), "elbow", tmp_path, 6)
    in_python = sp.lambdify(symbols, expressions, "numpy", cse=True)
    rows = targets(500)
    assert "(int)" not in c_source("elbow", symbols, expressions)
    np.testing.assert_allclose(
        [in_c(row) for row in rows], np.transpose(in_python(*rows.T)), rtol=0, atol=1e-12
    )


def test_generated_c_is_correct_only_without_the_casts_of_the_document(tmp_path):
    symbols, x2, four = document()
    in_c = compiled(c_source("elbow", symbols, four), "elbow", tmp_path, 3)
    assert in_c((1.2, 0.7, 1)) == pytest.approx(
        [0.2375279178, 0.9713807123, 0.9624720822, -0.2713807123]
    )
    # errata S2-c: the document's listing, for (1.2, 0.7) and l = 1
    t1, t3, x3, y3 = int(1.2**2), int(0.7**2), 1.2, 0.7
    t5, t7 = int(t1 + t3), 1
    t11 = math.sqrt(-(t1 * t5 * (-4 * t7 + t1 + t3)))
    assert (t1**2 + t1 * t3 - y3 * t11) / x3 / t5 / 2 == pytest.approx(-0.0885148)
