"""The exercises of lab 12: slips in a short program are named, and the messages are readable."""

import re

import numpy as np
import pytest

from robokin import two_link
from robokin.course import book, check, solution, variant

WHO = next(
    name
    for name in map(str, range(99))
    for own in [variant("two_link_code_generation", name)]
    if abs(own["base_x"]) != abs(own["base_y"]) and own["l2"] + 0.2 < own["l1"] != 1 - own["l2"]
)
OWN = variant("two_link_code_generation", WHO)
BX, BY, L1, L2 = (OWN[name] for name in ("base_x", "base_y", "l1", "l2"))
K, L = (L1**2 - L2**2) / 2, L1**2


def numbered(x, y, k, square):
    """The lines of a right program that contain numbers: the base, K and l1²."""
    return {
        "dx": f"x3 - {x}",
        "dy": f"y3 - {y}",
        "d2": "dx*dx + dy*dy",
        "a": f"0.5 + {k} / d2",
        "h": f"sqrt({square} / d2 - a*a)",
        "px": f"{x} + a*dx",
        "py": f"{y} + a*dy",
    }


RIGHT = numbered(BX, BY, K, L) | {
    "u": "h*dy",
    "v": "h*dx",
    "xr": "px + u",
    "yr": "py - v",
    "xl": "px - u",
    "yl": "py + v",
}


def program(**lines):
    return "\n".join(f"{name} = {line}" for name, line in (RIGHT | lines).items())


def judged(**lines):
    return check("two_link_code_generation.2", program(**lines), who=WHO)


SLIPS = {
    "K not halved": {"a": f"0.5 + {2 * K} / d2"},
    "the sign of K": {"a": f"0.5 - {K} / d2"},
    "a sum of squares in K": {"a": f"0.5 + {(L1**2 + L2**2) / 2} / d2"},
    "no squares in K": {"a": f"0.5 + {(L1 - L2) / 2} / d2"},
    "0.5 left out of a": {"a": f"{K} / d2"},
    "1 instead of 0.5 in a": {"a": f"1 + {K} / d2"},
    "0.5 divided by d2, too": {"a": f"(0.5 + {K}) / d2"},
    "K not divided by d2": {"a": f"0.5 + {K}"},
    "K divided by d, not by d2": {"a": f"0.5 + {K} / sqrt(d2)"},
    "a not squared": {"h": f"sqrt({L} / d2 - a)"},
    "2 a instead of a²": {"h": f"sqrt({L} / d2 - 2*a)"},
    "plus instead of minus under the root": {"h": f"sqrt({L} / d2 + a*a)"},
    "the root left out": {"h": f"{L} / d2 - a*a"},
    "l1² not divided by d2": {"h": f"sqrt({L} - a*a)"},
    "a² divided by d2, too": {"h": f"sqrt(({L} - a*a) / d2)"},
    "l1 instead of l1²": {"h": f"sqrt({L1} / d2 - a*a)"},
    "l2² instead of l1²": {"h": f"sqrt({L2**2} / d2 - a*a)"},
    "h in metres": {"h": f"sqrt({L} - a*a*d2)"},
    "d instead of d2": {"d2": "sqrt(dx*dx + dy*dy)"},
    "minus instead of plus in d2": {"d2": "dx*dx - dy*dy"},
    "the square of the sum instead of d2": {"d2": "(dx + dy)**2"},
    "dx twice in d2": {"d2": "dx*dx + dx*dx"},
    "the direction from tip to base": {"dx": f"{BX} - x3", "dy": f"{BY} - y3"},
    "the base added to the tip": {"dx": f"x3 + {BX}", "dy": f"y3 + {BY}"},
    "the base left out of dx and dy": {"dx": "x3", "dy": "y3"},
    "the sign of the base": {
        "dx": f"x3 + {BX}",
        "dy": f"y3 + {BY}",
        "px": f"a*dx - {BX}",
        "py": f"a*dy - {BY}",
    },
    "the sign of base_x": {"dx": f"x3 + {BX}", "px": f"a*dx - {BX}"},
    "the sign of base_y": {"dy": f"y3 + {BY}", "py": f"a*dy - {BY}"},
    "base_x and base_y swapped": {"dx": f"x3 - {BY}", "dy": f"y3 - {BX}"},
    "1/2 instead of a in the foot": {"px": f"{BX} + 0.5*dx", "py": f"{BY} + 0.5*dy"},
    "no a in the foot": {"px": f"{BX} + dx", "py": f"{BY} + dy"},
    "the foot measured from the tip": {"px": "x3 + a*dx", "py": "y3 + a*dy"},
    "along instead of across": {"u": "h*dx", "v": "h*dy"},
    "a wrong sign in the direction across": {"yr": "py + v", "yl": "py - v"},
    "the sign in xl": {"xl": "px + u"},
    "the sign in yl": {"yl": "py - v"},
}


