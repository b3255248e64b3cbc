"""Explorers in a real browser, where they show the values that Python computes, whether moved by
mouse, finger or keys; and explorers stored in a notebook.

The tests read what a reader would see: boxes, tables, text, handles, and the pixels and labels on
canvases. If they need more digits, they run the code of "Copy as Python".
"""

import itertools
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
from canvas_words import LINES, RECORD
from conftest import ROOT, awake, until
from machines import UR5
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import robokin
from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    ClosedFormArm,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    differentiate,
    distance_from_singularity,
    explain,
    follow,
    loader_arm,
    mm,
    record,
    spbu_arm,
    three_lever,
    two_link,
    within,
)
from robokin.arms.dexterity import velocity_ellipsoid
from robokin.show import animate, joint_explorer, motion_explorer, target_explorer
from robokin.show.camera import arm_points, project
from robokin.show.joiner import script
from robokin.show.markup import STILL
from robokin.show.palette import PAGE

page = test_browser.page
ELBOW = spbu_arm(500 * mm, 400 * mm)
LOADER = loader_arm(1.2, 1.0)
FLAT = two_link(0.5, 0.4)
LEVERS = three_lever(0.3)
JOINTS = (IRB140, PUMA560, SCARA, LOADER, ELBOW, FLAT, LEVERS, UR5)
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
SAMPLES = 241  # samples of a motion in the page
KINDS = {
    "joint": lambda: joint_explorer(IRB140, singular=True),
    "target": lambda: target_explorer(IRB140),
    "motion": lambda: motion_explorer(IRB140, START, VIA, GOAL),
}


def named(arms):
    return pytest.mark.parametrize("arm", arms, ids=lambda arm: arm.name)


# --- Opening an explorer and reading what it shows ------------------------------------------------

# Records the text drawn on a canvas since it was last cleared, and the text put on the clipboard.
WATCH = """
const pen = CanvasRenderingContext2D.prototype, {clearRect: wipe, fillText: write} = pen;
Object.assign(pen, {
  clearRect(...all) { this.canvas.words = []; return wipe.apply(this, all); },
  fillText(...all) { (this.canvas.words ||= []).push(all[0]); return write.apply(this, all); },
});
const clipboard = {writeText: async text => { window.copied = text; }};
Object.defineProperty(navigator, "clipboard", {value: clipboard});
"""
READ = """async rk => {
  const all = what => [...rk.querySelectorAll(what)];
  const frame = () => new Promise(requestAnimationFrame);
  while (!all("input[type=range]").every(e => e.hasAttribute("aria-valuetext"))) await frame();
  await frame(), await frame();  // until the first picture is drawn with its sliders
  await new Promise(done => setTimeout(done));  // and the search between the samples has run,
  await frame(), await frame();  // and its numbers are shown
  const plain = text => text.replaceAll("\\u2212", "-");
  const named = (what, value) =>
    Object.fromEntries(all(what).map(e => [e.ariaLabel.split(",")[0], value(e)]));
  const hash = text => {
    let h = 7;
    for (let i = 0; i < text.length; i++) h = (31 * h + text.charCodeAt(i)) | 0;
    return h;
  };
  const urls = all("canvas").map(canvas => canvas.toDataURL());
  const rows = all("tbody tr");
  all("button").find(button => /^Cop/.test(button.textContent)).click();
  return {
    code: window.copied, boxes: named("input[type=number]", e => +e.value),
    told: named("input[type=range]", e => plain(e.getAttribute("aria-valuetext"))),
    menus: named("select", e => e.selectedIndex), says: rk.querySelector(".rk-says").textContent,
    count: rk.querySelector(".rk-count")?.textContent, scene: rk.querySelector("canvas").ariaLabel,
    rows: rows.map(row => [...row.cells].map(cell => plain(cell.textContent))),
    past: rows.map(row => [...row.cells].map(cell => cell.classList.contains("rk-past"))),
    faint: rows.map(row => row.classList.contains("rk-none")),
    chosen: rows.findIndex(row => row.getAttribute("aria-current") === "true"),
    pressed: all(".rk-choose").findIndex(e => e.getAttribute("aria-pressed") === "true"),
    pixels: urls.map(hash), bytes: urls.map(url => url.length),
    words: all("canvas").map(canvas => (canvas.words || []).join("|")),
    handles: Object.fromEntries(all(".rk-handle").filter(e => !e.hidden).map(e => {
      const r = e.getBoundingClientRect();
      const at = [r.x + r.width / 2, r.y + r.height / 2];
      const scene = rk.querySelector("canvas").getBoundingClientRect();
      const gaps = [r.x - scene.x, r.y - scene.y, scene.right - r.right, scene.bottom - r.bottom];
      return [e.dataset.handle, {at, name: plain(e.ariaLabel), edge: Math.min(...gaps) < 0.1}];
    })),
  };
}"""


class Open:
    """An explorer in a page, with methods that move it and read what it shows."""

    def __init__(self, page, explorer, arm=None):
        self.page, self.arm, self.data = page, arm, explorer.data
        self.rk = page.locator(".rk")

    def look(self):
        """The state shown in the next frame."""
        seen = SimpleNamespace(**self.rk.evaluate(READ))
        assert min(seen.bytes) > 3000, "a canvas is blank"
        assert "NaN" not in str(vars(seen)) and "undefined" not in str(vars(seen))
        return seen

    def code(self, seen=None):
        """The namespace after the lines of "Copy as Python" have run."""
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
        """Press the mouse button on a handle, and return the position of the handle."""
        self.handle(name).focus()  # brings the handle to the front
        x, y = self.look().handles[name]["at"]
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        return np.array([x, y])

    def drag(self, name, *stops, each=None):
        """Drag a handle to places on the screen, read the state at each place, and return the last
        state.
        """
        self.take(name)
        for stop in stops:
            self.page.mouse.move(*stop, steps=3)
            seen = self.look()
            if each:
                each(seen, stop)
        self.page.mouse.up()
        return self.look()


@pytest.fixture(scope="module")
def context(browser):
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.add_init_script(WATCH)
    yield context
    context.close()


@pytest.fixture
def opened(context, tmp_path):
    """`opened(explorer, arm)` saves the explorer and opens its page in a tab. There must be no
    errors in the console.
    """
    pages = []

    def made(explorer, arm=None, within=context):
        page = watched(within.new_page())
        pages.append(page)
        path = tmp_path / f"{len(pages)}.html"
        explorer.save(path)
        page.goto(path.as_uri())
        awake(page)
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


# --- The joint explorer ---------------------------------------------------------------------------


def shows_the_flange_pose(shown, exact=True):
    """Check that table, boxes and text agree with `fk` of the posture; return the posture."""
    arm, seen = shown.arm, shown.look()
    q = np.array(shown.code(seen)["q"])
    units = [unit["size"] for unit in shown.data["units"]]
    boxes = np.array([seen.boxes[f"q{i + 1}"] for i in range(len(q))]) * units
    assert np.allclose(boxes / units, q / units, atol=0.0501)
    told = [float(seen.told[f"q{i + 1}"].split(" ")[0]) for i in range(len(q))]
    assert np.allclose(told, q / units, atol=0.0501)
    above = seen.count.replace("\N{MINUS SIGN}", "-")  # next to the title
    first, *place = filter(None, seen.rows[0])
    assert above == f"{first}: {', '.join(place)}"
    assert ((q >= arm.limits[:, 0] - 1e-5) & (q <= arm.limits[:, 1] + 1e-5)).all()
    pose, size = arm.fk(q), shown.data["unit"]["size"]
    values = [[float(re.search(r"-?[\d.]+$", x)[0]) for x in row[1:] if x] for row in seen.rows]
    place, turns, wxyz, near = values
    slack = 1 if exact else 3  # the copied code has three decimals
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
def test_joint_explorer_shows_the_flange_pose(opened, arm):
    shown = opened(joint_explorer(arm, singular=True), arm)
    rng, n = random.Random(3), len(arm.links)
    poses, seen = map(list, zip(shows_the_flange_pose(shown), strict=True))
    ends = arm.limits / [[unit["size"]] for unit in shown.data["units"]]
    for k in range(8):
        j = k % n
        value = round(rng.uniform(*ends[j]))
        way = (shown.type, shown.slide)[k % 2]
        way(f"q{j + 1}", value)
        q, look = shows_the_flange_pose(shown)
        poses.append(q)
        seen.append(look)
        assert poses[-1][j] / shown.data["units"][j]["size"] == pytest.approx(value, abs=1e-3)
        assert np.delete(poses[-1] == poses[-2], j).all(), "another joint moved"
    different = {tuple(q) for q in poses}
    assert len({tuple(one.pixels) for one in seen}) == len(different) > 5, (
        "the picture does not change"
    )


def test_double_click_on_a_ring_moves_it_back_to_its_start(opened):
    shown = opened(joint_explorer(IRB140), IRB140)
    start = shown.look()
    for name in ("q2", "q6"):
        x, y = start.handles[name]["at"]
        moved = shown.drag(name, (x + 30, y + 40))
        assert moved.boxes[name] != start.boxes[name]
        assert (moved.count != start.count) == (name == "q2"), "joint 6 does not move the flange"
        shown.handle(name).dblclick()
        assert shown.look().code == start.code and shown.look().count == start.count


def test_joint_explorer_names_singularities(opened):
    shown = opened(joint_explorer(IRB140, np.zeros(6), singular=True), IRB140)
    assert shown.look().says == "Singular: wrist singularity."
    shown.type("q5", 30)
    assert shown.look().says == "Not singular."
    shown.slide("q5", 0)
    assert shown.look().says == "Singular: wrist singularity."


def test_explorer_mentions_singularities_only_on_request(opened):
    shown = opened(joint_explorer(IRB140, np.zeros(6)), IRB140)
    text = shown.page.locator(".rk").inner_text()
    assert "ingular" not in text and "ellipsoid" not in text and "quaternion" in text
    assert shown.page.get_by_label("joint axes").count() == 1
    more = opened(joint_explorer(IRB140, np.zeros(6), singular=True), IRB140)
    text = more.page.locator(".rk").inner_text()
    assert "distance from singularity" in text and "ellipsoid" in text


