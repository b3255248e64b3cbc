"""The three-lever arm beside an obstacle: reference cases (oracle), bounds against samples, and honest plans.

ROBOKIN_TASKS=2000 takes that many random tasks for `test_a_plan_keeps_its_clearance_or_says_that_there_is_none`, and
`python tests/test_obstacles.py 2000` prints the share solved beside the document's two via points.
"""

import json
import os
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from robokin import deg, three_lever
from robokin.jobs.obstacles import (
    along,
    clearance,
    distances,
    in_quadrilateral,
    keeps,
    plan,
    swept,
    via_path,
    via_points,
)

ARM = three_lever(1.0)
CASES = json.loads((Path(__file__).parent / "data" / "planar_obstacle.json").read_text())["cases"]
TASKS = int(os.environ.get("ROBOKIN_TASKS", "40"))


def levers(q):
    """The joints O, B, A, K of postures (..., 3), from complex numbers: not the package's formulas."""
    gamma, beta, alpha = np.moveaxis(np.asarray(q), -1, 0)
    B = np.exp(1j * gamma)
    A = B - np.exp(1j * (gamma + beta))
    return np.stack([0 * B, B, A, A + np.exp(1j * (gamma + beta + alpha))], axis=-1)


def sampled(path, H, count=1500):
    """The least distance of each lever from H over dense samples of a path: (3,)."""
    s = np.linspace(0, 1, count)[:, None]
    q = np.concatenate([a + (b - a) * s for a, b in zip(path[:-1], path[1:], strict=True)])
    points = levers(q)
    a, b, h = points[:, :-1], points[:, 1:], complex(*H[:2])
    t = np.clip(((h - a) * (b - a).conj()).real / abs(b - a) ** 2, 0, 1)
    return abs(a + t * (b - a) - h).min(axis=0)


def tasks(count, seed=5):
    """Random postures, targets and obstacles that stand in the way of the direct motion, though neither the start nor
    the target is nearer than L/7.
    """
    rng = np.random.default_rng(seed)
    found = 0
    while found < count:
        q0 = rng.uniform([0.2, 0.6, 0.6], np.pi)
        K1 = rng.uniform(1.05, 2.9) * np.exp(1j * rng.uniform(0, np.pi))
        H = rng.uniform(0.4, 2.7) * np.exp(1j * rng.uniform(0, np.pi))
        K1, H = np.array([K1.real, K1.imag]), np.array([H.real, H.imag])
        q1, _ = ARM.least(K1, q0)
        if np.isnan(q1).any() or np.hypot(*(K1 - H)) < 1 / 7 or sampled(np.stack([q0, q0]), H, 2).min() < 1 / 7:
            continue
        if sampled(np.stack([q0, q1]), H, 300).min() < 1 / 7:
            found += 1
            yield q0, K1, H


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_reference_cases(case):
    q0, q1 = np.array(case["previous"])[::-1], np.array(case["new"])[::-1]
    H = np.array(case["H"])
    for q, a, k in ((q0, "A", "K"), (q1, "A1", "K1")):
        np.testing.assert_allclose(ARM.joints(q)[2:], [case[a], case[k]], atol=1e-9)
    assert in_quadrilateral(ARM, q0, q1, H)["AK"] == case["inside_quadrilateral"]
    assert swept(ARM, q0, q1, H)["AK"] == case["swept_by_AK_joint_linear"]
    least = clearance(ARM, np.stack([q0, q1]), H)[0, 2]
    assert abs(least - case["min_distance_AK_joint_linear"]) < 1e-3  # theirs is sampled
    np.testing.assert_allclose(via_points(case["K"], case["K1"], H, 1 / 7), [case["K2"], case["K3"]], atol=1e-9)


def test_clearance_is_a_bound_and_a_tight_one():
    rng = np.random.default_rng(1)
    for _ in range(40):
        path = rng.uniform(0, np.pi, (3, 3))
        H = rng.normal(size=2)
        bound, seen = clearance(ARM, path, H).min(axis=0), sampled(path, H, 4000)
        assert (bound <= seen).all() and (seen - bound < 2e-3).all()
        for distance in (bound.min() * 0.999 - 1e-5, seen.min() * 1.001 + 1e-5):
            kept = all(keeps(ARM, a, b, H, distance) for a, b in zip(path[:-1], path[1:], strict=True))
            assert kept == (distance < bound.min())
        np.testing.assert_allclose(distances(ARM, path[0], H), sampled(path[[0, 0]], H, 2), atol=1e-13)


def test_via_points_are_square_to_the_line_and_on_the_side_of_the_base():
    """Errata S3-m: the printed K2 is not square (cosine .690) and lies away from the base."""
    H, K, K1 = np.array([1.5, 1.0]), np.array([1.2, 1.7]), np.array([1.9, 0.3])
    K2, K3 = via_points(K, K1, H, 1 / 7)
    np.testing.assert_allclose(K2, [1.368693567, 0.943725814], atol=1e-9)
    np.testing.assert_allclose(K3, [1.375965265, 0.929123009], atol=1e-9)
    printed = np.array([1.556274, 1.131306])
    cosine = (printed - H) @ (K - H) / np.hypot(*(printed - H)) / np.hypot(*(K - H))
    assert abs(cosine) == pytest.approx(0.690, abs=1e-3)
    for via, end in ((K2, K), (K3, K1)):
        assert abs((via - H) @ (end - H)) < 1e-15 and np.hypot(*via) < np.hypot(*H)