def test_slips_in_a_short_program_are_named():
    named = 0
    for name, lines in SLIPS.items():
        verdict = judged(**lines)
        assert not verdict.holds and name in verdict.mistake.split(" or "), verdict
        assert len(verdict.says) <= 2
        named += verdict.mistake == name
    assert named >= len(SLIPS) - 1  # for some arms, two slips give the same elbows


@pytest.mark.parametrize("who", ["your name", "Ada", "Kim", "Lee", "7", "8"])
@pytest.mark.parametrize("name", ["K not halved", "a not squared", "l1 instead of l1²"])
def test_slips_are_named_even_if_they_give_nan_for_every_tip(name, who):
    own = variant("two_link_code_generation", who)
    x, y, l1, l2 = (own[each] for each in ("base_x", "base_y", "l1", "l2"))
    k, square = (l1**2 - l2**2) / 2, l1**2
    lines = numbered(x, y, 2 * k if name == "K not halved" else k, l1 if "²" in name else square)
    if name == "a not squared":
        lines["h"] = f"sqrt({square} / d2 - a)"
    verdict = check("two_link_code_generation.2", program(**lines), who=who)
    assert name in verdict.mistake.split(" or "), verdict


def test_constants_with_two_digits_are_called_nearly_right():
    for who in map(str, range(20)):
        own = variant("two_link_code_generation", who)
        x, y, l1, l2 = (own[each] for each in ("base_x", "base_y", "l1", "l2"))
        k, square = round((l1**2 - l2**2) / 2, 2), round(l1**2, 2)
        if abs(k - (l1**2 - l2**2) / 2) + abs(square - l1**2) < 1e-9:
            continue
        own_program = program(**numbered(x, y, k, square))
        verdict = check("two_link_code_generation.2", own_program, who=who)
        assert verdict.mistake == "nearly right" and "enough digits?" in verdict.says[0]


def test_known_mistakes_and_nearly_correct_programs_are_named():
    assert judged().holds
    assert judged(xr="px - u", yr="py + v", xl="px + u", yl="py - v").mistake == (
        "the sides swapped"
    )
    assert judged(px="a*dx", py="a*dy").mistake == "the base not added at the end"
    near = judged(a=f"0.5 + {K + 1e-4} / d2")
    assert near.mistake == "nearly right" and "the task asks for a micrometre" in near.says[0]
    at = r"elbow is at \((.*?)\); your program returns \((.*?)\)"
    right, yours = re.search(at, near.says[0]).groups()
    assert right != yours
    assert judged(a=f"5 + {K} / d2").mistake == "NaN"
    other = judged(h=f"sqrt({L} / d2 - a*a) + dx*0.1")
    assert other.mistake == "another right elbow"


@pytest.mark.parametrize(
    ("reach", "name"),
    [
        (lambda d, a, b: abs(a - b) - 1e-6 <= d <= a + b + 1e-6, "a margin outside the rim"),
        (lambda d, a, b: abs(a - b) - 1e-5 <= d <= a + b + 1e-5, "a margin outside the rim"),
        (
            lambda d, a, b: a - b - 1e-9 * (a + b) <= d <= (1 + 1e-9) * (a + b),
            "the inner edge for a longer first link only",
        ),
        (
            lambda d, a, b: b - a - 1e-9 * (a + b) <= d <= (1 + 1e-9) * (a + b),
            "the inner edge for a longer second link only",
        ),
        (
            lambda d, a, b: abs(a - b) - 1e-9 <= d <= a + b + 1e-9,
            "a margin of the same length for every arm",
        ),
    ],
)
def test_slightly_wrong_limit_of_reach_is_detected(reach, name):
    def elbow(base, tip, l1, l2, side):
        dx, dy = np.subtract(tip, base)
        d2 = dx * dx + dy * dy
        if side and not reach(np.sqrt(d2), l1, l2):
            return [np.nan, np.nan]
        a = (d2 + l1**2 - l2**2) / (2 * d2)
        h = side * np.sqrt(max(l1**2 / d2 - a**2, 0))
        return base + a * np.array([dx, dy]) + h * np.array([dy, -dx])

    assert check("two_link_code_generation.1", elbow).mistake == name


def by_circles(none, height=lambda h2: max(h2, 0)):
    """The correct program, but it returns NaN where none(d, h2, l1, l2) holds."""

    def elbow(base, tip, l1, l2, side):
        dx, dy = np.subtract(tip, base)
        d2 = dx * dx + dy * dy
        a = (d2 + l1**2 - l2**2) / (2 * d2)
        h2 = l1**2 / d2 - a**2
        if side and none(np.sqrt(d2), h2, l1, l2):
            return [np.nan, np.nan]
        h = side * np.sqrt(height(h2)) if side else 0
        return base + a * np.array([dx, dy]) + h * np.array([dy, -dx])

    return elbow