def test_number_box_stops_at_the_limit_and_shows_the_value_used(opened):
    shown = opened(joint_explorer(IRB140, singular=True), IRB140)
    shown.type("q1", 999)
    assert shown.look().boxes["q1"] == 180 and shows_the_flange_pose(shown)[0][0] == np.pi
    before = shown.look()
    shown.type("q2", "")
    assert shown.look().rows == before.rows
    motion = opened(motion_explorer(IRB140, START, VIA, GOAL), IRB140)
    for name, value, taken in (("duration", 0, 0.5), ("blend", 9, 0.5)):
        motion.type(name, value)
        assert motion.look().boxes[name] == taken


# --- The target explorer --------------------------------------------------------------------------


def same(arm, q, rows, atol):
    """Whether q and rows are the same postures except for whole turns; NaN equals NaN."""
    gap = q - rows
    gap = np.where(arm.prismatic, gap, gap - 2 * np.pi * np.round(gap / (2 * np.pi)))
    return np.array_equal(np.isnan(q), np.isnan(rows)) and bool(
        (abs(gap[np.isfinite(rows)]) < np.broadcast_to(atol, rows.shape)[np.isfinite(rows)]).all()
    )


def shows_every_branch(shown, exact=True):
    """Assert that the table, the chosen row, the text and the picture agree with what Python
    computes for the target shown.
    """
    arm, seen = shown.arm, shown.look()
    space = shown.code(seen)
    target, n = space["target"], len(arm.links)
    boxes = np.array([seen.boxes[c["name"]] for c in shown.data["controls"]])
    assert np.allclose(boxes, _values(shown, target), atol=0.0506), "the boxes show another target"
    rows, units = arm.ik(target), np.array([unit["size"] for unit in shown.data["units"]])
    exists, inside = ~np.isnan(rows[:, 0]), within(arm, rows)
    cells = [row[2 : 2 + n] for row in seen.rows]
    table = (
        np.array([[np.nan if x == "\u2013" else float(x) for x in row] for row in cells]) * units
    )
    near = distance_from_singularity(arm, rows)
    # Near a singularity, rounding to three decimals of a degree in the copied code has a larger
    # effect.
    fine = (
        0.0505 if exact else 0.0505 + 0.005 / np.maximum(np.nan_to_num(near, nan=1), 1e-3)[:, None]
    )
    assert same(arm, table, rows, fine * units)
    usable = exists & inside.all(axis=-1)
    good = table[usable]
    assert (
        (good >= arm.limits[:, 0] - 0.051 * units) & (good <= arm.limits[:, 1] + 0.051 * units)
    ).all()
    for k, j in np.argwhere(exists[:, None] & ~inside):
        turns = 0 if arm.prismatic[j] else 2 * np.pi * np.arange(-3, 4)
        low, high = arm.limits[j]
        [told, least] = [
            np.min(np.maximum(low - x, x - high)) for x in (table[k, j], rows[k, j] + turns)
        ]
        assert abs(told - least) < np.max(fine) * units[j], (
            "another value exceeds the limit by less"
        )
    assert [past[2 : 2 + n] for past in seen.past] == (exists[:, None] & ~inside).tolist()
    verdicts = [row[1] for row in seen.rows]
    assert [verdict.startswith("usable") for verdict in verdicts] == usable.tolist()
    assert [verdict == "does not exist" for verdict in verdicts] == (~exists).tolist() == seen.faint
    for k in np.flatnonzero(exists & ~usable):
        past = ", ".join(f"q{j + 1}" for j in np.flatnonzero(~inside[k]))
        assert verdicts[k] == f"past limit: {past}"
    for k in np.flatnonzero(exists):
        assert float(seen.rows[k][2 + n]) == pytest.approx(
            near[k], abs=0.00051 if exists.all() and exact else 0.002
        )
    assert seen.count == f"{usable.sum()} of {len(usable)} usable"
    assert seen.scene.startswith(f"{arm.name} and a target") and seen.says in seen.scene
    chosen, wanted = seen.chosen, seen.menus["branch"] - 1
    assert chosen == seen.pressed
    if wanted >= 0:
        assert chosen == (wanted if exists[wanted] else -1)
    elif exists.any():
        travel = [np.inf if row[-1] == "\u2013" else float(row[-1]) for row in seen.rows]
        among = usable if usable.any() else exists
        assert among[chosen] and travel[chosen] == min(np.array(travel)[among])
    drawn = seen.words[0].split("|")
    assert ("no solution" in drawn) == (chosen < 0)
    row = max(chosen, 0) if wanted < 0 else wanted
    count, why = int(usable.sum()), explain(arm, target, row)
    are = "is" if count == 1 else "are"
    says = (
        f"{count or 'No'} of {len(rows)} branches {are} usable. {why}"
        if count
        else (f"No branch is usable. {why}")
    )
    if exact:
        assert seen.says == says
    else:  # the numbers may differ in their last digits
        numbers = r"-?\d+\.?\d*"
        assert re.sub(numbers, "", seen.says) == re.sub(numbers, "", says)
    if chosen >= 0:
        assert same(arm, np.array(space["q"]), table[chosen], np.max(fine) * units)
    return SimpleNamespace(seen=seen, table=table, target=target, exists=exists, usable=usable)


def _values(shown, target):
    """The numbers expected in the boxes of a target, in mm and degrees, computed
    without the explorer."""
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
def test_target_explorer_lists_every_branch(opened, arm):
    shown, rng = opened(target_explorer(arm), arm), random.Random(4)
    controls = shown.data["controls"]
    last, kinds, pixels = shows_every_branch(shown), set(), set()
    start = last.seen.boxes
    walk = [(control, 0.3) for control in rng.choices(controls, k=12)]
    for k, (control, share) in enumerate([*walk, *((c, 1) for c in controls[:2])]):
        low, high, step = control["low"], control["high"], control["step"]
        value = high if share == 1 else start[control["name"]] + share * rng.uniform(low, high)
        value = round(min(max(value, low), high) / step) * step
        (shown.type, shown.slide)[k % 2](control["name"], value)
        now = shows_every_branch(shown)
        before = last.table[last.seen.chosen] if last.seen.chosen >= 0 else None
        if before is not None:
            travel = abs(now.table - before)[:, ~arm.prismatic].sum(axis=-1) / deg
            told = [np.nan if row[-1] == "\u2013" else float(row[-1]) for row in now.seen.rows]
            assert np.allclose(told, travel, atol=0.1 * len(arm.links) + 0.06, equal_nan=True)
        kinds.add("none" if not now.exists.any() else "past" if not now.usable.any() else "usable")
        pixels.add(tuple(now.seen.pixels))
        if now.seen.chosen >= 0:
            last = now
    assert {"none", "usable"} <= kinds and len(pixels) > 8


def test_target_explorer_opens_at_a_given_pose(opened):
    """It opens on a usable branch if possible, and updates the count as keys move the target."""
    level = Quaternion.from_angle_axis(90 * deg, (0, 1, 0))
    for place, count in (((550, 0, 800), 3), ((-500, 0, 700), 0), ((550, 600, 800), 8)):
        target = Transform(level, np.array(place) * mm)
        explorer = target_explorer(PUMA560, target)
        shown = opened(explorer, PUMA560)
        first = shows_every_branch(shown)
        assert first.usable.sum() == count and explorer.data["alt"] in first.seen.scene
        assert (first.usable if count else first.exists)[first.seen.chosen]
        assert np.allclose(first.target.as_matrix(), target.as_matrix(), rtol=0, atol=1e-9)
    shown.press("y", *["Shift+ArrowDown"] * 9)
    assert shows_every_branch(shown).usable.sum() < 8
    shown.press("y", "Home")
    assert shows_every_branch(shown).usable.sum() == 8


def test_chosen_branch_is_kept_out_of_reach_and_the_reason_is_given(opened):
    shown = opened(target_explorer(IRB140), IRB140)
    shown.choose("branch", 7)  # row 6, since "nearest" comes first
    assert shows_every_branch(shown).seen.chosen == 6
    shown.type("x", 255)
    assert shows_every_branch(shown).seen.chosen == 6
    shown.type("z", 1250)
    seen = shows_every_branch(shown).seen
    assert "beyond the reach of the arm" in seen.says and "no solution" in seen.words[0]
    shown.type("z", 950)
    assert shows_every_branch(shown).seen.chosen == 6


def test_joint_outside_its_limits_is_shown_with_the_least_excess(opened):
    """In lab 02, after a drag through -229°, q3 = 59.5° (9.5° beyond its limit) was once shown as
    -300.5° (70° beyond it).
    """
    shown = opened(target_explorer(IRB140), IRB140)
    pose = IRB140.fk(np.array([30, 10, 59.5, 20, 30, 40]) * deg)
    turns = np.array(pose.rotation.as_roll_pitch_yaw()) / deg
    values = dict(zip("xyz", pose.translation / mm, strict=True))
    values |= dict(zip(("roll", "pitch", "yaw"), turns, strict=True))
    tables = []
    for row in (0, 1, 3, 6):  # independent of the previous posture
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


def test_q5_has_the_least_excess_in_lab_07_at_x_zero(opened):
    """In lab 07 at x = 0, q5 was once shown as 259.8°, although -100.2° exceeds its limit by only
    0.2°.
    """
    shown = opened(target_explorer(PUMA560), PUMA560)
    for x in (600, 0, -600, 0):
        shown.type("x", x)
        shows_every_branch(shown)
    rows = shown.look().rows
    assert max(abs(float(row[6])) for row in rows) == pytest.approx(100.2, abs=0.05)
    assert "q5" in rows[4][1] and "q5" in rows[5][1]


def test_row_is_chosen_by_click_or_key(opened):
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


def test_click_on_a_row_or_its_button_chooses_it_once(browser):
    tab = browser.new_page()
    click = """const taken = [];
      const {node} = $table.table(["a", "b"], ["", "x"], [1], k => taken.push(k));
      document.body.append(node);
      node.querySelectorAll("button")[1].click();
      node.querySelector("tbody td").click();
      return taken;"""
    assert tab.evaluate(f"() => {{ {script('table')}\n{click} }}") == [1, 0]
    tab.close()


