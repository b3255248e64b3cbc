"""The elbow explorer in a real browser: the triangles in the page match independent formulas, and
the numbers and sentences match the picture.
"""

import re

import numpy as np
import pytest
import test_explorers
from axe_playwright_python.sync_playwright import Axe
from canvas_words import RECORD, faults
from machines import SIX, UR5, transform, turns

from robokin import (
    IRB140,
    SCARA,
    deg,
    loader_arm,
    mm,
    representative,
    spbu_arm,
    three_lever,
    within,
)
from robokin.show import elbow_explorer
from robokin.show.joiner import script

context, opened = test_explorers.context, test_explorers.opened  # fixtures
L0, L1, L2, L3 = 352, 70, 350, 380  # mm; source 001, listing 7
MINUS = "\N{MINUS SIGN}"


def triangle(r, z):
    """The triangle of the IRB-140 in mm and degrees, by the law of cosines: u, w, d, and for each
    elbow gamma, alpha, q2 and q3. Source: 001; lab 02.
    """
    u, w = r - L1, z - L0
    d = np.hypot(u, w)
    bend = np.arccos((d**2 - L2**2 - L3**2) / (2 * L2 * L3))
    rows = []
    for gamma in (-bend, bend):
        # the law of sines gives the sine of the angle at joint 2, the law of cosines its cosine
        at_joint_2 = np.arctan2(L3 * np.sin(gamma) / d, (L2**2 + d**2 - L3**2) / (2 * L2 * d))
        alpha = np.arctan2(w, u) - at_joint_2
        rows.append(np.array([gamma, alpha, alpha - np.pi / 2, -np.pi / 2 - gamma]) / deg)
    return np.array([u, w, d]), np.array(rows)


# --- The page's own triangles ---------------------------------------------------------------------


@pytest.mark.parametrize("machine", SIX, ids=repr)
def test_page_triangles_match_independent_formulas(context, machine):
    """Compare 1000 places in front of axis 1 and behind it, within reach and out of reach."""
    arm, known = machine.arm, machine.wrist
    shoulder, upper, fore = np.array(known["shoulder"]), known["upper"], known["fore"]
    rng = np.random.default_rng(2)
    places = shoulder + (upper + fore) * rng.uniform(-1.06, 1.06, (1000, 2))
    page = context.new_page()
    page.add_script_tag(content=f"{script('elbow_explorer')}\nwindow.at = $elbow_explorer;")
    found = page.evaluate(
        "([arm, places]) => places.map(([r, z]) => at.trianglesAt(arm, r, z))",
        [elbow_explorer(arm).data["arm"], places.tolist()],
    )
    page.close()
    away = np.hypot(*(places - shoulder).T)
    missing = np.maximum(away - (upper + fore), abs(upper - fore) - away)
    counts = {key: 0 for key in ("reached", "missing", "behind", "past", "inside")}
    for (r, z), d, gap, one in zip(places, away, missing, found, strict=True):
        assert [one["u"], one["w"], one["d"]] == pytest.approx([*([r, z] - shoulder), d], abs=1e-12)
        if gap > 0:
            assert one["elbows"] == [] and one["gap"]["metres"] == pytest.approx(gap, abs=1e-12)
            assert one["gap"]["kind"] == ("stretched" if d > upper + fore else "folded")
            counts["missing"] += 1
            continue
        counts["reached"] += 1
        counts["behind"] += r < 0
        gammas = [each["gamma"] for each in one["elbows"]]
        cosine = (d**2 - upper**2 - fore**2) / (2 * upper * fore)
        assert np.cos(gammas) == pytest.approx(cosine, abs=1e-9)
        assert gammas[0] == pytest.approx(-gammas[1], abs=1e-9)
        for flag, each in zip((1, -1), one["elbows"], strict=True):
            q = np.array([*each["q"], 0, 0, 0])
            pose = transform(machine.chain(q))
            centre = pose @ (0, 0, -known["tool"])
            assert [centre[0], centre[2]] == pytest.approx([r, z], abs=1e-9)
            assert abs(centre[1]) == pytest.approx(known["lateral"], abs=1e-9)
            elevations = each["alpha"], each["alpha"] + each["gamma"]
            end = shoulder + np.array([upper, fore]) @ [[np.cos(x), np.sin(x)] for x in elevations]
            assert end == pytest.approx([r, z], abs=1e-9)
            row = arm.ik(pose)[arm.branch(1 if r >= 0 else -1, flag, 1)]
            assert turns(row[:3], q[:3]).max() < 1e-7
            assert q[1:3] == pytest.approx(representative(arm, q)[1:3], abs=1e-12)
            past = 1 + np.flatnonzero(~within(arm, q)[1:3])
            assert each["past"] == past.tolist()
            counts["past" if len(past) else "inside"] += 1
    if np.ptp(arm.limits[1:3], axis=-1).min() > 2 * np.pi:  # no angle exceeds a limit
        assert counts.pop("past") == 0
    assert min(counts.values()) > 100, counts


