"""The distance from singularities, computed with all lengths divided by the same length."""

from types import SimpleNamespace

import numpy as np
import pytest
from machines import MACHINES, random_joints

from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Arm,
    Link,
    Transform,
    distance_from_singularity,
    itmo_arm,
    scara_arm,
    singular_values,
    spbu_arm,
    three_lever,
    two_link,
)
from robokin.arms import total_length
from robokin.arms.dexterity import spread

RNG = np.random.default_rng(12)


def test_reach_is_the_greatest_distance_from_axis_1():
    assert two_link(0.3, 0.5).reach == pytest.approx(0.8)
    assert IRB140.reach == pytest.approx(0.07 + 0.35 + 0.38)
    assert PUMA560.reach == pytest.approx(0.4318 + np.hypot(0.4318, 0.0203))
    assert SCARA.reach == pytest.approx(0.45)
    assert spbu_arm(5, 4).reach == pytest.approx(9)
    assert three_lever(0.4).reach == pytest.approx(1.2)


def test_total_length_is_that_of_the_stretched_chain():
    assert total_length(two_link(0.3, 0.5)) == pytest.approx(0.8)
    assert total_length(IRB140) == pytest.approx(0.352 + 0.07 + 0.35 + 0.38 + 0.065)
    assert total_length(SCARA) == pytest.approx(0.2202 + 0.2 + 0.25 + 0.18)
    assert total_length(three_lever(0.4)) == pytest.approx(1.2)


def test_product_of_two_singular_values_is_the_area_of_the_parallelogram():
    """The area is det J = l1 l2 sin q2, divided by the square of the reach."""
    arm = two_link(0.3, 0.5)
    q = RNG.uniform(-3, 3, (200, 2))
    wanted = 0.3 * 0.5 * abs(np.sin(q[:, 1])) / 0.8**2
    assert np.allclose(singular_values(arm, q).prod(-1), wanted, rtol=0, atol=1e-15)


@pytest.mark.parametrize("machine", MACHINES, ids=repr)
def test_singular_values_bound_the_tool_step_of_small_joint_steps(machine):
    """For a small unit joint step in any direction, the length of the tool's step is between the
    smallest and the greatest singular value. The steps are differences of FK, with lengths divided
    by the reach.
    """
    arm = machine.arm
    q = random_joints(arm, RNG, (5,))
    values = singular_values(arm, q)
    assert (np.diff(values, axis=-1) <= 0).all() and (values >= 0).all()
    scale = np.where(arm.prismatic, 1 / arm.reach, 1.0)  # a stroke is divided by the reach
    seen = []
    for _ in range(200):
        step = RNG.normal(size=len(arm.links))
        step *= 1e-6 / np.linalg.norm(step)
        a, b = arm.fk(q - step / scale / 2), arm.fk(q + step / scale / 2)
        moved = np.linalg.norm(b.translation - a.translation, axis=-1) / arm.reach
        if len(arm.links) > 3:
            moved = np.hypot(moved, a.rotation.angle_to(b.rotation))
        seen.append(moved / 1e-6)
    seen = np.array(seen)
    assert (seen <= values[:, 0] + 1e-6).all() and (seen >= values[:, -1] - 1e-6).all()
    assert (seen.max(0) > 0.5 * values[:, 0]).all()


def test_distance_from_singularity_is_zero_at_a_singularity_and_nan_for_nan():
    for arm, q in (
        (IRB140, np.zeros(6)),  # wrist singularity
        (PUMA560, [0.3, -0.4, -np.pi / 2 + np.arctan2(20.3, 431.8), 0.2, 0.7, 0]),  # stretched arm
        (SCARA, [0.2, np.pi, 0.1, 0.05]),  # folded arm
        (three_lever(0.4), [0.5, np.pi, np.pi]),
    ):
        assert distance_from_singularity(arm, q) < 1e-10
        away = np.asarray(q) + 0.3
        assert distance_from_singularity(arm, away) > 1e-3
        rows = distance_from_singularity(arm, [away, np.full(len(away), np.nan)])
        assert rows[0] == distance_from_singularity(arm, away) and np.isnan(rows[1])


def test_distance_from_singularity_does_not_depend_on_the_size_of_the_arm():
    q = RNG.uniform(-2, 2, (20, 6))
    big = itmo_arm(1, 1, 2, 2)
    assert np.allclose(singular_values(ITMO6R, q), singular_values(big, q), rtol=1e-12, atol=0)
    small, large = (
        scara_arm("any", 0.3 * k, 0.2 * k, 0.25 * k, [(-3, 3)] * 3 + [(0, 0.2 * k)]) for k in (1, 7)
    )
    turns, stroke = RNG.uniform(-2, 2, (20, 3)), RNG.uniform(0, 0.2, (20, 1))
    a = singular_values(small, np.hstack([turns, stroke]))
    b = singular_values(large, np.hstack([turns, 7 * stroke]))
    assert np.allclose(a, b, rtol=1e-12, atol=0) and a.shape == (20, 4)


def test_joints_of_spread_postures_are_uncorrelated():
    count = 40
    chain = SimpleNamespace(links=(Link(),) * count, target=Transform, reach=1.0)
    shares = spread(Arm("many joints", chain, [(0, 1)] * count), 300)
    assert shares.min() > 0 and shares.max() < 1
    apart = abs(shares[:, :, None] - shares[:, None, :]).mean(axis=0)
    assert apart[~np.eye(count, dtype=bool)].min() > 0.05
    roots = np.sqrt([2, 3, 5, 7, 11, 13, 17])
    assert (shares[:, :7] == np.arange(1, 301)[:, None] * roots % 1).all()


def test_number_of_singular_values_follows_from_the_task():
    assert singular_values(two_link(1, 1), [0.1, 0.2]).shape == (2,)
    assert singular_values(SCARA, [0.1, 0.2, 0.3, 0.1]).shape == (4,)
    assert singular_values(IRB140, np.full((3, 6), 0.2)).shape == (3, 6)