def test_home_key_on_an_arc_restores_the_initial_rotation(opened):
    """The sliders once changed the array that Home restores."""
    shown = opened(target_explorer(IRB140), IRB140)
    first = shown.look().boxes
    for name in ("roll", "pitch", "yaw"):
        shown.slide(name, first[name] / 2 + 10)
    assert all(shown.look().boxes[name] != first[name] for name in ("roll", "pitch", "yaw"))
    shown.press("turn y", "Home")
    assert shown.look().boxes == first


def test_sliders_change_the_lever_lengths(opened):
    """The arm, the curve and the text change with the three additional sliders, and the Python
    lines contain the lengths.
    """
    arm = three_lever((0.9, 1.1, 0.6))
    shown = opened(target_explorer(arm), arm)
    assert opened(target_explorer(LEVERS)).look().boxes.keys() == {"x", "y", "alpha"}
    first = shown.look()
    assert [first.boxes[f"lever {name}"] for name in ("OB", "BA", "AK")] == [0.9, 1.1, 0.6]
    shown.type("x", 1.4)
    shown.type("y", 0.7)
    for lengths in ((0.9, 1.1, 0.6), (0.7, 1.1, 0.6), (0.7, 1.2, 0.45), (1.3, 1.0, 0.3)):
        for name, length in zip(("OB", "BA", "AK"), lengths, strict=True):
            shown.type(f"lever {name}", length)
        seen = shown.look()
        space = shown.code(seen)
        assert space["arm"].levers.tolist() == list(lengths)
        assert np.allclose(space["arm"].fk(space["q"]).translation, (1.4, 0.7, 0), atol=1e-9)
        told = [float(x) for x in re.findall(r"(?:gamma|beta|alpha) (-?[\d.]+)", seen.says)]
        assert np.allclose(told, space["q"] / deg, atol=0.06)
        before = np.array(shown.data["q"])
        least = space["arm"].least((1.4, 0.7), before)
        told = re.search(r"least S is ([\d.]+)°, at alpha = ([\d.]+)°", seen.says).groups()
        assert np.allclose([float(x) for x in told], [least[1] / deg, least[0][2] / deg], atol=0.06)
    assert all(a != b for a, b in zip(seen.pixels, first.pixels, strict=True))
    shown.type("lever AK", 1.5)  # the point is now nearer than |OB - BA| + AK
    shown.type("lever BA", 0.5)
    assert shown.look().says == (
        "This course allows only points farther from the base than |OB \N{MINUS SIGN} BA| + AK "
        "(2300.0 mm); this one lies 1565.2 mm from it."
    )


def test_axis_of_the_free_angle_is_the_same_for_every_target(context, opened):
    """The axis does not adapt to the range: an angle is at the same place for every target."""
    context.add_init_script(RECORD)
    shown = opened(target_explorer(LEVERS), LEVERS)
    places, spans = [], set()
    for x in (-0.5, -0.1, 0.2, 0.4, 0.6):
        shown.type("x", 1000 * x)
        shown.type("y", 500)
        shown.look()
        curves = shown.page.evaluate("canvasWords()")[-1]["words"]
        ends = [word for word in curves if re.fullmatch(r"[\d.]+\.\d°", word["text"])]
        low, high = np.array(LEVERS.alpha_range((x, 0.5))) / deg
        assert [float(end["text"][:-1]) for end in ends] == pytest.approx([low, high], abs=0.06)
        (left, _, width, _), (right, _, wide, _) = (end["box"] for end in ends)
        if high - low < 30:  # about 60 px: the texts are beside the ends, not below them
            places += [(low, left + width + 3), (high, right - 3)]
        else:
            places += [(low, left + width / 2), (high, right + wide / 2)]
        spans.add(round(high - low))
    angles, pixels = np.transpose(places)
    slope, start = np.polyfit(angles, pixels, 1)
    assert len(spans) > 3 and 180 * slope > 150
    assert np.allclose(start + slope * angles, pixels, atol=0.6)


# --- The motion explorer --------------------------------------------------------------------------


SMOOTH = np.polynomial.chebyshev


def greatest(motion, law, fraction, samples):
    """The greatest speeds and accelerations (2, n) of a motion without a gap, even between the
    samples. They come from one polynomial for each interval in which no acceleration jumps.
    `motion(t)` returns the postures.
    """
    corner = brentq(lambda x: law(x) - (0.5 - fraction), 0, law.duration / 2)
    ends = {0, corner, *(law.duration * np.array([1, 3]) / 4), law.duration - corner, law.duration}
    pieces = [(low, high) for low, high in itertools.pairwise(sorted(ends)) if high - low > 1e-6]
    nodes, fine = SMOOTH.chebpts1(64), np.linspace(-1, 1, 4001)
    times = np.concatenate([low + (high - low) * (nodes + 1) / 2 for low, high in pieces])
    every = np.union1d(times, samples)
    postures = motion(every)[np.searchsorted(every, times)].reshape(len(pieces), 64, -1)
    tops = []
    for (low, high), q in zip(pieces, postures, strict=True):
        fit = SMOOTH.chebfit(nodes, q, 63)
        curves = [SMOOTH.chebval(fine, SMOOTH.chebder(fit, k)) for k in (1, 2)]
        scales = 2 / (high - low), (2 / (high - low)) ** 2
        tops.append([abs(y).max(axis=-1) * k for y, k in zip(curves, scales, strict=True)])
    return np.max(tops, axis=0)


def shows_the_motion(shown, exact=True, held=False):
    """Assert that table and text agree with the motion in the code; return the motion and the state
    shown. `held` says whether a handle is still held.
    """
    arm, seen = shown.arm, shown.look()
    space = shown.code(seen)
    law, n = space["law"], len(arm.links)
    units, size = np.array([u["size"] for u in shown.data["units"]]), shown.data["unit"]["size"]
    t = np.linspace(0, law.duration, SAMPLES)
    corner = shown.data["corners"][seen.menus["corner"]]
    fraction, row = seen.boxes["blend"], seen.menus["branch"]
    stations = [space[name] for name in ("start", "via", "goal")]
    assert law.duration == seen.boxes["duration"]
    kinds = {name: getattr(robokin, name) for name in shown.data["laws"]}
    assert np.allclose(law(t), list(kinds.values())[seen.menus["time law"]](law.duration)(t))
    place = _values(shown, stations[1])[:3]
    assert np.allclose([seen.boxes[f"via {c}"] for c in "xyz"], place, atol=0.0506)

    def motion(x):
        return follow(arm, arm.ik(blend(*stations, fraction, law(x), corner=corner)), row)

    q = motion(t)
    assert np.allclose(space["q"][[0, -1]], q[[0, -1]], equal_nan=True)
    with np.errstate(all="ignore"):
        recording = record(arm, t, q)
    v, a = recording.v, recording.a
    if fraction == 0:  # differentiated in halves, so that no difference spans the corner
        half = SAMPLES // 2
        v = np.array(
            [*differentiate(q[: half + 1], t[: half + 1])[:-1], *differentiate(q[half:], t[half:])]
        )
        a = np.full_like(v, np.nan)
    with np.errstate(all="ignore"):
        tops = np.array([np.fmax.reduce(abs(x), axis=0) for x in (v, a)])
    of = f", of {SAMPLES} samples"
    if not (held or recording.gaps.any()):
        of, tops = "", greatest(motion, law, fraction, t)
    for jump in recording.jumps if fraction == 0 else ():  # no finite acceleration
        tops[1][jump.by != 0] = np.nan
    heads = [f"greatest {what}{of}" for what in ("speed, per s", "acceleration, per s²")]
    assert [told[0] for told in seen.rows] == heads
    for told, wanted in zip(seen.rows, tops / units, strict=True):
        numbers = np.array(
            [float(x.split(" ")[0].replace("\u2013", "nan")) for x in told[1 : 1 + n]]
        )
        slack = np.where(wanted < 9999, 0.0505, 0.505) + (0 if exact else 2e-3 * wanted)
        good = abs(numbers - wanted) <= slack
        assert (good | (np.isnan(numbers) & np.isnan(wanted))).all(), (numbers, wanted)
    missing = int(recording.missing.sum())
    assert (f"No solution in {missing} of {SAMPLES} samples." in seen.says) == (missing > 0)
    for j in range(n):
        past = int((np.nan_to_num(recording.excess[:, j]) > 1e-9).sum())
        words = f"q{j + 1} exceeds its limit in {past} of {SAMPLES} samples."
        assert (words in seen.says) == (past > 0), (words, seen.says)
    assert ("The speed jumps" in seen.says) == (fraction == 0 and len(recording.jumps) > 0)
    fine = law(np.linspace(0, law.duration, 100 * (SAMPLES - 1) + 1))
    path = blend(*stations, fraction, fine, corner=corner)
    place = "position" if isinstance(path, ScaraPose) else "translation"
    near = np.linalg.norm(getattr(path, place) - getattr(stations[1], place), axis=-1).min()
    [told] = map(float, re.findall(r"passes (-?[\d.]+)", seen.says.replace("\u2212", "-")))
    if missing == 0:
        assert told == pytest.approx(near / size, abs=0.0505 if exact else 0.1)
    return SimpleNamespace(seen=seen, stations=stations, q=q, t=t, missing=missing)


@named(POSES)
def test_motion_explorer_uses_the_via_point_in_the_number_boxes(opened, arm):
    shown = opened(motion_explorer(arm, *POSES[arm]), arm)
    looks = [shows_the_motion(shown)]
    cells = [cell.split(" ")[0] for cell in looks[0].seen.rows[0][1:]]
    told = re.search(r"greatest speed (\S+) \S+ \(joint (\d)\)\.$", shown.data["summary"])
    assert told[1] == cells[int(told[2]) - 1] == max(cells, key=float), "Python names another joint"
    for change in (
        lambda: shown.type("via x", looks[0].seen.boxes["via x"] + 20),
        lambda: shown.slide("blend", 0.25),
        lambda: shown.type("duration", 8),
        lambda: shown.choose("corner", 1),
        lambda: shown.choose("time law", 1),
        lambda: shown.choose("time law", 2),
        lambda: shown.choose("time law", 0),
        lambda: shown.type("blend", 0.5),
        lambda: shown.type("blend", 0.02),
        lambda: shown.choose("branch", (looks[0].seen.menus["branch"] + 1) % len(arm.branches)),
        lambda: shown.choose("branch", looks[0].seen.menus["branch"]),
        lambda: shown.slide("via z", looks[0].seen.boxes["via z"] - 30),
        lambda: shown.type("blend", 0),
    ):
        change()
        looks.append(shows_the_motion(shown))
        assert looks[-1].seen.code != looks[-2].seen.code, "nothing changed"
        assert looks[-1].seen.pixels[1] != looks[-2].seen.pixels[1], "the curves do not change"


