"""Explorers in a real browser: what they show is what Python says of what they show, whatever hand
moves them: mouse, finger or keys; and what a notebook stores of them.

What an explorer shows is read as a person would: boxes, tables, words, handles, the pixels and the
words on its canvases. Where more digits are needed than are shown, "Copy as Python" is run.
"""

import random
import re
import subprocess
import sys
from types import SimpleNamespace

import nbformat
import numpy as np
import pytest
import test_browser
from axe_playwright_python.sync_playwright import Axe
from conftest import ROOT, until
from scipy.spatial.transform import Rotation

import robokin
from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    differentiate,
    distance_from_singularity,
    explain,
    follow,
    linear,
    loader_arm,
    mm,
    nearest,
    quintic,
    record,
    spbu_arm,
    three_lever,
    trapezoidal,
    two_link,
    within,
)
from robokin.show import animate, joint_explorer, motion_explorer, target_explorer
from robokin.show.page import STILL
from robokin.show.palette import PAGE

ELBOW = spbu_arm(500 * mm, 400 * mm)
LOADER = loader_arm(1.2, 1.0)
FLAT = two_link(0.5, 0.4)
LEVERS = three_lever(0.3)
JOINTS = (IRB140, PUMA560, SCARA, LOADER, ELBOW, FLAT, LEVERS)
TARGETS = (IRB140, PUMA560, ITMO6R, SCARA, LOADER, ELBOW, FLAT)
START = Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.2))
VIA = Transform(Quaternion.from_angle_axis(45 * deg, (0, 1, 0)), (0.65, -0.1, 0.8))
GOAL = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.3, 0.3, 0.5))
POSES = {
    IRB140: (START, VIA, GOAL),
    SCARA: (
        ScaraPose((0.3, 0.1, 0.1), 0),
        ScaraPose((0.25, -0.2, 0.15), 1),
        ScaraPose((0.1, -0.3, 0.05), 2),
    ),
    ELBOW: tuple(
        Transform(translation=p) for p in ((0.5, 0.2, 0.3), (0.4, -0.1, 0.6), (0.3, -0.4, 0.2))
    ),
}
SAMPLES = 241  # of a motion in the page
KINDS = {
    "joint": lambda: joint_explorer(IRB140),
    "target": lambda: target_explorer(IRB140),
    "motion": lambda: motion_explorer(IRB140, START, VIA, GOAL),
}


def named(arms):
    return pytest.mark.parametrize("arm", arms, ids=lambda arm: arm.name)


# --- A page and how it is read --------------------------------------------------------------------

# What is written on a canvas since it was last wiped, and what is put on the clipboard.
WATCH = """
const [wipe, write] = [CanvasRenderingContext2D.prototype.clearRect, CanvasRenderingContext2D.prototype.fillText];
Object.assign(CanvasRenderingContext2D.prototype, {
  clearRect(...all) { this.canvas.words = []; return wipe.apply(this, all); },
  fillText(...all) { (this.canvas.words ||= []).push(all[0]); return write.apply(this, all); },
});
Object.defineProperty(navigator, "clipboard", {value: {writeText: async text => { window.copied = text; }}});
"""
READ = """async rk => {
  await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
  const all = what => [...rk.querySelectorAll(what)];
  const plain = text => text.replaceAll("\\u2212", "-");
  const named = (what, value) => Object.fromEntries(all(what).map(e => [e.ariaLabel.split(",")[0], value(e)]));
  const hash = text => { let h = 7; for (let i = 0; i < text.length; i++) h = (31 * h + text.charCodeAt(i)) | 0; return h; };
  const urls = all("canvas").map(canvas => canvas.toDataURL());
  const rows = all("tbody tr");
  all("button").find(button => /^Cop/.test(button.textContent)).click();
  return {
    code: window.copied, boxes: named("input[type=number]", e => +e.value), told: named("input[type=range]", e => plain(e.getAttribute("aria-valuetext"))),
    menus: named("select", e => e.selectedIndex), says: rk.querySelector(".rk-says").textContent,
    rows: rows.map(row => [...row.cells].map(cell => plain(cell.textContent))),
    past: rows.map(row => [...row.cells].map(cell => cell.classList.contains("rk-past"))),
    faint: rows.map(row => row.classList.contains("rk-none")),
    chosen: rows.findIndex(row => row.getAttribute("aria-current") === "true"),
    pressed: all(".rk-choose").findIndex(e => e.getAttribute("aria-pressed") === "true"),
    pixels: urls.map(hash), bytes: urls.map(url => url.length), words: all("canvas").map(canvas => (canvas.words || []).join("|")),
    handles: Object.fromEntries(all(".rk-handle").filter(e => !e.hidden).map(e => {
      const r = e.getBoundingClientRect();
      return [e.dataset.handle, {at: [r.x + r.width / 2, r.y + r.height / 2], name: plain(e.ariaLabel),
                                 outside: e.classList.contains("rk-outside")}];
    })),
  };
}"""


