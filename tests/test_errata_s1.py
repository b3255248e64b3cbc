"""Section S1 of the errata, on source 001: the package's functions reproduce every value in it, on
the document's samples.

T = 20 s, step 0.01 s, t = arange(0, 20, 0.01). Speeds and accelerations are the document's forward
differences.
"""

import numpy as np
import pytest
from machines import turns

from robokin import (
    IRB140,
    Quaternion,
    Transform,
    blend,
    deg,
    follow,
    lin,
    lin_lin,
    linear,
    mm,
    nearest,
    ptp,
    within,
)

STEP = 0.01
T = np.arange(0, 20, STEP)
S = linear(20.0)(T)


def pose(x, y, z, angle, axis):
    return Transform(Quaternion.from_angle_axis(angle * deg, axis), np.array([x, y, z]) * mm)


LIN_S, LIN_E = pose(200, 400, 600, 90, (-1, 0, 0)), pose(200, -300, 800, 90, (0, 1, 0))  # listing 7
START, VIA = pose(200, 400, 200, 90, (-1, 0, 0)), pose(650, -100, 800, 45, (0, 1, 0))  # listing 11
GOAL = pose(300, 300, 500, 90, (0, 1, 0))


def task1(s):
    """The target poses of listing 1 at s = t / total."""
    first = s < 0.5
    position = np.stack(
        [
            np.where(first, 200, 200 + (s - 0.5) * 500),
            np.where(first, 50 + 1000 * s, 550),
            np.full_like(s, 500),
        ],
        axis=-1,
    )
    return Transform(Quaternion.from_angle_axis(s * 90 * deg, (0, 1, 0)), position * mm)


def followed(poses, *flags):
    return follow(IRB140, IRB140.ik(poses), IRB140.branch(*flags))


def forward(q):
    """The speeds and accelerations as the document computes them."""
    return np.diff(q, axis=0) / STEP, np.diff(q, n=2, axis=0) / STEP**2


def numbers(text):
    return np.array([float(word) for word in text.split()])


# Named poses, within 1e-9 rad
# ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "target, q",
    [
        (
            LIN_S,
            "1.032574625183 .133983466799 .397177837155 -1.159831766137 -.593382604774 "
            "-.483943407575",
        ),
        (
            LIN_E,
            "-1.147942400662 .300557798925 -.003279721598 -1.704624473753 -1.168461187432 "
            "1.901963972278",
        ),
        (
            lin(LIN_S, LIN_E, 0.5),
            ".042527534620 .910440685219 .612240498055 -1.392983571383 -.704872633774 "
            ".850763960613",
        ),
        (
            START,
            "1.032574625183 -.874524310183 .559990693737 -.542330696781 -1.453877915310 "
            "-1.500616885379",
        ),
        (
            VIA,
            "-.164064410486 -.525019557798 -.789072371054 -.226771227938 -.539464831849 "
            ".311977008633",
        ),
        (
            GOAL,
            ".906300927700 .031106579268 .591044227649 1.176526953340 -1.021027149096 "
            "-.898321015096",
        ),
    ],
    ids=["LIN s", "LIN e", "LIN middle", "chain s", "chain i", "chain e"],
)
def test_named_poses_have_the_published_joint_values(target, q):
    rows = IRB140.ik(target)
    row, other = rows[IRB140.branch(1, 1, -1)], rows[IRB140.branch(1, 1, 1)]
    assert abs(row - numbers(q)).max() < 1e-9
    assert within(IRB140, row).all() and within(IRB140, other).all()
    # "[1,1,1]: q3 +- pi, q4 sign, q5 +- pi" in the document, which counts joints from zero
    assert turns(other, row * [1, 1, 1, 1, -1, 1] + [0, 0, 0, np.pi, 0, np.pi]).max() < 1e-9


@pytest.mark.parametrize(
    "s, q",
    [
        (
            0.0,
            ".244978663127 .515841594924 1.137989897626 3.141592653590 2.192944629496 "
            "2.896613990463",
        ),
        (
            0.5,
            "1.297723457032 -.532631979049 .020014111787 -2.371412775728 1.781222508941 "
            "2.147824594080",
        ),
        (
            1.0,
            ".960070362406 -.745374523308 -.453918606391 -1.769290617314 .989296999509 "
            "1.921825730216",
        ),
    ],
)
def test_poses_of_task_1_have_the_published_joint_values(s, q):
    row = IRB140.ik(task1(np.array(s)))[IRB140.branch(1, 1, 1)]
    assert turns(row, numbers(q)).max() < 1e-9