def test_unreachable_via_point_leaves_a_gap_with_a_message(opened):
    shown = opened(motion_explorer(IRB140, START, VIA, GOAL), IRB140)
    shown.slide("time", 200)  # of 400 steps
    assert "no solution" not in shown.look().words[0]
    shown.type("via x", 1250)
    there = shows_the_motion(shown)
    assert there.missing and "no solution" in there.seen.words[0]
    shown.type("via x", 650)
    assert shows_the_motion(shown).missing == 0
    for name in ("start", "via", "goal"):  # everything is out of reach, so there is nothing to draw
        shown.press(name, *["Shift+ArrowRight"] * 30)
    seen = shown.look()
    assert f"No solution in {SAMPLES} of {SAMPLES} samples." in seen.says
    assert [cell for cell in seen.rows[0][1:] if cell != "\u2013"] == []


def test_maxima_through_a_singularity_are_labelled_as_sampled(opened):
    """At via, axes 4 and 6 coincide, so that joints 4 and 6 can share a rotation in any way."""
    ahead = Quaternion.from_angle_axis(90 * deg, (0, 1, 0))
    stations = [Transform(ahead, (0.515, y, 0.702)) for y in (-0.2, 0, 0.2)]
    shown = opened(motion_explorer(IRB140, *stations), IRB140)
    assert f"greatest speed of {SAMPLES} samples" in shown.data["summary"]
    for blend_ in (0.1, 0):
        shown.type("blend", blend_)
        assert [row[0].endswith(f"of {SAMPLES} samples") for row in shown.look().rows] == [True] * 2
    shown.type("via z", 690)  # next to the singularity
    shows_the_motion(shown)


def test_click_on_a_curve_sets_the_clock(opened):
    shown = opened(motion_explorer(IRB140, START, VIA, GOAL), IRB140)
    canvas, before = shown.rk.locator(".rk-curves"), shown.look()
    box = canvas.bounding_box()
    times, pixels = [], set()
    for share in (0.3, 0.6, 0.9):
        canvas.click(position={"x": share * box["width"], "y": 100})
        seen = shown.look()
        times.append(float(seen.told["time"].removesuffix(" s")))
        pixels.add(seen.pixels[0])
        assert seen.rows == before.rows and seen.code == before.code, (
            "something other than the clock changed"
        )
    assert np.diff(times) == pytest.approx(times[1] - times[0], abs=0.02)
    assert 1 < times[0] < times[2] < 5 and len(pixels) == 3
    canvas.click(position={"x": box["width"] - 1, "y": 100})
    assert shown.look().told["time"] == "5.00 s"


def test_motion_plays_to_its_end_and_keeps_its_numbers(opened):
    shown = opened(motion_explorer(IRB140, START, VIA, GOAL, law="linear", duration=0.5), IRB140)
    before = shown.look()
    assert before.boxes["duration"] == 0.5 and before.menus["time law"] == 2
    assert "robokin.linear(0.5)" in before.code
    shown.rk.get_by_role("button", name="play").click()
    until(lambda: shown.look().told["time"] == "0.50 s", "it does not play", shown.page)
    after = shown.look()
    assert after.rows == before.rows and after.code == before.code
    assert after.pixels[0] != before.pixels[0]
    shown.type("duration", 4)  # the clock keeps its fraction of the motion
    assert shown.look().told["time"] == "4.00 s"


# --- Dragging handles -----------------------------------------------------------------------------


def follows_the_pointer(shown, name, parts, *keys):
    """Drag a handle along the curve on which keys move it. Assert that it stays under the pointer,
    that the explorer shows what it showed after the keys, and that no values except `parts` change.
    Return the length of the path on the screen in px, or None if the handle hardly moves because
    its axis points at the viewer, or if it stops at the edge of the scene.
    """
    start = shown.look()
    places, codes = [], []
    shown.take(name)  # the camera does not move while a handle is held
    for _ in range(3):
        shown.press(name, *keys)
        seen = shown.look()
        places.append(np.array(seen.handles[name]["at"], dtype=float))
        codes.append(seen)
    assert codes[0].code != start.code, f"{name}: {keys} change nothing"
    shown.press(name, "Home")
    shown.page.mouse.up()
    back = shown.look()
    assert back.code == start.code and back.pixels == start.pixels, (
        f"{name}: Home leads to another position"
    )
    long = np.linalg.norm(places[2] - places[0])
    if long < 8 or any(look.handles[name]["edge"] for look in (start, *codes)):
        return None
    seen = []
    last = shown.drag(name, *places, each=lambda look, stop: seen.append(look))
    for look, place, key_look in zip(seen, places, codes, strict=True):
        assert np.linalg.norm(np.array(look.handles[name]["at"]) - place) < 3, (
            f"{name} does not stay under the pointer"
        )
        for part, value in key_look.boxes.items():
            step = abs(codes[2].boxes[part] - codes[0].boxes[part])
            assert abs(look.boxes[part] - value) <= 4 * step / long + 0.15, (name, part)
    assert last.code == seen[-1].code and last.rows != start.rows, "the last position is not shown"
    moved = {part for part in last.boxes if last.boxes[part] != start.boxes[part]}
    assert moved and moved <= parts, f"{name} moves {moved}"
    shown.press(name, "Home")
    assert shown.look().code == start.code
    return long


@named((IRB140, SCARA, FLAT, LEVERS, UR5))
def test_dragging_moves_only_the_held_joint(opened, arm):
    shown, seen = opened(joint_explorer(arm, singular=True), arm), 0
    ends = arm.limits / [[unit["size"]] for unit in shown.data["units"]]
    for j, (_, high) in enumerate(ends):
        name = f"q{j + 1}"
        key = "Shift+ArrowRight" if shown.look().boxes[name] + 60 < high else "Shift+ArrowLeft"
        if follows_the_pointer(shown, name, {name}, key, key):
            seen += 1
    assert seen >= 0.5 * len(ends)
    shown.take("q1")
    x, y = shown.look().handles["q1"]["at"]
    shown.page.mouse.move(x + 40, y + 30)
    shown.page.mouse.up()
    shows_the_flange_pose(shown, exact=False)


@named((IRB140, SCARA, ELBOW, FLAT))
def test_target_follows_the_pointer_along_arrows_and_arcs(opened, arm):
    shown = opened(target_explorer(arm), arm)
    place = {c["name"] for c in shown.data["controls"][:3] if c["name"] in "xyz"}
    turns = {c["name"] for c in shown.data["controls"]} - place
    names, seen = set(shown.look().handles) - {"free"}, set()
    assert names == place | (
        {"angle"} if arm is SCARA else {f"turn {c}" for c in "xyz"} if arm is IRB140 else set()
    )
    for name in sorted(names):
        parts = place if name in "xyz" else turns
        if follows_the_pointer(shown, name, parts, "Shift+ArrowLeft"):
            seen.add(name)
        before = shown.code()["target"]
        shown.press(name, "ArrowRight")
        after = shown.code()["target"]
        shown.press(name, "Home")
        if arm is IRB140:  # its handles move along the target's own axes
            move = before.inverse() @ after
            angle, axis = move.rotation.as_angle_axis()
            way = np.eye(3)["xyz".index(name[-1])]
            if name in "xyz":
                assert np.allclose(move.translation, 5 * mm * way, atol=2e-6) and angle < 1e-4
            else:
                assert np.allclose(angle * np.array(axis), 1 * deg * way, atol=5e-5)
                assert np.allclose(move.translation, 0, atol=1e-9)
    assert len(seen) >= 0.6 * len(names)


@named((IRB140, SCARA, LOADER, FLAT))
def test_freely_dragged_target_stays_under_the_pointer(opened, arm):
    shown = opened(target_explorer(arm), arm)
    before = shows_every_branch(shown)
    azimuth, elevation = shown.data["scene"]["view"]
    eye = [
        np.cos(elevation) * np.cos(azimuth),
        np.cos(elevation) * np.sin(azimuth),
        np.sin(elevation),
    ]
    start = np.array(before.seen.handles["free"]["at"], dtype=float)

    def each(look, stop):
        assert np.linalg.norm(np.array(look.handles["free"]["at"]) - stop) < 1.5
        tables.append(shows_every_branch(shown, exact=False))

    tables = []
    shown.drag(
        "free", *(start + way for way in ((20, 0), (30, 15), (-25, 10), (7, -12))), each=each
    )
    last = shows_every_branch(shown, exact=False)
    assert last.seen.code == tables[-1].seen.code
    controls = [c["name"] for c in shown.data["controls"]]
    assert all(last.seen.boxes[c] == before.seen.boxes[c] for c in controls if c not in "xyz")
    moved = _place(last.target) - _place(before.target)
    assert np.linalg.norm(moved) > 1e-3 and abs(moved @ eye) < 2e-3 * shown.data["unit"]["size"]
    shown.press("free", "Home")
    assert shown.look().boxes == before.seen.boxes


def _place(target):
    if isinstance(target, ScaraPose):
        return target.position
    return target.translation if isinstance(target, Transform) else np.array(target)


# Values of a target at which the arm is singular: joint 1 is free, or the arm is stretched.
SINGULAR = {
    IRB140: {"x": 0, "y": 0, "roll": 0, "pitch": 0},
    SCARA: {"x": SCARA.reach / mm, "y": 0},
    LOADER: {"x": 0, "y": 0, "z": 1.2},
    FLAT: {"x": FLAT.reach / mm, "y": 0},
}