@pytest.mark.parametrize("margin", [1e-9, 1e-10])
def test_a_margin_on_the_square_of_h_is_too_small_on_the_inner_rim(margin):
    """There, h² changes much faster than the distance; no sign is wrong."""
    verdict = check("two_link_code_generation.1", by_circles(lambda d, h2, *_: h2 < -margin))
    assert verdict.mistake == "no answer for the folded arm"
    tip, rim = re.search(r"the tip is (\S+) m away .* rim is at (\S+) m:", verdict.case).groups()
    assert float(tip) < float(rim) == 0.3
    (ratio,) = re.search(r"h² changes (\d+) times as fast", verdict.says[0]).groups()
    d = 0.3 + np.array([0, 1e-7])
    h2 = 1 / d**2 - ((d**2 + 1 - 0.7**2) / (2 * d**2)) ** 2
    assert np.diff(h2)[0] / 1e-7 == pytest.approx(float(ratio), rel=0.05)
    assert (
        check(
            "two_link_code_generation.1",
            by_circles(lambda d, _, l1, l2: not abs(l1 - l2) <= d <= l1 + l2 + 1e-9 * (l1 + l2)),
        ).mistake
        == "no answer for the folded arm"
    )


@pytest.mark.parametrize("margin", [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2])
def test_a_reply_to_a_wide_margin_states_no_other_distance_than_its_case(margin):
    """The margin is on h², so that it is another distance on every rim."""
    verdict = check("two_link_code_generation.1", by_circles(lambda d, h2, *_: h2 < -margin))
    wide = "a margin of millimetres outside the rim"
    assert verdict.mistake == (wide if margin >= 1e-3 else "a margin outside the rim")
    out = float(re.search(r"the tip is (\S+) m from the base", verdict.case)[1]) - 1.7
    told = re.search(r"tips that are (\d) mm out of reach", verdict.says[0])
    assert bool(told) == (margin >= 1e-3) and "micro" not in verdict.says[0]
    assert out == pytest.approx(float(told[1]) * 1e-3 if told else out)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("checks", ["", "reach", "rim", "reach, rim", "strict, rim"])
def test_link_1_along_the_line_for_side_0_is_recognised(sign, checks):
    """The natural program with angles; only side 0 needs something else."""

    def elbow(base, tip, l1, l2, side):
        dx, dy = np.subtract(tip, base)
        d = np.hypot(dx, dy)
        room = 1e-9 * (l1 + l2) if "rim" in checks else 0
        reached = abs(l1 - l2) - room <= d <= l1 + l2 + room
        if not reached and ("strict" in checks or checks and side):
            return [np.nan, np.nan]
        cos = (d * d + l1**2 - l2**2) / (2 * d * l1)
        if "rim" in checks or "reach" in checks and side == 0:
            cos = np.clip(cos, -1, 1)
        with np.errstate(invalid="ignore"):
            q1 = np.arctan2(dy, dx) - sign * side * np.arccos(cos)
        return base + l1 * np.array([np.cos(q1), np.sin(q1)])

    verdict = check("two_link_code_generation.1", elbow)
    names = ["the sides swapped", "l1 along the line for side 0"][sign > 0 :]
    ends = {"": "no answer for the stretched arm", "reach": "no answer for the stretched arm"}
    ends["strict, rim"] = "no point if the tip is out of reach"
    names += [ends[checks]] if checks in ends else []
    assert verdict.mistake == ", and ".join(names)
    assert ("yours is on the other side" if sign < 0 else "side = 0") in verdict.case