# --- What a reader sees ---------------------------------------------------------------------------


def moved(shown, r, z):
    shown.type("r", r)
    shown.type("z", z)
    return shown.look()


def cells(seen):
    """Return the numbers in the table below the sliders: u, w, d, and a row for each elbow."""
    lengths, *rows = seen.rows
    assert [row[0] for row in rows] == ["elbow +1", "elbow -1"]
    return (
        np.array([float(cell.split(" ")[1]) for cell in lengths[1:]]),
        np.array([[float(cell) for cell in row[1:]] for row in rows]),
    )


def test_dragging_the_ring_moves_the_triangle(opened):
    shown = opened(elbow_explorer(IRB140))
    start, stops = shown.look(), []

    def each(seen, stop):
        lengths, rows = cells(seen)
        r, z = (float(x) for x in re.findall(r"[rz] (-?[\d.]+)", seen.handles["point"]["name"]))
        wanted, angles = triangle(r, z)
        assert lengths == pytest.approx(wanted, abs=0.15)
        assert rows == pytest.approx(angles, abs=0.15)
        assert np.hypot(*np.subtract(seen.handles["point"]["at"], stop)) < 1.5
        stops.append((r, z, seen.pixels[0]))

    x, y = start.handles["point"]["at"]
    seen = shown.drag("point", (x + 40, y + 10), (x + 60, y + 90), (x - 60, y + 40), each=each)
    assert len(set(stops)) == 3 and seen.pixels != start.pixels
    # to scale: equal lengths have the same number of pixels horizontally and vertically
    (r, z, _), (r2, z2, _) = stops[:2]
    assert (r2 - r) / 20 == pytest.approx((z - z2) / 80, rel=0.02)
    shown.press("point", "Home")
    assert shown.look().rows == start.rows and shown.look().pixels == start.pixels


def test_keys_move_the_ring_and_choose_the_elbow(opened):
    shown = opened(elbow_explorer(IRB140))
    start = shown.look()
    assert start.boxes == {"r": 330, "z": 800} and start.chosen == 1
    shown.press("point", "ArrowRight", "Shift+ArrowDown", "ArrowUp")
    seen = shown.look()
    assert seen.boxes == {"r": 331, "z": 791}
    assert cells(seen)[1] == pytest.approx(triangle(331, 791)[1], abs=0.051)
    shown.rk.get_by_role("button", name="elbow \N{MINUS SIGN}1").press("Enter")
    other = shown.look()
    assert other.chosen == 2 and other.rows == seen.rows and other.pixels != seen.pixels
    assert other.says.startswith(f"Elbow {MINUS}1:") and seen.says.startswith("Elbow +1:")
    for state, flag in ((seen, 1), (other, -1)):
        code = shown.code(state)
        assert [code["r"], code["z"]] == pytest.approx([331 * mm, 791 * mm])
        assert code["elbow"] == flag
    shown.slide("r", -2000)
    shown.type("z", 5000)
    assert shown.look().boxes == {"r": -750, "z": 1150}, "the point leaves the picture"


def test_special_positions_are_explained(opened):
    shown = opened(elbow_explorer(IRB140))
    one = "both elbows coincide (elbow singularity)."
    stretched = moved(shown, L1 + L2 + L3, L0)
    assert stretched.says.startswith(f"The arm is stretched: {one}")
    assert cells(stretched)[1] == pytest.approx(np.array([[0, 0, -90, -90]] * 2), abs=1e-9)
    folded = moved(shown, L1, L0 - (L3 - L2))
    assert folded.says.startswith(f"The arm is folded: {one} Elbow +1: joint 3 is at")
    assert "40.0° past its limit of" in folded.says and folded.past[1] == [False] * 4 + [True]
    for r, z in ((840, 600), (L1, L0), (75, 360), (-740, 300)):
        seen = moved(shown, r, z)
        d = np.hypot(r - L1, z - L0)
        far = f"{d - L2 - L3:.1f} mm longer than l2 + l3"
        near = f"{L3 - L2 - d:.1f} mm shorter than the difference of l2 and l3"
        assert f"Out of reach: d is {far if d > L3 else near}." in seen.says
        assert [row[1:] for row in seen.rows[1:]] == [["\N{EN DASH}"] * 4] * 2
        assert seen.faint[1:] == [True, True] and "α" not in seen.words[0]
    assert seen.says.endswith(f"Behind axis 1: the front flag is {MINUS}1.")
    assert "front flag" not in moved(shown, 200, 700).says
    assert moved(shown, 0, 700).says.startswith(
        "On axis 1: q1 can have any value (shoulder singularity)."
    )