@named(SINGULAR)
def test_explorer_recovers_from_a_drag_out_of_reach_or_through_a_singularity(opened, arm):
    shown = opened(target_explorer(arm), arm)
    start = np.array(shown.look().handles["free"]["at"], dtype=float)
    kinds, pixels, hub = [], set(), PAGE["hub"][0]

    def each(look, stop):
        now = shows_every_branch(shown, exact=False)
        kinds.append(now.exists.any())
        pixels.add(tuple(now.seen.pixels))
        # The dot that marks the flange must be in the middle of the target.
        assert _color(shown, now.seen.handles["free"]["at"]) == hub or not now.exists.any()
        if not now.exists.any():
            assert all(row[1] == "does not exist" for row in now.seen.rows)
            assert re.search(r"\d+(\.\d+)? m", now.seen.says), "the distance is missing"
            assert arm is FLAT or _color(shown, now.seen.handles["free"]["at"]) != hub

    out = [start + (way, way / 2) for way in (0, 30, 60, 120, 200, 300)]
    across = [start + (-way, 0) for way in (15, 35, 45, 60)]  # across axis 1
    shown.drag("free", *out, *out[::-1], *across, start, each=each)
    assert kinds[0] and kinds[-1], "the drag does not begin and end within reach"
    assert not all(kinds), "the drag never goes out of reach"
    assert len(pixels) > 7
    shown.press("free", "Home")
    for name, value in SINGULAR[arm].items():
        shown.type(name, value) if name in "xyz" else shown.slide(name, value)
    over = shows_every_branch(shown, exact=False)
    assert "singular" in over.seen.says.lower() or "singular" in str(over.seen.rows)


def _color(shown, at):
    """The colour of the scene at a point on the page."""
    return shown.rk.locator(".rk-scene").evaluate(
        """(canvas, [x, y]) => {
          const r = canvas.getBoundingClientRect(), k = canvas.width / r.width;
          const place = [(x - r.x) * k, (y - r.y) * k].map(Math.round);
          const rgb = [...canvas.getContext("2d").getImageData(...place, 1, 1).data.slice(0, 3)];
          return "#" + rgb.map(x => x.toString(16).padStart(2, "0")).join("").toUpperCase();
        }""",
        at,
    )


@named(POSES)
def test_dragging_moves_only_the_held_pose(opened, arm):
    shown = opened(motion_explorer(arm, *POSES[arm]), arm)
    names = ("start", "via", "goal")
    assert set(shown.look().handles) == {*names, "via x", "via y", "via z"}
    for k, name in enumerate(names):
        before = shows_the_motion(shown)
        start = np.array(before.seen.handles[name]["at"], dtype=float)

        def each(look, stop, name=name):
            assert np.linalg.norm(np.array(look.handles[name]["at"]) - stop) < 1.5
            shows_the_motion(shown, exact=False, held=True)

        shown.drag(name, start + (8, 5), start + (-6, 10), each=each)
        after = shows_the_motion(shown, exact=False)
        moved = [
            np.linalg.norm(_place(a) - _place(b)) > 1e-6
            for a, b in zip(after.stations, before.stations, strict=True)
        ]
        assert moved == [i == k for i in range(3)]
        shown.press(name, "Home")
        assert shown.look().code == before.seen.code
    for c in "xyz" if arm is IRB140 else "z":
        follows_the_pointer(shown, f"via {c}", {f"via {c}"}, "Shift+ArrowRight")


CANVASES = {
    "motion": lambda: (motion_explorer(IRB140, START, VIA, GOAL), IRB140),
    "levers": lambda: (target_explorer(LEVERS), LEVERS),
}
SIZES = """rk => [...rk.querySelectorAll("canvas")].map(c =>
  [c.width / c.clientWidth, c.height / c.clientHeight])"""


@pytest.mark.parametrize("kind", CANVASES)
def test_canvases_are_redrawn_after_a_change_of_theme_or_size(opened, kind):
    """Each canvas is compared separately, since the curves once kept the colours of the previous
    theme.
    """
    shown = opened(*CANVASES[kind]())
    shown.page.emulate_media(color_scheme="light")
    light = shown.look().pixels
    shown.page.emulate_media(color_scheme="dark")
    dark = shown.look().pixels
    assert len(light) == 2 and all(a != b for a, b in zip(light, dark, strict=True))
    shown.page.emulate_media(color_scheme="light")
    assert shown.look().pixels == light
    for width in (560, 1366, 390, 900):
        shown.page.set_viewport_size({"width": width, "height": 800})
        shown.look()
        ratios = np.array(shown.rk.evaluate(SIZES))
        assert np.allclose(ratios, ratios[0, 0], rtol=0.01), (width, ratios)


@pytest.mark.parametrize("kind", KINDS)
def test_explorer_shows_the_last_of_many_pointer_positions(opened, kind):
    """If the pointer makes many large moves within one frame, only its last position counts."""
    shown = opened(KINDS[kind](), IRB140)
    for name in shown.look().handles:
        shown.take(name)
        many = """(node, ways) => {
          const r = node.getBoundingClientRect(), x = r.x + r.width / 2, y = r.y + r.height / 2;
          for (const [dx, dy] of ways) node.dispatchEvent(new PointerEvent("pointermove",
            {pointerId: 1, clientX: x + dx, clientY: y + dy}));
        }"""
        x, y = shown.look().handles[name]["at"]
        shown.handle(name).evaluate(many, [[5 * i, -4 * i] for i in range(20)] + [[60, 25]])
        once = shown.look()
        shown.page.mouse.move(x + 60, y + 25)
        again = shown.look()
        gap = np.array(once.handles[name]["at"]) - again.handles[name]["at"]
        assert np.linalg.norm(gap) < 1.5, f"{name} is not at the last position"
        shown.page.mouse.up()
        shown.page.mouse.move(x + 200, y + 200)
        assert shown.look().code == again.code, f"{name} moves after its release"
        shown.press(name, "Home")


# --- Touch, keyboard and screen readers -----------------------------------------------------------


def test_touch_moves_a_handle_or_scrolls_the_page(browser, opened):
    context = browser.new_context(
        viewport={"width": 390, "height": 700}, has_touch=True, is_mobile=True
    )
    context.add_init_script(WATCH)
    for kind, name in (("joint", "q1"), ("target", "free"), ("target", "z"), ("motion", "via")):
        shown = opened(KINDS[kind](), IRB140, within=context)
        finger = context.new_cdp_session(shown.page)

        def touch(what, *at, finger=finger):
            points = [{"x": at[0], "y": at[1]}] if at else []
            finger.send("Input.dispatchTouchEvent", {"type": what, "touchPoints": points})

        def swipe(x, y, dx, dy, touch=touch):
            touch("touchStart", x, y)
            for i in range(1, 9):
                touch("touchMove", x + dx * i / 8, y + dy * i / 8)
            touch("touchEnd")

        shown.handle(name).focus()
        before = shown.look()
        x, y = before.handles[name]["at"]
        place = shown.handle(name).bounding_box()
        assert min(place["width"], place["height"]) > 43.9, "too small for a finger"
        swipe(x, y, -24, -40)
        after = shown.look()
        assert after.code != before.code and after.rows != before.rows
        assert shown.page.evaluate("scrollY") == 0, "the page scrolls under a handle"
        way = np.subtract(after.handles[name]["at"], before.handles[name]["at"])
        assert np.linalg.norm(way) > 8 or kind == "joint"
        swipe(100, 640, 0, -200)
        shown.page.wait_for_function("scrollY > 50")
        assert shown.look().code == after.code, "scrolling moves a handle"
    context.close()


@pytest.mark.parametrize("kind", KINDS)
def test_keyboard_reaches_and_moves_every_handle(opened, kind):
    shown = opened(KINDS[kind](), IRB140)
    page, start = shown.page, shown.look()
    controls = shown.rk.locator("button:visible, input, select, summary, .rk-scene")
    count, names = controls.count(), []
    for control in controls.all():
        assert control.get_attribute("data-lm-suppress-shortcuts") == "true"
    reached = set()
    controls.first.focus()
    for _ in range(count + 2):
        k = controls.evaluate_all("all => all.indexOf(document.activeElement)")
        reached.add(k)
        page.keyboard.press("Tab")
    assert reached - {-1} == set(range(count)) and count > 12
    session = page.context.new_cdp_session(page)
    tree = session.send("Accessibility.getFullAXTree")["nodes"]
    roles = {
        "button",
        "slider",
        "spinbutton",
        "combobox",
        "checkbox",
        "image",
        "DisclosureTriangle",
    }
    for node in tree:
        if not node["ignored"] and node.get("role", {}).get("value") in roles:
            names.append((node["role"]["value"], node["name"]["value"]))
    assert len(names) >= count and all(name.strip() for _, name in names)
    assert len(set(names)) == len(names), "two controls have the same name"
    assert (
        shown.rk.locator("[role=status]").count() == 1 and shown.rk.get_attribute("role") == "group"
    )
    assert shown.rk.locator(".rk-scene").get_attribute("aria-label").endswith("Home resets it.")

    for name, handle in start.handles.items():
        says, value = handle["name"].split(", ", 1)
        assert re.search(r"joint \d|target|start|via|goal", says) and re.search(r"\d", value)
        steps = []
        for key in ("ArrowRight", "Shift+ArrowRight", "ArrowUp"):
            shown.press(name, key)
            now = shown.look()
            assert now.code != start.code, f"{name}: {key} does nothing"
            assert now.handles[name]["name"] != handle["name"], (
                "the name does not contain the new value"
            )
            steps.append(np.array([now.boxes[k] - start.boxes[k] for k in start.boxes]))
            if "turn" not in name:
                assert now.pixels != start.pixels
            shown.press(name, "Home")
            assert shown.look().code == start.code, f"{name}: Home does not restore it"
        if "turn" not in name and kind != "motion":
            assert np.allclose(steps[1], 10 * steps[0], atol=0.6), (
                f"{name}: Shift does not multiply the step by ten"
            )

    scene = shown.rk.locator(".rk-scene")
    scene.press("ArrowLeft")
    turned = shown.look()
    assert turned.pixels != start.pixels and turned.code == start.code
    assert turned.handles != start.handles, "the handles do not move when the view turns"
    scene.press("Home")
    assert shown.look().pixels == start.pixels