def test_of_several_mistakes_the_one_that_the_case_shows_is_named_first():
    def elbow(base, tip, l1, l2, side):
        dx, dy = np.subtract(tip, base)
        d2 = dx * dx + dy * dy
        if np.sqrt(d2) > l1 + l2:
            return [np.nan, np.nan]
        a = (d2 + l1**2 - l2**2) / (2 * d2)
        with np.errstate(invalid="ignore"):
            h = side * np.sqrt(l1**2 - a * a * d2)
        return base + a * np.array([dx, dy]) + h * np.array([dy, -dx])

    verdict = check("two_link_code_generation.1", elbow)
    assert "side = 1" in verdict.case and verdict.mistake.startswith("h as a length, and ")
    assert "do not return early" in verdict.says[0]


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("checks", ["", "side 0", "reach", "reach, rim", "side 0, reach, rim"])
def test_formula_of_section_3_with_the_side_as_the_sign_of_the_root_is_recognised(sign, checks):
    """Where it divides by 0, rounding decides between NaN and infinity."""

    def elbow(base, tip, l1, l2, side):
        dx, dy = np.subtract(tip, base)
        d2 = dx * dx + dy * dy
        c = (d2 + l1**2 - l2**2) / 2
        room = 1e-9 * (l1 + l2)
        reached = abs(l1 - l2) - room <= np.sqrt(d2) <= l1 + l2 + room
        if "reach" in checks and not reached and (side or "side 0" not in checks):
            return [np.nan, np.nan]
        under = dx**2 * (l1**2 * d2 - c**2)
        under = max(under, 0) if "rim" in checks else under
        with np.errstate(all="ignore"):
            root = 0 if side == 0 and "side 0" in checks else side * np.sqrt(under)
            y = (dy * c + sign * root) / d2
            return [base[0] + (c - dy * y) / dx, base[1] + y]

    mistake = check("two_link_code_generation.1", elbow).mistake
    other = "" if sign > 0 else "other "
    assert mistake == f"divides by dx, and takes the side from the {other}sign of the root"


def test_elbows_of_the_package_do_not_give_the_point_between_them_out_of_reach():
    def by_package(base, tip, l1, l2, side):
        way = np.subtract(tip, base)
        d = np.hypot(*way)
        near = np.clip(d, abs(l1 - l2), l1 + l2)  # onto the rim if rounding is the cause
        onto = base + way * near / d if abs(near - d) < 1.5e-9 * (l1 + l2) else tip
        arm = two_link(l1, l2, base)
        elbows = arm.frames(arm.ik(onto))[..., 1].translation[..., :2]
        return [elbows[0], elbows.mean(axis=0), elbows[1]][1 - side]

    verdict = check("two_link_code_generation.1", by_package)
    assert verdict.mistake == "no point between the elbows where the tip is out of reach"
    assert "side = 0" in verdict.case and verdict.points > 0.8  # everything else is right


def test_a_root_that_is_nan_for_side_0_is_distinguished_from_rounding_on_the_rim():
    """Both programs lack a test of the reach; only the first one takes the root for side 0."""

    def answer(height):
        def elbow(base, tip, l1, l2, side):
            dx, dy = np.subtract(tip, base)
            d2 = dx * dx + dy * dy
            a = (d2 + l1**2 - l2**2) / (2 * d2)
            with np.errstate(invalid="ignore"):
                h = height(side, l1**2 / d2 - a**2)
            return base + a * np.array([dx, dy]) + h * np.array([dy, -dx])

        return check("two_link_code_generation.1", elbow)

    both = answer(lambda side, h2: side * np.sqrt(h2))
    assert both.mistake == (
        "no point between the elbows if the tip is out of reach, "
        "and no answer for the stretched arm"
    )
    assert "side = 0" in both.case and "0 times NaN is NaN" in both.says[0]
    assert (
        answer(lambda side, h2: side and side * np.sqrt(h2)).mistake
        == "no answer for the stretched arm"
    )


def test_a_program_is_shown_by_its_length_and_one_line_as_it_is():
    text = program(a=f"0.5 + {2 * K} / d2")
    case = check("two_link_code_generation.2", f"\n{text}\n\n", who=WHO).case
    assert case == f"  your answer is a program of {len(RIGHT)} lines"
    assert check("two_link_code_generation.2", "xr = x3", who=WHO).case.endswith("'xr = x3'")


def test_elbow_for_an_unreachable_tip_is_reported_with_different_numbers():
    space = {}
    exec(solution("two_link_code_generation.1"), space)

    def always(base, tip, l1, l2, side):
        found = space["elbow_of"](base, tip, l1, l2, side)
        return np.where(np.isnan(found), base, found)

    verdict = check("two_link_code_generation.1", always)
    tip, rim = re.search(r"the tip is (.*) m from the base, .* to (.*) m", verdict.case).groups()
    assert tip != rim and not verdict.holds


def test_test_of_elbows_must_check_all_four_numbers():
    space = {}
    exec(solution("two_link_code_generation.3"), space)
    whole = space["elbows_are_right"]

    exercise = book.lab("two_link_code_generation").exercises["3"]
    right = exercise.program(exercise.rights[0][1])

    def first_and_last(elbows):
        def mended(*case):
            found = [*right(*case)]
            found[0], found[3] = (elbows(*case)[k] for k in (0, 3))
            return found

        return whole(mended)

    assert check("two_link_code_generation.3", whole).holds
    verdict = check("two_link_code_generation.3", first_and_last)
    assert verdict.mistake == "accepts: in the order xr, xl, yr, yl"