def test_joints_that_exceed_a_limit_are_named_with_the_excess(opened):
    shown, limits = opened(elbow_explorer(IRB140)), IRB140.limits / deg
    told = set()
    for r, z in ((600, 352), (150, 420), (-200, 500), (500, 120), (330, 800)):
        seen = moved(shown, r, z)
        for k, (flag, row) in enumerate(zip(("+1", f"{MINUS}1"), triangle(r, z)[1], strict=True)):
            q = representative(IRB140, np.array([0, *row[2:], 0, 0, 0]) * deg)[1:3] / deg
            (said,) = re.findall(rf"Elbow {re.escape(flag)}: (.*?)\.(?= |$)", seen.says)
            past = [j for j in (1, 2) if not limits[j, 0] <= q[j - 1] <= limits[j, 1]]
            assert [j for j in (1, 2) if seen.past[k + 1][j + 2]] == past
            wanted = " and ".join(
                f"joint {j + 1} is at {q[j - 1]:.1f}°, {abs(q[j - 1] - limit):.1f}° past its limit "
                f"of {limit:.0f}°".replace("-", MINUS)
                for j in past
                for limit in [limits[j, int(q[j - 1] > 0)]]
            )
            assert said == (wanted or "joints 2 and 3 are inside their limits")
            told.add(tuple(past))
    assert {(), (1,), (2,)} <= told


def test_accessible_name_describes_the_picture(opened):
    view = elbow_explorer(IRB140)
    shown = opened(view)
    name = lambda: shown.rk.locator("canvas").get_attribute("aria-label")  # noqa: E731
    assert f"{view.data['summary']} {shown.look().says}" == name()
    lengths, rows = triangle(330, 800)
    numbers = [float(x.replace(MINUS, "-")) for x in re.findall(rf"{MINUS}?\d+\.\d", repr(view))]
    angles = [rows[k][i] for k in (0, 1) for i in range(4)]
    assert numbers == pytest.approx([330, 800, lengths[2], *angles], abs=0.051)
    seen = moved(shown, 500, 600)
    assert "r 500.0, z 600.0 mm" in name() and name().endswith(seen.says)
    assert view.still.alt == view.data["alt"] == repr(view)


PLACES = ((330, 800), (500, 600), (800, 352), (840, 600), (75, 360), (70, 352), (70, 382), (0, 900))
PLACES += ((-300, 700), (-700, 20), (600, 352), (70, 1000), (850, 1150))


@pytest.mark.parametrize("width, theme", [(914, "light"), (390, "dark")])
def test_labels_are_readable_wherever_the_point_is(browser, opened, width, theme):
    with browser.new_context(
        viewport={"width": width, "height": 800}, color_scheme=theme, has_touch=width < 400
    ) as small:
        small.add_init_script(test_explorers.WATCH + RECORD)
        asked = []
        small.on("request", lambda request: asked.append(request.url))
        shown = opened(elbow_explorer(IRB140), within=small)
        for place in PLACES:
            seen = moved(shown, *place)
            assert faults(shown.page) == [], place
            assert "wrist centre" in seen.words[0].split("|")
        assert all(url.startswith("file:") for url in asked) and asked
        assert shown.page.evaluate("document.documentElement.scrollWidth") <= width
        found = Axe().run(shown.page, context=".rk").response["violations"]
        assert [v["id"] for v in found if v["impact"] in ("serious", "critical")] == []
        shown.page.close()


# --- Arms -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "arm",
    [spbu_arm(1, 0.05), spbu_arm(0.3, 0.3), spbu_arm(4 * mm, 3 * mm), loader_arm(3.1, 2.2)],
    ids=["unequal", "equal", "tiny", "large"],
)
def test_explorer_opens_with_a_point_within_reach(arm):
    view = elbow_explorer(arm)
    r, z = view.data["point"]
    low, high = (
        np.array([control[end] * view.data["unit"]["size"] for control in view.data["controls"]])
        for end in ("low", "high")
    )
    assert (low < [r, z]).all() and ([r, z] < high).all()
    angles = [float(x.replace(MINUS, "-")) for x in re.findall(rf"γ ({MINUS}?[\d.]+)°", repr(view))]
    assert abs(np.array(angles)) == pytest.approx([90, 90], abs=15) and sum(angles) == 0


@pytest.mark.parametrize("arm", [SCARA, three_lever(0.3), UR5, "IRB-140"])
def test_arm_without_an_elbow_is_refused(arm):
    with pytest.raises(TypeError, match="arm: wanted"):
        elbow_explorer(arm)