def test_sliders_and_menus_have_names_and_value_texts(opened):
    for kind, sliders, menus in (
        ("joint", [f"q{i + 1}, °" for i in range(6)], []),
        ("target", ["x, mm", "y, mm", "z, mm", "roll, °", "pitch, °", "yaw, °"], ["branch"]),
        (
            "motion",
            ["via x, mm", "via y, mm", "via z, mm", "blend", "duration, s", "time"],
            ["time law", "corner", "branch", "large panel"],
        ),
    ):
        shown = opened(KINDS[kind](), IRB140)
        for name in sliders:
            assert shown.rk.get_by_role("slider", name=name, exact=True).count() == 1, name
        for name in menus:
            assert shown.rk.get_by_role("combobox", name=name, exact=True).count() == 1, name
    slider = shown.rk.get_by_role("slider", name="via x, mm", exact=True)
    before = shown.look()
    slider.press("ArrowRight")
    assert shown.look().rows != before.rows
    assert slider.get_attribute("aria-valuetext") == "651.0 mm"
    scara = opened(target_explorer(SCARA), SCARA)
    assert scara.rk.get_by_role("slider", name="angle, °", exact=True).count() == 1


def test_axes_can_be_switched_on_and_off(opened):
    for kind in ("joint", "target"):
        shown = opened(KINDS[kind](), IRB140)
        before = shown.look()
        box = shown.rk.get_by_role("checkbox", name="joint axes")
        assert box.is_checked() == (kind == "joint")
        box.click()
        drawn = shown.look()
        assert drawn.pixels != before.pixels and drawn.code == before.code
        box.click()
        assert shown.look().pixels == before.pixels


def test_ellipsoid_can_be_shown_for_a_free_or_a_held_tool(opened):
    q = np.array([0, 60, -170, 0, 40, 0]) * deg
    for shown in (
        opened(joint_explorer(PUMA560, q, singular=True), PUMA560),
        opened(target_explorer(PUMA560), PUMA560),
    ):
        before = shown.look()
        q = np.array(shown.code(before)["q"])
        free = np.linalg.svd(PUMA560.jacobian(q)[:3], compute_uv=False)
        held = np.linalg.norm(velocity_ellipsoid(PUMA560, q), axis=-2)
        pictures = [before.pixels]
        for k, speeds in ((1, free), (2, held)):
            shown.choose("ellipsoid", k)
            seen = shown.look()
            told = re.search(r"Semi-axes: (.*), (.*), (.*) mm/s\.$", seen.says).groups()
            assert [float(x) * mm for x in told] == pytest.approx(speeds, abs=0.51 * mm)
            assert seen.code == before.code
            pictures.append(seen.pixels)
        assert len(set(map(tuple, pictures))) == 3, "two ellipsoids look the same"
        shown.choose("ellipsoid", 0)
        assert shown.look().pixels == before.pixels and shown.look().says == before.says


def test_ghost_postures_show_all_joints(opened):
    shown = opened(target_explorer(LEVERS), LEVERS)
    shown.press("free", "ArrowUp")
    lines = shown.page.evaluate(
        """() => new Promise(done => {
          const pen = CanvasRenderingContext2D.prototype, {moveTo, lineTo, stroke} = pen, all = [];
          let line = [];
          pen.moveTo = function (x, y) { line = [[x, y]]; return moveTo.call(this, x, y); };
          pen.lineTo = function (x, y) { line.push([x, y]); return lineTo.call(this, x, y); };
          pen.stroke = function (...a) {
            if (this.getLineDash().join() === "3,7") all.push(line);  // the previous posture
            return stroke.apply(this, a);
          };
          document.querySelector("[data-handle=free]").dispatchEvent(
            new KeyboardEvent("keydown", {key: "ArrowUp", bubbles: true}));
          requestAnimationFrame(() => requestAnimationFrame(() => done(all)));
        })"""
    )
    [line] = [np.array(line) for line in lines]
    lengths = np.linalg.norm(np.diff(line, axis=0), axis=1)
    lengths = lengths[lengths > 1]
    assert len(lengths) == 3 and np.ptp(lengths) < 0.01, (
        "the ghost does not show three equal levers"
    )


def test_arm_fills_the_scene_when_the_page_opens(opened):
    for make in (joint_explorer, target_explorer):
        for arm in (IRB140, SCARA, PUMA560):
            shown = opened(make(arm), arm)
            frame = shown.rk.locator("canvas").first.bounding_box()
            q = np.array(shown.data["q"])
            points = project(arm_points(arm, q), shown.data["scene"]["view"])
            seen = project(np.array(shown.data["scene"]["seen"]), shown.data["scene"]["view"])
            scale = np.min((frame["width"] - 40, frame["height"] - 54) / np.ptp(seen, axis=0))
            share = scale * np.ptp(points, axis=0) / (frame["width"], frame["height"])
            assert share.max() > 0.45, (make.__name__, arm.name, share)


def pixels(shown, points):
    """The places of points (..., 3) on the page, for a scene that has not zoomed out."""
    scene, box = shown.data["scene"], shown.rk.locator("canvas").first.bounding_box()
    seen = np.array(scene["seen"])
    if scene["flat"] is None:
        seen = np.concatenate([seen, [[x, y, scene["floor"][0][2]] for x, y, _ in seen]])
    flat, room = project(seen, scene["view"]), np.array([box["width"] - 40, box["height"] - 54])
    low, high = flat.min(axis=0), flat.max(axis=0)
    way = (project(points, scene["view"]) - (low + high) / 2) * (room / (high - low)).min()
    return [box["x"] + 20, box["y"] + 28] + room / 2 + way * [1, -1]


def axes_on_the_page(shown, arm, q):
    """The ends (n, 2, 2) of the drawn axes of the joints on the page. They must be the ends in
    space, seen by one camera, whatever its scale is.
    """
    scene, canvas = shown.data["scene"], shown.rk.locator("canvas").first
    lines = canvas.evaluate("canvas => canvas.lines")
    drawn = np.array([line["points"] for line in lines if line["dash"] == [7, 3, 1.5, 3]])
    joints = [arm.frames(q)[i] @ link.before for i, link in enumerate(arm.links)]
    half = 0.22 * scene["size"]
    ends = [
        joint @ (np.array([[-half], [half]]) * link.axis)
        for joint, link in zip(joints, arm.links, strict=True)
    ]
    flat = project(np.array(ends), scene["view"]) * [1, -1]
    middles = drawn.mean(axis=(0, 1)), flat.mean(axis=(0, 1))
    about = flat - middles[1]
    scale = np.sum(about * (drawn - middles[0])) / np.sum(about**2)
    assert drawn == pytest.approx(middles[0] + scale * about, abs=0.1)
    box = canvas.bounding_box()
    return drawn + [box["x"], box["y"]]