class Open:
    """An explorer in a page, and the hand that moves it."""

    def __init__(self, page, explorer, arm=None):
        self.page, self.arm, self.data = page, arm, explorer.data
        self.rk = page.locator(".rk")

    def look(self):
        """What is shown when the next picture has been drawn."""
        seen = SimpleNamespace(**self.rk.evaluate(READ))
        assert min(seen.bytes) > 3000, "a canvas is blank"
        assert "NaN" not in str(vars(seen)) and "undefined" not in str(vars(seen))
        return seen

    def code(self, seen=None):
        """What the lines of "Copy as Python" leave when they have run."""
        space = {"arm": self.arm}
        exec((seen or self.look()).code, space)
        return space

    def type(self, name, value):
        box = self.rk.locator(f"input[type=number][aria-label^='{name},']")
        box.fill(str(value))
        box.press("Enter")

    def slide(self, name, value):
        slider = f"input[type=range]:is([aria-label='{name}'], [aria-label^='{name},'])"
        self.rk.locator(slider).fill(str(value))

    def choose(self, name, index):
        self.rk.get_by_role("combobox", name=name).select_option(index=index)

    def handle(self, name):
        return self.rk.locator(f"[data-handle='{name}']")

    def press(self, name, *keys):
        for key in keys:
            self.handle(name).press(key)

    def take(self, name):
        """Put the mouse on a handle and hold it; the place."""
        self.handle(name).focus()  # in front of its neighbours
        x, y = self.look().handles[name]["at"]
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        return np.array([x, y])

    def drag(self, name, *stops, each=None):
        """Take a handle to places on the screen, looking at each; the last look."""
        self.take(name)
        for stop in stops:
            self.page.mouse.move(*stop, steps=3)
            seen = self.look()
            if each:
                each(seen, stop)
        self.page.mouse.up()
        return self.look()

    def curve(self, name, keys, count=3):
        """Where a handle is after each press of a key, and what it then says; and back again."""
        places = []
        for _ in range(count):
            self.press(name, keys)
            places.append(np.array(self.look().handles[name]["at"]))
        return places


@pytest.fixture(scope="module")
def context(browser):
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.add_init_script(WATCH)
    yield context
    context.close()


@pytest.fixture
def opened(context, tmp_path):
    """`opened(explorer, arm)`: it as a saved page in a tab; nothing may complain there."""
    pages = []

    def made(explorer, arm=None, within=context):
        page = watched(within.new_page())
        pages.append(page)
        path = tmp_path / f"{len(pages)}.html"
        explorer.save(path)
        page.goto(path.as_uri())
        return Open(page, explorer, arm)

    yield made
    for page in pages:
        errors = page.errors
        page.close()
        assert errors == []


def watched(page):
    page.errors = []
    page.on("console", lambda m: m.type == "error" and page.errors.append(m.text))
    page.on("pageerror", lambda error: page.errors.append(str(error)))
    return page


# --- Joints ---------------------------------------------------------------------------------------