def test_middle_of_ptp_is_not_the_middle_of_lin():
    row = IRB140.branch(1, 1, -1)
    q = ptp(IRB140.ik(LIN_S)[row], IRB140.ik(LIN_E)[row], 0.5)
    assert (
        abs(
            IRB140.fk(q).translation / mm - [417.864407253254, 25.607533005382, 709.257229809566]
        ).max()
        < 1e-9
    )
    assert abs(lin(LIN_S, LIN_E, 0.5).translation / mm - [200, 50, 700]).max() < 1e-12


# Greatest speeds and accelerations, to all printed digits
# ------------------------------------------------------------

GREATEST = {
    "LIN": (
        lin(LIN_S, LIN_E, S),
        (1, 1, -1),
        ".201241204927 .101759603080 .101941638133 .084900906132 .101568483885 .207912103554",
        ".027473 .023013 .010776 .028650 .028437 .032971",
        1e-6,
    ),
    "LIN-LIN": (
        lin_lin(START, VIA, GOAL, S),
        (1, 1, -1),
        ".167925134190 .254172899579 .546579628640 .184156326854 .377072039796 .254664472000",
        "10.8028 45.6344 91.7166 2.9742 45.4685 21.6681",
        1e-4,
    ),
    "blend 0.1": (
        blend(START, VIA, GOAL, 0.1, S),
        (1, 1, -1),
        ".167925134190 .189357070983 .268949725020 .184156326854 .214674566952 .254664472000",
        ".049798 .073271 .152951 .048029 .077924 .091649",
        1e-6,
    ),
    "task 1": (
        task1(S),
        (1, 1, 1),
        ".241215692916 .119670719889 .180470573894 .100889634196 .083711256740 .227431345143",
        "6.578313 10.066953 15.594048 1.772187 .072151 8.037753",
        1e-6,
    ),
}


def printed_blend(start, via, goal, b, s):
    """Listing 12 as printed, without an upper limit on b: `lin` extrapolates for b above 0.5."""
    x = (s - 0.5 + b) / (2 * b)
    first, last = start.lerp(via, 1 - 2 * b), via.lerp(goal, 2 * b)
    return first.lerp(via, x).lerp(via.lerp(last, x), x)


GREATEST["printed 0.55"] = (
    printed_blend(START, VIA, GOAL, 0.55, S),
    (1, 1, -1),
    ".141967155483 .165137073013 .122065630117 .164512045685 .108753386079 .172384184608",
    ".018458 .029914 .048474 .035459 .048662 .037830",
    1e-6,
)


@pytest.mark.parametrize("name", GREATEST)
def test_greatest_speeds_and_accelerations_match_the_published_ones(name):
    poses, flags, speeds, accelerations, digit = GREATEST[name]
    v, a = forward(followed(poses, *flags))
    assert v.shape == (1999, 6) and a.shape == (1998, 6)
    assert abs(abs(v).max(0) - numbers(speeds)).max() < 1e-12
    assert abs(abs(a).max(0) - numbers(accelerations)).max() < 0.6 * digit


# The errata with their counterexamples
# ----------------------------------------------------------------------------


def jumps(angles):
    """The samples and joints after which a value jumps by more than half a turn."""
    return sorted(
        (round(float(T[i]), 2), int(j))
        for i, j in np.argwhere(abs(np.diff(angles, axis=0)) > np.pi)
    )


def test_s1_e_fixed_row_jumps_by_a_whole_turn_and_follow_does_not():
    front, back = IRB140.branch(1, 1, 1), IRB140.branch(1, 1, -1)
    motions = {
        "task 1": task1(S),
        "LIN": lin(LIN_S, LIN_E, S),
        "LIN-LIN": lin_lin(START, VIA, GOAL, S),
    }
    rows = {name: IRB140.ik(poses) for name, poses in motions.items()}
    assert jumps(rows["LIN"][:, front]) == [(5.61, 5)]
    # At t = 12.5 joints 3 and 5 are at half a turn, which may be +pi or -pi; in the errata joint 5
    # jumps one step earlier.
    assert jumps(rows["LIN-LIN"][:, front]) in (
        [(7.33, 5), (12.49, 5), (12.5, 3)],
        [(7.33, 5), (12.5, 3), (12.5, 5)],
    )
    assert turns(rows["LIN-LIN"][1250, front, [3, 5]], np.pi).max() < 1e-9
    # At t = 0 of task 1, rounding decides whether joint 3 (counted from zero) is +pi or -pi, so
    # there may or may not be a jump.
    assert jumps(rows["task 1"][:, front]) in ([], [(0.0, 3)])
    spike = abs(np.diff(rows["LIN"][:, front], axis=0)).max() / STEP
    assert 627 < spike < 629
    for name, row in rows.items():
        assert jumps(row[:, back]) == [] or name == "task 1"
        assert jumps(follow(IRB140, row, front)) == jumps(follow(IRB140, row, back)) == []