@pytest.mark.parametrize("touched", [False, True], ids=["mouse", "touch"])
def test_rings_and_the_axes_of_the_flange_are_inside_the_picture(browser, opened, touched):
    options = {"viewport": {"width": 1000, "height": 900}}
    if touched:
        options = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
    context = browser.new_context(**options)
    context.add_init_script(WATCH)
    context.add_init_script(LINES)
    for arm in (PUMA560, SCARA, UR5):
        shown = opened(joint_explorer(arm), arm, within=context)
        canvas = shown.rk.locator("canvas").first
        box, n = canvas.bounding_box(), len(arm.links)
        rings = sum(
            not link.prismatic for link in arm.links[: (n + 1) // 2 if touched and n > 4 else n]
        )
        for i, control in enumerate(shown.data["controls"]):
            for value in (control["low"], control["high"]):
                shown.type(f"q{i + 1}", value)
                scale = box["y"] + box["height"] - 20  # the top of "grid 100 mm"
                for each in shown.look().handles.values():
                    assert each["at"][1] + (22 if touched else 13) < scale + 0.1, each
                lines = canvas.evaluate("canvas => canvas.lines")
                lines = [
                    np.array(line["points"])
                    for line in lines
                    if len(line["points"]) == 49 or line["width"] == 3 and len(line["points"]) == 2
                ]
                assert sum(len(line) == 49 for line in lines) == rings
                assert sum(len(line) == 2 for line in lines) >= 3
                points = np.concatenate(lines)
                assert points.min() > 0, (arm.name, i + 1, value)
                assert (points < [box["width"], box["height"]]).all(), (arm.name, i + 1, value)
    context.close()


def test_directions_of_the_base_are_never_below_a_handle(context, opened):
    context.add_init_script(RECORD)
    heights = set()
    for arm in (IRB140, SCARA):
        shown = opened(target_explorer(arm), arm)
        middle = shown.rk.locator("canvas").first.bounding_box()["height"] / 2
        for place in itertools.product((0, 300, 600, 900), (-600, -300, 0, 300), (0, 200)):
            for name, value in zip("xyz", place, strict=True):
                shown.type(name, value)
            shown.look()
            canvas = shown.page.evaluate("canvasWords()")[0]
            letters = [w["box"] for w in canvas["words"] if w["text"] in "xyz" and w["size"] == 10]
            assert 2 <= len(letters) <= 3
            for (x, y, w, h), box in itertools.product(letters, canvas["handles"]):
                left, top, wide, high = box
                across = left + 2 < x + w and x < left + wide - 2
                assert not (across and top + 2 < y + h and y < top + high - 2), (place, box)
            heights.add(letters[0][1] < middle)
    assert heights == {True, False}, "no handle came to the lower right, or all did"


@pytest.mark.parametrize("touched", [False, True], ids=["mouse", "touch"])
def test_rings_are_at_the_axes_of_their_joints_and_do_not_overlap(browser, opened, touched):
    size, reach, apart = (44, 84, 39) if touched else (26, 60, 24)
    options = {"has_touch": True, "is_mobile": True} if touched else {}
    context = browser.new_context(viewport={"width": 1000, "height": 900}, **options)
    context.add_init_script(WATCH)
    context.add_init_script(LINES)
    bent = np.array([20, 30, -40, 50, 60, 40]) * deg
    for arm, q in (
        (IRB140, None),
        (IRB140, np.zeros(6)),
        (PUMA560, None),
        (PUMA560, bent),
        (ITMO6R, bent),
        (UR5, None),
        (SCARA, None),
    ):
        shown = opened(joint_explorer(arm, q), arm, within=context)
        q = np.array(shown.data["q"])
        places = np.array([shown.look().handles[f"q{i + 1}"]["at"] for i in range(len(q))])
        box = shown.handle("q1").bounding_box()
        assert min(box["width"], box["height"]) > size - 0.01
        between = np.linalg.norm(places[:, None] - places, axis=-1)
        assert between[np.triu_indices(len(q), 1)].min() > apart, arm.name
        for i, (here, there) in enumerate(axes_on_the_page(shown, arm, q)):
            way = (there - here) / np.linalg.norm(there - here)
            off = places[i] - (here + there) / 2
            # the handle is on the ring, and its neighbours may push it aside by half of their size
            assert abs(np.linalg.det([way, off])) < 0.5 * reach + size / 2, (arm.name, i + 1)
            assert np.linalg.norm(off) < 0.85 * reach + size / 2, (arm.name, i + 1)
    context.close()


@named(POSES)
def test_handles_of_a_via_point_at_the_edge_of_the_scene_do_not_overlap(opened, arm):
    shown = opened(motion_explorer(arm, *POSES[arm]), arm)
    most = shown.data["controls"][0]["high"]
    for ends in itertools.product((-most, most), repeat=3):
        for letter, value in zip("xyz", ends, strict=True):
            shown.type(f"via {letter}", value)
        handles = shown.look().handles
        places = np.array([each["at"] for each in handles.values()])
        between = np.linalg.norm(places[:, None] - places, axis=-1)
        assert len(handles) == 6
        assert between[np.triu_indices(6, 1)].min() > 24, (ends, handles)


def test_sentence_about_the_stroke_goes_where_lab_05_says(opened):
    """At the heights and the blend that the lab states, joint 4 is inside its limits. A little
    lower, or with a little less blend, it is not.
    """
    places = [(0.2, 0.3, 0.12), (0.4, 0.1, 0), (0.2, -0.2, 0.2)]
    stations = ScaraPose(places, np.array([0, 180, 90]) * deg)
    shown = opened(motion_explorer(SCARA, *stations, law="linear", duration=20), SCARA)
    for blend_, height, past in (
        (0, 40.1, True),
        (0, 40.2, False),
        (0.1, 28.23, True),
        (0.1, 28.24, False),
        (0.267, 0, True),
        (0.268, 0, False),
    ):
        shown.type("blend", blend_)
        shown.type("via z", height)
        seen = shown.look()
        says, accelerations = seen.says, seen.rows[1][1:]
        assert ("q4 exceeds its limit" in says) == past, (blend_, height, says)
        # where the speeds of all joints jump, no acceleration is told
        assert [each == "\N{EN DASH}" for each in accelerations] == [blend_ == 0] * 4
    assert "The path passes 68.0 mm from via." in says


def test_wrist_centre_is_marked_and_does_not_move_while_the_wrist_turns(opened):
    q = np.array([20, 70, -50, 30, 60, 40]) * deg
    shown = opened(joint_explorer(ITMO6R, q, wrist=True), ITMO6R)
    arcs = """() => new Promise(done => {
      const pen = CanvasRenderingContext2D.prototype, {arc} = pen, all = [];
      pen.arc = function (x, y, r, ...more) {
        if (r === 3.5) all.push([x, y]);
        return arc.call(this, x, y, r, ...more);
      };
      document.querySelector("[data-handle=q4]").dispatchEvent(
        new KeyboardEvent("keydown", {key: "ArrowUp", bubbles: true}));
      requestAnimationFrame(() => requestAnimationFrame(() => { pen.arc = arc; done(all); }));
    })"""
    box, wanted = shown.rk.locator("canvas").first.bounding_box(), None
    for q4, q5, q6 in ((30, 60, 40), (-170, 60, 40), (90, 100, 40), (0, 0, -170)):
        for name, value in (("q4", q4), ("q5", q5), ("q6", q6)):
            shown.type(name, value)
        assert "wrist centre" in shown.look().words[0].split("|")
        [mark] = shown.page.evaluate(arcs)
        q[3:] = np.array([q4, q5, q6]) * deg
        # 004, table: the flange is 200 mm from the wrist centre, along its z axis
        centre = ITMO6R.fk(q) @ np.array([0, 0, -200 * mm])
        wanted = pixels(shown, centre)
        assert np.array(mark) + [box["x"], box["y"]] == pytest.approx(wanted, abs=0.5)
    points = pixels(shown, arm_points(ITMO6R, np.array(shown.data["q"])))
    assert np.ptp(points[:, 1]) > 0.5 * box["height"]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_serious_problems(browser, opened, scheme):
    context = browser.new_context(color_scheme=scheme)
    context.add_init_script(WATCH)
    q = np.linspace(0, 1, 41)[:, None] * np.array([0.5, 0.3, -0.4, 1, 1, 1])
    player = animate(IRB140, np.linspace(0, 2, 41), q, title="A turn of every joint")
    corner = motion_explorer(IRB140, START, VIA, GOAL, close_up=True)
    for output in (*(make() for make in KINDS.values()), corner, player):
        shown = opened(output, IRB140, within=context)
        shown.rk.locator("canvas").first.wait_for()
        found = Axe().run(shown.page, context=".rk").response["violations"]
        serious = [
            (rule["id"], node["html"][:120], node.get("failureSummary", "")[:200])
            for rule in found
            for node in rule["nodes"]
            if rule["impact"] in ("serious", "critical")
        ]
        assert serious == []
    context.close()


def test_axe_detects_a_planted_problem(opened):
    shown = opened(KINDS["joint"](), IRB140)
    # a button of its own: the view gives its own buttons their names again when it is drawn
    shown.rk.evaluate("node => node.append(document.createElement('button'))")
    found = Axe().run(shown.page, context=".rk").response["violations"]
    assert "button-name" in {rule["id"] for rule in found}


# --- Copied code, memory use, size on the page ----------------------------------------------------


def test_copied_python_lines_run(browser, opened, tmp_path):
    context = browser.new_context(permissions=["clipboard-read", "clipboard-write"])
    page = watched(context.new_page())
    for make, wanted in (
        (KINDS["joint"], "IRB140.fk(q)"),
        (KINDS["target"], "IRB140.ik(target)"),
        (lambda: target_explorer(SCARA), "SCARA.ik(target)"),
        (lambda: target_explorer(ELBOW), "arm.ik(target)"),
        (KINDS["motion"], "robokin.blend(start, via, goal"),
    ):
        make().save(tmp_path / "page.html")
        page.goto((tmp_path / "page.html").as_uri())
        page.get_by_role("button", name="Copy as Python").click()
        page.get_by_role("button", name="Copied").wait_for()
        text = page.evaluate("navigator.clipboard.readText()")
        assert wanted in text
        space = {"arm": ELBOW} if "# arm: " in text else {}
        exec(text, space)
        assert np.isfinite(space["q"]).all()
    page.get_by_role("button", name="Copy as Python").wait_for()
    assert page.errors == []
    context.close()


@pytest.mark.parametrize("kind", KINDS)
def test_thousands_of_moves_do_not_leak_memory(opened, kind):
    shown, heap = opened(KINDS[kind](), IRB140), []
    name = {"joint": "q2", "target": "free", "motion": "via"}[kind]
    walk = """(node, count) => new Promise(done => {
      const r = node.getBoundingClientRect(), x = r.x + r.width / 2, y = r.y + r.height / 2;
      let i = 0;
      const go = () => {
        for (let k = 0; k < 10; k++, i++) node.dispatchEvent(new PointerEvent("pointermove",
          {pointerId: 1, clientX: x + 40 * Math.sin(i / 9), clientY: y + 25 * Math.cos(i / 7)}));
        if (i < count) requestAnimationFrame(go); else done();
      };
      go();
    })"""
    start = shown.look()
    for moves in (100, 1000, 1000, 1000):  # the first 100 are a warm-up
        shown.take(name)
        shown.handle(name).evaluate(walk, moves)
        shown.page.mouse.up()
        shown.press(name, "Home")
        heap.append(_heap(shown.page))
    assert shown.look().boxes == start.boxes
    # a leak grows with every thousand moves, but uncollected garbage does not
    assert min(heap[2:]) - heap[0] < 2, f"{heap} MB"


def _heap(page):
    """Megabytes of JavaScript in use after garbage collection."""
    session = page.context.new_cdp_session(page)
    for _ in range(3):  # the collection of one object can make others collectable
        session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"] / 1e6
    session.detach()
    return used


ROOM = """rk => {
  const box = e => e.getBoundingClientRect(), over = e => e.scrollWidth - e.clientWidth;
  const all = what => [...rk.querySelectorAll(what)], root = document.documentElement;
  const bottoms = all(".rk-scene, input[type=range]").map(e => box(e).bottom);
  const [scene, side] = [".rk-space", ".rk-side"].map(what => box(rk.querySelector(what)));
  const wide = all("*").filter(e => over(e) > 1 && e.clientWidth
    && !e.closest(".rk-table, .rk-handles, input, select")).map(e => e.className || e.tagName);
  return {low: Math.max(...bottoms) - box(rk).top, wide, stacked: side.top >= scene.bottom - 1,
          out: over(rk), page: root.scrollWidth - innerWidth, table: over(all(".rk-table")[0])};
}"""


@pytest.mark.parametrize(
    "width, height, scale", [(1366, 768, 1), (900, 900, 1), (683, 384, 2), (390, 844, 2)]
)
def test_scene_and_sliders_fit_into_narrow_and_wide_pages(browser, opened, width, height, scale):
    """(683, 384, 2) is a screen of 1366 x 768 at 200 % zoom."""
    context = browser.new_context(
        viewport={"width": width, "height": height}, device_scale_factor=scale
    )
    context.add_init_script(WATCH)
    for make in (*KINDS.values(), lambda: target_explorer(SCARA), lambda: joint_explorer(FLAT)):
        shown = opened(make(), IRB140, within=context)
        shown.look()
        room = shown.rk.evaluate(ROOM)
        assert room["out"] <= 0 and room["page"] <= 0 and room["wide"] == [], room
        assert room["stacked"] == (width == 390), room
        if width > 390:
            assert room["low"] <= 600 and room["table"] <= 1, room
    context.close()


@pytest.mark.parametrize("kind", KINDS)
def test_printed_page_contains_the_picture(opened, kind):
    shown = opened(KINDS[kind](), IRB140)
    before = shown.look()
    shown.page.emulate_media(media="print", color_scheme="dark")
    seen = shown.look()
    assert shown.rk.locator(".rk-scene").is_visible() and min(seen.bytes) > 3000
    assert shown.rk.locator("table").is_visible() and seen.rows == before.rows
    # the handles have the names of joints, axes and points
    assert shown.rk.locator(".rk-handle:visible").count() == len(before.handles) > 2
    boxes = shown.rk.locator("input:visible")
    assert boxes.count() == shown.rk.locator(".rk-slide input[type=number]").count()
    assert all(box.get_attribute("type") == "number" for box in boxes.all())
    shown.page.emulate_media(media="screen", color_scheme="light")
    assert shown.look().pixels == before.pixels


# --- Errors for invalid calls ---------------------------------------------------------------------


def test_errors_for_invalid_calls_say_what_is_wanted():
    two = IRB140.fk(np.zeros((2, 6)))
    inverse = type("Unknown", (type(FLAT.geometry),), {})
    unknown = ClosedFormArm("unknown", inverse(0.3, 0.2, (0, 0)), FLAT.limits)
    for call, kind, words in (
        (lambda: joint_explorer("IRB-140"), TypeError, "arm: wanted an Arm"),
        (lambda: joint_explorer(IRB140, np.zeros(5)), ValueError, "q: wanted"),
        (lambda: joint_explorer(IRB140, singular=1), ValueError, "singular: wanted True or False"),
        (lambda: joint_explorer(IRB140, wrist=1), ValueError, "wrist: wanted True or False"),
        (lambda: joint_explorer(UR5, wrist=True), ValueError, "wrist: wanted an arm whose last"),
        (lambda: joint_explorer(SCARA, wrist=True), ValueError, "wrist: wanted an arm whose last"),
        (lambda: joint_explorer(LEVERS, wrist=True), ValueError, "wrist: wanted an arm whose"),
        (lambda: joint_explorer(IRB140, np.zeros((2, 6))), ValueError, "q: wanted one posture"),
        (lambda: target_explorer(3), TypeError, "arm: wanted a ClosedFormArm"),
        (lambda: target_explorer(unknown), TypeError, "arm: Unknown has no inverse for pages"),
        (lambda: target_explorer(IRB140, (1, 2, 3)), TypeError, "target: wanted a Transform"),
        (lambda: target_explorer(SCARA, VIA), TypeError, "target: wanted a ScaraPose"),
        (lambda: target_explorer(IRB140, two), ValueError, "target: wanted a single pose"),
        (
            lambda: target_explorer(IRB140, Transform(translation=(2, 0, 0))),
            ValueError,
            "target: wanted a pose in reach. Row 0 .* does not exist",
        ),
        (
            lambda: target_explorer(LEVERS, VIA),
            ValueError,
            "target: wanted None for an arm of",
        ),
        (lambda: motion_explorer(SCARA, START, VIA, GOAL), TypeError, "start: wanted a ScaraPose"),
        (lambda: motion_explorer(IRB140, START, VIA, (1, 2, 3)), TypeError, "goal: wanted"),
        (lambda: motion_explorer(IRB140, START, two, GOAL), ValueError, "via: wanted a single"),
        (lambda: motion_explorer(IRB140, START, VIA, GOAL, 8), ValueError, "row: wanted"),
        (lambda: motion_explorer(IRB140, START, VIA, GOAL, law="cubic"), ValueError, "law: wanted"),
        (lambda: motion_explorer(IRB140, START, VIA, GOAL, duration=0), ValueError, "duration: "),
        (lambda: motion_explorer(IRB140, START, VIA, GOAL, duration=21), ValueError, "to 20 s"),
    ):
        with pytest.raises(kind, match=words):
            call()


# --- Explorers in a notebook ----------------------------------------------------------------------

CELLS = {
    "joint": "joint_explorer(IRB140)",
    "target": "target_explorer(IRB140)",
    "motion": """\
start = Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.2))
via = Transform(Quaternion.from_angle_axis(45 * deg, (0, 1, 0)), (0.65, -0.1, 0.8))
goal = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.3, 0.3, 0.5))
motion_explorer(IRB140, start, via, goal)""",
    "scara": "scara = target_explorer(SCARA)\nscara",
    "elbow": "target_explorer(spbu_arm(500 * mm, 400 * mm))",
    "again": "scara",
}
FIRST = (
    "from robokin import IRB140, SCARA, Quaternion, Transform, deg, mm, spbu_arm\n"
    "from robokin.show import joint_explorer, motion_explorer, target_explorer"
)


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """A notebook with explorers, run and stored."""
    path = tmp_path_factory.mktemp("stored") / "explorers.ipynb"
    v4 = nbformat.v4
    cells = [v4.new_markdown_cell("# Explorers", id="title")]
    cells += [
        v4.new_code_cell(source, id=f"cell-{i}")
        for i, source in enumerate([FIRST, *CELLS.values()])
    ]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    nbformat.write(v4.new_notebook(cells=cells, metadata={"kernelspec": kernel}), path)
    subprocess.run(
        [sys.executable, ROOT / "tests" / "execute_notebooks.py", path],
        check=True,
        capture_output=True,
    )
    return path


def test_stored_output_contains_text_that_nbval_compares(stored, tmp_path):
    once = stored.read_bytes()
    notebook = nbformat.reads(once.decode(), as_version=4)
    assert set(notebook.metadata) == {"kernelspec", "language_info"}
    for cell in notebook.cells[2:]:
        [output] = cell.outputs
        assert set(output.data) == {"text/html", "text/plain"}
        html, words = output.data["text/html"], output.data["text/plain"]
        assert re.match(
            r'<div class="robokin-player" data-player="\w+"><img alt="[^"]{40,}" [^>]*'
            rf'src="data:image/png;base64,[^"]+"><p>{re.escape(STILL)}</p></div>\n',
            html,
        )
        assert len(words) > 60 and re.search(r"\d", words)
    assert b"model_id" not in once and b"widget-view" not in once
    assert len(once) < 800_000
    path = tmp_path / "explorers.ipynb"

    def nbval(content):
        path.write_bytes(content)
        rules = ROOT / "tests" / "nbval_sanitize.cfg"
        options = ["-p", "no:cacheprovider", "--override-ini", "addopts=", "--nbval"]
        options += ["--nbval-current-env", "--nbval-sanitize-with", rules]
        command = [sys.executable, "-m", "pytest", *options, path]
        return subprocess.run(command, cwd=tmp_path, text=True, capture_output=True)

    run = nbval(once)
    assert run.returncode == 0, run.stdout[-3000:]
    changed = once.replace(b"8 of 8 branches are usable", b"7 of 8 branches are usable")
    assert changed != once and nbval(changed).returncode != 0, "nbval does not compare the text"


def test_explorers_of_a_trusted_notebook_work_without_a_kernel_in_every_theme(
    jupyter, page, stored
):
    name = _copied(jupyter, stored, "trusted explorers")
    jupyter.trust(name)
    jupyter.open(page, name)
    cells = page.locator(".jp-CodeCell")
    shown = {}
    for i, kind in enumerate(CELLS, 1):
        cells.nth(i).scroll_into_view_if_needed()
        cells.nth(i).locator(".rk canvas").first.wait_for()
        assert cells.nth(i).locator("img").count() == 0, "the still picture was not removed"
        shown[kind] = cells.nth(i).locator(".rk")
    rk = shown["target"]
    rk.scroll_into_view_if_needed()
    before = rk.evaluate(READ)
    x, y = before["handles"]["free"]["at"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 20, y - 10, steps=3)
    page.mouse.up()
    dragged = rk.evaluate(READ)
    assert dragged["rows"] != before["rows"] and dragged["pixels"] != before["pixels"]
    active = (
        "() => [...document.querySelectorAll('.jp-Cell')]"
        ".findIndex(e => e.matches('.jp-mod-active'))"
    )
    cell = page.evaluate(active)
    rk.locator("[data-handle=z]").press("ArrowDown")
    rk.get_by_role("slider", name="x, mm", exact=True).press("ArrowUp")
    moved = rk.evaluate(READ)
    assert moved["rows"] != dragged["rows"] and page.evaluate(active) == cell
    again, scara = shown["again"], shown["scara"]
    other = scara.evaluate(READ)
    again.locator("[data-handle=free]").press("ArrowLeft")
    assert again.evaluate(READ)["rows"] != other["rows"]
    assert scara.evaluate(READ)["rows"] == other["rows"], (
        "a view moves another view of the same object"
    )

    rk = shown["motion"]
    rk.scroll_into_view_if_needed()
    pictures = {True: set(), False: set()}
    for k in range(20):
        light = bool(k % 2)
        if k % 4 < 2:  # only sometimes use JupyterLab's menu, which is slow
            page.get_by_role("menuitem", name="Settings", exact=True).click()
            menu = page.locator(".lm-Menu-item")
            menu.filter(has_text=re.compile(r"^Theme$")).click()
            menu.filter(has_text=f"JupyterLab {'Light' if light else 'Dark'}").first.click()
        else:
            page.evaluate("x => { document.body.dataset.jpThemeLight = x; }", str(light).lower())
        until(
            lambda light=light: (
                page.evaluate("document.body.dataset.jpThemeLight") == str(light).lower()
            ),
            "the theme does not change",
            page,
        )
        seen = rk.evaluate(READ)
        assert min(seen["bytes"]) > 3000, f"blank after {k + 1} changes of the theme"
        pictures[light].add(tuple(seen["pixels"]))
    for dark, bright in itertools.product(pictures[False], pictures[True]):
        assert all(a != b for a, b in zip(dark, bright, strict=True)), (
            "a canvas keeps its old colours"
        )
    assert page.outside == [] and page.errors == []


def test_untrusted_notebook_shows_still_pictures_and_instructions(jupyter, page, stored):
    jupyter.open(page, _copied(jupyter, stored, "untrusted explorers"))
    for cell in page.locator(".jp-CodeCell").all()[1:]:
        cell.scroll_into_view_if_needed()
        image = cell.locator("img[alt]")
        image.wait_for()
        assert image.is_visible() and image.evaluate("image => image.naturalWidth") > 300
        assert cell.get_by_text(STILL).is_visible()
    assert page.locator(".rk, canvas").count() == 0 and page.errors == []


def _copied(jupyter, stored, title):
    """A copy of the notebook with another title, and therefore with its own signature."""
    name = f"{title.replace(' ', '_')}.ipynb"
    text = stored.read_text(encoding="utf-8").replace("# Explorers", f"# {title}")
    (jupyter.labs / name).write_text(text, encoding="utf-8")
    return name