def tells_the_flange(shown, exact=True):
    """Table, boxes and words agree with `fk` of the posture; the posture."""
    arm, seen = shown.arm, shown.look()
    q = np.array(shown.code(seen)["q"])
    units = [unit["size"] for unit in shown.data["units"]]
    boxes = np.array([seen.boxes[f"q{i + 1}"] for i in range(len(q))]) * units
    assert np.allclose(boxes / units, q / units, atol=0.0501)
    told = [float(seen.told[f"q{i + 1}"].split(" ")[0]) for i in range(len(q))]
    assert np.allclose(told, q / units, atol=0.0501)
    assert ((q >= arm.limits[:, 0] - 1e-5) & (q <= arm.limits[:, 1] + 1e-5)).all()
    pose, size = arm.fk(q), shown.data["unit"]["size"]
    values = [[float(re.search(r"-?[\d.]+$", x)[0]) for x in row[1:] if x] for row in seen.rows]
    place, turns, wxyz, near = values
    slack = 1 if exact else 3  # the code has three decimals
    assert np.allclose(np.array(place) * size, pose.translation, atol=0.0505 * slack * size)
    for rotation in (
        Rotation.from_euler("xyz", turns, degrees=True),
        Rotation.from_quat(wxyz, scalar_first=True),
    ):
        off = (rotation.inv() * Rotation.from_matrix(pose.rotation.as_matrix())).magnitude()
        assert off < 0.12 * slack * deg
    assert near == [pytest.approx(distance_from_singularity(arm, q), abs=0.0005 * slack + 1e-9)]
    return q, seen


@named(JOINTS)
def test_joint_explorer_tells_the_flange(opened, arm):
    shown = opened(joint_explorer(arm), arm)
    rng, n = random.Random(3), len(arm.links)
    poses, seen = map(list, zip(tells_the_flange(shown), strict=True))
    ends = arm.limits / [[unit["size"]] for unit in shown.data["units"]]
    for k in range(12):
        j = k % n
        value = round(rng.uniform(*ends[j]))
        way = (shown.type, shown.slide)[k % 2]
        way(f"q{j + 1}", value)
        q, look = tells_the_flange(shown)
        poses.append(q)
        seen.append(look)
        assert poses[-1][j] / shown.data["units"][j]["size"] == pytest.approx(value, abs=1e-3)
        assert np.delete(poses[-1] == poses[-2], j).all(), "another joint moved"
    different = {tuple(q) for q in poses}
    assert len({tuple(one.pixels) for one in seen}) == len(different) > 8, "a frozen picture"


def test_joint_explorer_names_singularities(opened):
    shown = opened(joint_explorer(IRB140, np.zeros(6)), IRB140)
    assert shown.look().says == "Singular: wrist singularity."
    shown.type("q5", 30)
    assert shown.look().says == "Not singular."
    shown.slide("q5", 0)
    assert shown.look().says == "Singular: wrist singularity."


def test_a_box_takes_nothing_past_a_limit_and_shows_what_it_took(opened):
    shown = opened(joint_explorer(IRB140), IRB140)
    shown.type("q1", 999)
    assert shown.look().boxes["q1"] == 180 and tells_the_flange(shown)[0][0] == np.pi
    before = shown.look()
    shown.type("q2", "")
    assert shown.look().rows == before.rows
    motion = opened(motion_explorer(IRB140, START, VIA, GOAL), IRB140)
    for name, value, taken in (("time", 99, 5), ("duration", 0, 0.5), ("blend", 9, 0.5)):
        motion.type(name, value)
        assert motion.look().boxes[name] == taken


# --- Every branch with its verdict ----------------------------------------------------------------


def same(arm, q, rows, atol):
    """Whether both are the same postures: whole turns do not count, NaN is NaN."""
    gap = q - rows
    gap = np.where(arm.prismatic, gap, gap - 2 * np.pi * np.round(gap / (2 * np.pi)))
    return np.array_equal(np.isnan(q), np.isnan(rows)) and bool(
        (abs(gap[np.isfinite(rows)]) < np.broadcast_to(atol, rows.shape)[np.isfinite(rows)]).all()
    )