def test_the_quadrilateral_is_not_the_swept_area():
    """Errata S3-l: both kinds of mistake happen."""
    missed = false = 0
    for case in CASES:
        missed += case["swept_by_AK_joint_linear"] and not case["inside_quadrilateral"]
        false += case["inside_quadrilateral"] and not case["swept_by_AK_joint_linear"]
    assert missed > 0 and false > 0


def test_a_plan_keeps_its_clearance_or_says_that_there_is_none():
    solved = 0
    for q0, K1, H in tasks(TASKS):
        p = plan(ARM, q0, K1, H)
        np.testing.assert_array_equal(p.path[0], q0)
        assert p.found == (p.way != "none") and p.words
        if not p.found:
            assert len(p.path) == 1 and "no way" in p.words
            continue
        solved += 1
        assert p.clearance.min() >= 1 / 7 and p.clearance.min() <= sampled(p.path, H).min()
        np.testing.assert_allclose(levers(p.posture)[3], complex(*K1), atol=1e-12)
        assert p.cost == pytest.approx(abs(np.diff(p.path, axis=0)).sum()) and p.cost >= p.least - 1e-12
        assert (p.path >= -1e-9).all() and (p.path <= np.pi + 1e-9).all()
    assert solved >= 0.6 * TASKS  # of the others a good part has no posture at the target that keeps the distance


def test_a_small_clearance_is_found_where_a_large_one_is():
    """One step of the search can leap over the obstacle; that must not cost the way."""
    q0 = ARM.family((1.2, 1.7), 118 * deg)
    for distance in (0.02, 0.05, 0.1):
        assert plan(ARM, q0, (1.9, 0.3), (0.4, 1.0), distance).found


def test_refusals_are_said_in_words():
    q0 = np.array([2.0, 2.5, 2.0])
    K, A = ARM.joints(q0)[3], ARM.joints(q0)[2]
    for target, H, words in (((4.0, 0.0), (1, 1), "out of reach"), ((0.5, 0.0), (1, 1), "out of reach"),
                             ((1.9, 0.3), (0.05, 0.0), "base"), ((1.9, 0.3), (1.9, 0.35), "target lies 0.05 m"),
                             ((1.9, 0.3), K, "At the start lever AK"), ((1.9, 0.3), (A + K) / 2, "At the start")):
        p = plan(ARM, q0, target, H)
        assert not p.found and words in p.words and len(p.path) == 1 and p.cost == 0
    p = plan(ARM, q0, (1.9, 0.3))
    assert p.found and p.way == "direct"
    np.testing.assert_allclose(along(p.path, [0, 0.5, 1]), [q0, p.path.mean(axis=0), p.path[1]], atol=1e-12)


@pytest.mark.parametrize("wrong, words", [
    (lambda: plan(ARM, (1, 2), (1.9, 0.3)), "3"),
    (lambda: plan(ARM, (1, 2, 4), (1.9, 0.3)), "0 to 180"),
    (lambda: plan(ARM, (1, 2, 2), (1.9, np.nan)), "nan"),
    (lambda: plan(ARM, (1, 2, 2), (1.9, 0.3), (1, 1), -0.1), "-0.1"),
    (lambda: plan("arm", (1, 2, 2), (1.9, 0.3)), "ThreeLever"),
    (lambda: via_points((1, 1), (2, 0), (1, 1), 0.1), "apart from K"),
])
def test_wrong_calls_are_refused(wrong, words):
    with pytest.raises(ValueError, match=words):
        wrong()


def main(count):
    """Print the share solved and the added movement, the package's plan beside the document's via points."""
    solved, ways, added, times, document, swept_by, hopeless = 0, {}, [], [], 0, 0, 0
    for q0, K1, H in tasks(count):
        start = time.perf_counter()
        p = plan(ARM, q0, K1, H)
        times.append(time.perf_counter() - start)
        ways[p.way] = ways.get(p.way, 0) + 1
        if p.found:
            assert sampled(p.path, H).min() >= 1 / 7
            solved += 1
            added.append(p.cost - p.least)
        else:
            goals = ARM.family(K1, np.linspace(*ARM.alpha_range(K1), 2000))
            hopeless += (distances(ARM, goals, H).min(axis=-1) < 1 / 7).all()
        path = via_path(ARM, q0, K1, H)
        least = np.nan if np.isnan(path).any() else clearance(ARM, path, H).min()
        document += least >= 1 / 7
        swept_by += least <= 0
    print(f"{count} tasks with the obstacle nearer than L/7 to the direct motion: solved {solved} "
          f"({100 * solved / count:.1f} %), ways {ways}; added movement median {np.median(added) / deg:.1f} degrees "
          f"(90 % below {np.quantile(added, 0.9) / deg:.1f}); {1000 * np.median(times):.0f} ms each, "
          f"at most {1000 * max(times):.0f} ms")
    print(f"of the {count - solved} others {hopeless} have no posture at the target that keeps L/7")
    print(f"the document's via points: keep L/7 in {document}, a lever sweeps the obstacle in {swept_by}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