def test_s1_h_673_samples_of_task_1_exceed_a_limit():
    inside = within(IRB140, followed(task1(S), 1, 1, 1))
    outside = ~inside.all(-1)
    assert outside.sum() == 673 and round(T[outside].max(), 2) == 6.72 and outside[0]
    assert set(np.flatnonzero(~inside.all(0))) == {2, 4}
    q = followed(task1(S), 1, 1, 1)
    assert (~inside[:, 2] == (q[:, 2] > 50 * deg)).all() and (
        ~inside[:, 4] == (q[:, 4] > 115 * deg)
    ).all()


def test_s1_j_printed_blend_above_one_half_misses_both_ends():
    ends = printed_blend(START, VIA, GOAL, 0.55, np.array([0.0, 1.0])).translation / mm
    assert abs(ends[0] - [198.181818, 402.045455, 197.954545]).max() < 1e-6
    assert abs(ends[1] - [298.181818, 302.045455, 497.954545]).max() < 1e-6
    with pytest.raises(ValueError, match="0.55"):
        blend(START, VIA, GOAL, 0.55, S)
    ours = blend(START, VIA, GOAL, 0.5, np.array([0.0, 1.0])).translation / mm
    assert abs(ours - [[200, 400, 200], [300, 300, 500]]).max() < 1e-12


@pytest.mark.parametrize("b", [0.1, 0.25, 0.5])
def test_s1_l_printed_blend_up_to_one_half_matches_ours(b):
    corner = S[abs(S - 0.5) < b]
    ours, printed = blend(START, VIA, GOAL, b, corner), printed_blend(START, VIA, GOAL, b, corner)
    assert abs(ours.as_matrix() - printed.as_matrix()).max() < 1e-14


def test_s1_m_speed_jumps_at_the_unblended_corner():
    q = followed(lin_lin(START, VIA, GOAL, S), 1, 1, -1)
    v, a = forward(q)
    jump = v[1000] - v[999]
    wanted = numbers(
        ".107946862582 .457852830604 .920011415539 .030116525407 -.456073919364 -.216939050457"
    )

    # the errata state the limit for a vanishing step; seven of their digits are correct
    def jump_of(step):
        near = np.array([-2 * step, -step, 0, step, 2 * step])
        p = followed(lin_lin(START, VIA, GOAL, 0.5 + near / 20), 1, 1, -1)
        after = (-3 * p[2] + 4 * p[3] - p[4]) / (2 * step)
        before = (3 * p[2] - 4 * p[1] + p[0]) / (2 * step)
        return after - before

    assert abs(jump_of(2e-5) - wanted).max() < 1e-7
    assert abs(jump - wanted).max() < 0.01
    # The "acceleration" there is this jump divided by the step, so halving the step doubles it.
    assert np.allclose(abs(a).max(0), abs(jump) / STEP, rtol=1e-9)


def test_s1_n_ptp_turns_joint_6_the_long_way_without_nearest():
    row = IRB140.branch(1, 1, 1)
    start, goal = IRB140.ik(LIN_S)[row], IRB140.ik(LIN_E)[row]
    short = nearest(IRB140, goal[None], start)
    assert abs((goal - start)[5] - -3.897) < 5e-4 and abs((short - start)[5] - 2.386) < 5e-4
    assert abs((goal - start)[5] / 20 - -0.194863896366) < 1e-12
    assert abs((short - start)[5] / 20 - 0.119295368993) < 1e-12
    assert (
        turns(short, goal).max() < 1e-15
        and within(IRB140, goal).all()
        and within(IRB140, short).all()
    )
    for q in (goal, short):
        v, _ = forward(ptp(start, q, S))
        assert np.allclose(v, (q - start) / 20, rtol=0, atol=1e-12)


def test_s1_u_samples_of_the_document_end_one_step_early():
    assert len(T) == 2000 and round(T[-1], 10) == 19.99
    assert np.linalg.norm(lin(LIN_S, LIN_E, S)[-1].translation - LIN_E.translation) > 0.1 * mm