def shows_every_branch(shown, exact=True):
    """The table, the choice, the words and the picture agree with Python's for the target shown."""
    arm, seen = shown.arm, shown.look()
    space = shown.code(seen)
    target, n = space["target"], len(arm.links)
    boxes = np.array([seen.boxes[c["name"]] for c in shown.data["controls"]])
    assert np.allclose(boxes, _values(shown, target), atol=0.0506), "the boxes tell another target"
    rows, units = arm.ik(target), np.array([unit["size"] for unit in shown.data["units"]])
    exists, inside = ~np.isnan(rows[:, 0]), within(arm, rows)
    cells = [row[2 : 2 + n] for row in seen.rows]
    table = np.array([[np.nan if x == "\u2013" else float(x) for x in row] for row in cells]) * units
    near = distance_from_singularity(arm, rows)
    # Three decimals of a degree in the code matter the more, the nearer a singularity is.
    fine = 0.0505 if exact else 0.0505 + 0.005 / np.maximum(np.nan_to_num(near, nan=1), 1e-3)[:, None]
    assert same(arm, table, rows, fine * units)
    usable = exists & inside.all(axis=-1)
    good = table[usable]
    assert ((good >= arm.limits[:, 0] - 0.051 * units) & (good <= arm.limits[:, 1] + 0.051 * units)).all()
    for k, j in np.argwhere(exists[:, None] & ~inside):
        turns = 0 if arm.prismatic[j] else 2 * np.pi * np.arange(-3, 4)
        low, high = arm.limits[j]
        [told, least] = [np.min(np.maximum(low - x, x - high)) for x in (table[k, j], rows[k, j] + turns)]
        assert abs(told - least) < np.max(fine) * units[j], "not where it is least past its limit"
    assert [past[2 : 2 + n] for past in seen.past] == (exists[:, None] & ~inside).tolist()
    verdicts = [row[1] for row in seen.rows]
    assert [verdict.startswith("usable") for verdict in verdicts] == usable.tolist()
    assert [verdict == "does not exist" for verdict in verdicts] == (~exists).tolist() == seen.faint
    for k in np.flatnonzero(exists & ~usable):
        past = ", ".join(f"q{j + 1}" for j in np.flatnonzero(~inside[k]))
        assert verdicts[k] == f"past limit: {past}"
    for k in np.flatnonzero(exists):
        assert float(seen.rows[k][2 + n]) == pytest.approx(near[k], abs=0.00051 if exists.all() and exact else 0.002)
    chosen, wanted = seen.chosen, seen.menus["branch"] - 1
    assert chosen == seen.pressed
    if wanted >= 0:
        assert chosen == (wanted if exists[wanted] else -1)
    elif exists.any():
        travel = [np.inf if row[-1] == "\u2013" else float(row[-1]) for row in seen.rows]
        among = usable if usable.any() else exists
        assert among[chosen] and travel[chosen] == min(np.array(travel)[among])
    drawn = seen.words[0].split("|")
    assert ("no solution here" in drawn) == (chosen < 0)
    row = max(chosen, 0) if wanted < 0 else wanted
    count, why = int(usable.sum()), explain(arm, target, row)
    are = "is" if count == 1 else "are"
    says = f"{count or 'No'} of {len(rows)} branches {are} usable. {why}" if count else (
        f"No branch is usable. {why}"
    )
    if exact:
        assert seen.says == says
    else:  # but for the last digits
        numbers = r"-?\d+\.?\d*"
        assert re.sub(numbers, "", seen.says) == re.sub(numbers, "", says)
    if chosen >= 0:
        assert same(arm, np.array(space["q"]), table[chosen], np.max(fine) * units)
    return SimpleNamespace(seen=seen, table=table, target=target, exists=exists, usable=usable)


def _values(shown, target):
    """What the boxes must say of a target, in mm and degrees, not by the code of the explorer."""
    size = shown.data["unit"]["size"]
    if isinstance(target, ScaraPose):
        turned = np.array([target.angle]) / deg
        place = target.position
    elif isinstance(target, Transform):
        turned = np.array(target.rotation.as_roll_pitch_yaw()) / deg
        place = target.translation
    else:
        place, turned = np.array(target, dtype=float), np.array([])
    values = np.array([*(place / size), *turned])
    flat = shown.data["scene"]["flat"]
    return values if flat is None else np.delete(values, flat)


@named(TARGETS)
def test_every_branch_of_the_target_is_there(opened, arm):
    shown, rng = opened(target_explorer(arm), arm), random.Random(4)
    controls = shown.data["controls"]
    last, kinds, pixels = shows_every_branch(shown), set(), set()
    unit = 1 if arm.prismatic.any() else deg
    for k, control in enumerate([*rng.choices(controls, k=24), *controls[:2]]):
        share = 1.0 if k % 6 == 5 or k > 23 else 0.5
        value = round(share * rng.uniform(control["low"], control["high"]))
        (shown.type, shown.slide)[k % 2](control["name"], value)
        now = shows_every_branch(shown)
        before = last.table[last.seen.chosen] if last.seen.chosen >= 0 else None
        if before is not None:
            travel = abs(now.table - before).sum(axis=-1) / unit
            told = [np.nan if row[-1] == "\u2013" else float(row[-1]) for row in now.seen.rows]
            assert np.allclose(told, travel, atol=0.06 * len(arm.links) + 0.06, equal_nan=True)
        kinds.add("none" if not now.exists.any() else "past" if not now.usable.any() else "usable")
        pixels.add(tuple(now.seen.pixels))
        if now.seen.chosen >= 0:
            last = now
    assert {"none", "usable"} <= kinds and len(pixels) > 15


def test_a_branch_stays_chosen_and_its_reason_is_given(opened):
    shown = opened(target_explorer(IRB140), IRB140)
    shown.choose("branch", 7)  # behind "nearest"
    assert shows_every_branch(shown).seen.chosen == 6
    shown.type("x", 255)
    assert shows_every_branch(shown).seen.chosen == 6
    shown.type("z", 1250)
    seen = shows_every_branch(shown).seen
    assert "beyond the stretched arm" in seen.says and "no solution here" in seen.words[0]
    shown.type("z", 950)
    assert shows_every_branch(shown).seen.chosen == 6


def test_a_joint_past_its_limit_is_shown_where_it_is_least_past_it(opened):
    """Lab 02: q3 at 59.5°, 9.5 past, was shown as -300.5°, 70 past, after a drag through -229°."""
    shown = opened(target_explorer(IRB140), IRB140)
    pose = IRB140.fk(np.array([30, 10, 59.5, 20, 30, 40]) * deg)
    turns = np.array(pose.rotation.as_roll_pitch_yaw()) / deg
    values = dict(zip("xyz", pose.translation / mm, strict=True))
    values |= dict(zip(("roll", "pitch", "yaw"), turns, strict=True))
    tables = []
    for row in (0, 1, 3, 6):  # wherever the joints were before
        shown.choose("branch", row + 1)
        for name, value in (("x", 300), ("y", 0), ("z", 700), ("roll", 0), ("yaw", 0)):
            shown.type(name, value)
        for name, value in values.items():
            shown.type(name, value)
        seen = shows_every_branch(shown, exact=False).seen
        past = np.array([x[2:8] for x in seen.past])
        tables.append(np.where(past, [x[2:8] for x in seen.rows], ""))
        row = next(k for k, cells in enumerate(seen.rows) if cells[4] == "59.5")
        assert past[row, 2] and seen.rows[row][1] == "past limit: q3"
    assert all((table == tables[0]).all() for table in tables)


def test_lab_07_at_x_zero(opened):
    """There q5 was shown as 259.8° where -100.2° is 0.2 past its limit."""
    shown = opened(target_explorer(PUMA560), PUMA560)
    for x in (600, 0, -600, 0):
        shown.type("x", x)
        shows_every_branch(shown)
    rows = shown.look().rows
    assert max(abs(float(row[6])) for row in rows) == pytest.approx(100.2, abs=0.05)
    assert "q5" in rows[4][1] and "q5" in rows[5][1]


def test_a_click_on_a_row_chooses_it_and_a_key_does(opened):
    shown = opened(target_explorer(IRB140), IRB140)
    shown.rk.locator("tbody tr").nth(5).locator("td").nth(3).click()
    seen = shows_every_branch(shown).seen
    assert seen.chosen == 5 and seen.menus["branch"] == 6
    shown.rk.locator(".rk-choose").nth(2).press("Enter")
    after = shows_every_branch(shown).seen
    assert after.chosen == 2 and after.pixels != seen.pixels
    assert np.isclose(shown.code()["q"], IRB140.ik(shown.code()["target"])[2]).all()
    shown.choose("branch", 0)
    assert shows_every_branch(shown).seen.menus["branch"] == 0
