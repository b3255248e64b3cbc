"""Explorers: what they answer, how they stand being dragged from several threads, what a notebook
stores of them, and that they work in a real browser with a real kernel.

ROBOKIN_MOVES=1000 makes the walk over all sliders in the browser longer than the 60 moves of the
suite.
"""

import os
import random
import re
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import nbformat
import numpy as np
import psutil
import pytest
import test_browser
from conftest import ROOT, until
from scipy.spatial.transform import Rotation
from test_player import unpacked

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
    mm,
    quintic,
    spbu_arm,
    three_lever,
    within,
)
from robokin.show import joint_explorer, motion_explorer, target_explorer
from robokin.show.live import RUN

page = test_browser.page
MOVES = int(os.environ.get("ROBOKIN_MOVES", 60))
ELBOW = spbu_arm(500 * mm, 400 * mm)
ARMS = (IRB140, PUMA560, ITMO6R, SCARA, ELBOW)
START = Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.2))
VIA = Transform(Quaternion.from_angle_axis(45 * deg, (0, 1, 0)), (0.65, -0.1, 0.8))
GOAL = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.3, 0.3, 0.5))
POSES = {
    "IRB-140": (START, VIA, GOAL),
    "SCARA": (
        ScaraPose((0.3, 0.1, 0.1), 0),
        ScaraPose((0.25, -0.2, 0.15), 1),
        ScaraPose((0.1, -0.3, 0.05), 2),
    ),
    ELBOW.name: tuple(
        Transform(translation=p) for p in ((0.5, 0.2, 0.3), (0.4, -0.1, 0.6), (0.3, -0.4, 0.2))
    ),
}


@pytest.fixture(params=ARMS, ids=lambda arm: arm.name)
def arm(request):
    return request.param


# --- Numbers --------------------------------------------------------------------------------------


def test_joint_explorer_tells_the_flange(arm):
    explorer, rng = joint_explorer(arm), np.random.default_rng(3)
    for _ in range(5):
        for name, control in explorer.controls.items():
            low, high = arm.limits[int(name[1:]) - 1]
            control.value = round(rng.uniform(control.min, control.max))
            assert low - 1e-9 <= explorer.q[int(name[1:]) - 1] <= high + 1e-9
        picture, pose = _picture(explorer), arm.fk(explorer.q)
        assert np.array_equal(picture.q, explorer.q)
        xyz, rpy, wxyz = picture.numbers[:3] * mm, picture.numbers[3:6] * deg, picture.numbers[6:10]
        assert np.allclose(xyz, pose.translation, atol=1e-12)
        for matrix in (
            Rotation.from_euler("xyz", rpy),
            Rotation.from_quat(wxyz, scalar_first=True),
        ):
            assert np.allclose(matrix.as_matrix(), pose.rotation.as_matrix(), atol=1e-9)
        assert picture.numbers[10] == pytest.approx(
            float(distance_from_singularity(arm, explorer.q))
        )


def test_joint_explorer_names_singularities():
    explorer = joint_explorer(IRB140)
    assert _picture(explorer).says == "Singular: wrist singularity."
    explorer.controls["q5"].value = 30
    assert _picture(explorer).says == "Not singular."


# --- Every branch with its verdict ----------------------------------------------------------------


def test_every_branch_of_the_target_is_there(arm):
    explorer, rng = target_explorer(arm), random.Random(4)
    seen = set()
    for name in [
        *rng.choices([name for name in explorer.controls if name != "branch"], k=60),
        *"xyz",
    ]:
        control, last, share = explorer.controls[name], explorer.q, 0.6 if name in "xyz" else 1
        control.value = (
            control.max
            if "usable" in seen and name in "xyz" and rng.random() < 0.2
            else share * rng.uniform(control.min, control.max)
        )
        picture, rows = _picture(explorer), arm.ik(_target(explorer, arm))
        shown = picture.rows.reshape(rows.shape)
        assert _same(arm, shown, rows)
        exists, inside = ~np.isnan(rows[:, 0]), within(arm, rows)
        assert np.array_equal(picture.past.reshape(rows.shape) > 0, exists[:, None] & ~inside)
        usable = exists & inside.all(axis=-1)
        assert (
            within(arm, shown)[usable]
            & (shown[usable] >= arm.limits[:, 0] - 1e-6)
            & (shown[usable] <= arm.limits[:, 1] + 1e-6)
        ).all(), "a usable row is shown inside its limits"
        assert [verdict.startswith("usable") for verdict in picture.verdicts] == usable.tolist()
        assert ["does not exist" in verdict for verdict in picture.verdicts] == (~exists).tolist()
        unit = 1 if arm.prismatic.any() else deg
        assert np.allclose(picture.travel * unit, abs(shown - last).sum(axis=-1), equal_nan=True)
        if exists.any():
            among = usable if usable.any() else exists
            assert among[picture.chosen]
            assert picture.travel[picture.chosen] == pytest.approx(picture.travel[among].min())
            assert np.array_equal(picture.q, shown[picture.chosen])
        else:
            assert picture.faded and picture.chosen == -1 and np.array_equal(picture.q, last)
        assert ("No branch is usable" in picture.says) == (not usable.any())
        seen |= {"none" if not exists.any() else "past" if not usable.any() else "usable"}
    assert {"none", "usable"} <= seen


def test_a_branch_stays_chosen_and_its_reason_is_given():
    explorer = target_explorer(IRB140)
    menu = explorer.controls["branch"]
    menu.value = menu.options[7]  # behind "nearest"
    assert _picture(explorer).chosen == 6
    explorer.controls["z"].value = 1250
    picture = _picture(explorer)
    assert (
        picture.faded
        and picture.says == f"No branch is usable. {explain(IRB140, _target(explorer, IRB140), 6)}"
    )
    assert "beyond the stretched arm" in picture.says


def test_a_joint_past_its_limit_is_shown_where_it_is_least_past_it():
    """Lab 02: q3 at 59.5°, 9.5 past, was shown as -300.5°, 70 past, after a drag through -229°."""
    explorer = target_explorer(IRB140)
    pose = IRB140.fk(np.array([30, 10, 59.5, 20, 30, 40]) * deg)
    turns = np.array(pose.rotation.as_roll_pitch_yaw()) / deg
    values = dict(zip(("y", "z"), pose.translation[1:] / mm, strict=True))
    for name, value in (values | dict(zip(("roll", "pitch", "yaw"), turns, strict=True))).items():
        explorer.controls[name].value = value
    shown = []
    for last in (0, -229, 49, -300):  # wherever the joint was before
        explorer.controls["x"].value = 0
        explorer.q = np.array([30, 10, last, 20, 30, 40]) * deg
        explorer.controls["x"].value = pose.translation[0] / mm
        picture = _picture(explorer)
        rows, past = (np.reshape(x, (8, 6)) for x in (picture.rows, picture.past))
        shown.append(np.where(past, rows, 0))
        row = np.nanargmin(abs(rows[:, 2] / deg - 59.5))
        assert rows[row, 2] == pytest.approx(59.5 * deg) and past[row, 2]
        assert picture.verdicts[row] == "past limit: q3"
    assert all(np.allclose(one, shown[0], equal_nan=True) for one in shown)


def test_every_joint_past_its_limit_is_as_little_past_it_as_it_can(arm):
    explorer, rng = target_explorer(arm), random.Random(6)
    low, high = arm.limits.T
    seen = 0
    for name in rng.choices([name for name in explorer.controls if name != "branch"], k=40):
        control = explorer.controls[name]
        control.value = 0.6 * rng.uniform(control.min, control.max)
        picture = _picture(explorer)
        rows, past = (np.reshape(x, (-1, len(low))) for x in (picture.rows, picture.past))
        for k, j in np.argwhere(past > 0):
            turns = [0] if arm.prismatic[j] else 2 * np.pi * np.arange(-3, 4)
            least = min(max(low[j] - v, v - high[j]) for v in rows[k, j] + np.array(turns))
            assert max(low[j] - rows[k, j], rows[k, j] - high[j]) == pytest.approx(least)
            seen += 1
    assert seen or arm in (ELBOW, ITMO6R)


def test_lab_07_at_x_zero():
    """There q5 was shown as 259.8° where -100.2° is 0.2 past its limit."""
    explorer = target_explorer(PUMA560)
    for x in (600, 0, -600, 0):
        explorer.controls["x"].value = x
    rows = np.reshape(_picture(explorer).rows, (8, 6)) / deg
    assert np.abs(rows[:, 4]).max() == pytest.approx(100.2, abs=0.05)
    assert "q5" in _picture(explorer).verdicts[4] and "q5" in _picture(explorer).verdicts[5]


# --- Motions --------------------------------------------------------------------------------------


@pytest.mark.parametrize("arm", [IRB140, SCARA, ELBOW], ids=lambda arm: arm.name)
def test_the_motion_passes_where_the_sliders_say(arm):
    start, via, goal = POSES[arm.name]
    explorer = motion_explorer(arm, start, via, goal)
    c = explorer.controls
    c["via x"].value += 20
    c["blend"].value, c["duration"].value, c["corner"].value = 0.25, 8, "quintic (C2)"
    moved = via.position if isinstance(via, ScaraPose) else via.translation
    moved = moved + [20 * mm, 0, 0]
    via = (
        ScaraPose(moved, via.angle)
        if isinstance(via, ScaraPose)
        else Transform(via.rotation, moved)
    )
    law = quintic(8)
    poses = blend(start, via, goal, 0.25, law(explorer.t), corner="quintic")
    place = poses.position if isinstance(poses, ScaraPose) else poses.translation
    assert explorer.t[-1] == 8 and np.allclose(arm.fk(explorer.q).translation, place, atol=1e-9)
    page = _picture(explorer).page["arms"][0]
    speed = abs(differentiate(explorer.q, explorer.t)).max(axis=0) / np.where(
        arm.prismatic, mm, deg
    )
    assert np.allclose(page["speed"][0], speed, atol=0.051)
    [whole] = unpacked(page["motion"][0], len(arm.links), len(_picture(explorer).page["times"]))
    assert np.allclose(
        whole[[0, -1]] * np.where(arm.prismatic, mm, deg), explorer.q[[0, -1]], atol=0.01
    )


def test_a_via_point_out_of_reach_leaves_a_gap_and_says_so():
    explorer = motion_explorer(IRB140, START, VIA, GOAL)
    explorer.controls["via x"].value = 1250
    notes = " ".join(_picture(explorer).page["arms"][0]["notes"]["0"])
    assert (
        np.isnan(explorer.q).any()
        and f"No solution in {int(np.isnan(explorer.q[:, 0]).sum())} of 241" in notes
    )


# --- Threads, closing, wrong calls ----------------------------------------------------------------


def test_the_last_value_wins_whatever_threads_set_the_sliders(monkeypatch):
    explorer, answers = target_explorer(IRB140), []
    answer = type(explorer)._answer

    def slow(self):
        answers.append(1)
        time.sleep(0.003)
        return answer(self)

    monkeypatch.setattr(type(explorer), "_answer", slow)

    def drag(name):
        for value in range(100, 160):
            explorer.controls[name].value = value

    threads = [
        threading.Thread(target=drag, args=(name,))
        for name in ("x", "y", "z", "roll", "pitch", "yaw")
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) < 300, "stale requests are dropped"
    assert [explorer.controls[name].value for name in ("x", "roll")] == [159, 159]
    assert _same(
        IRB140, _picture(explorer).rows.reshape(8, 6), IRB140.ik(_target(explorer, IRB140))
    )


@pytest.mark.parametrize(
    "make",
    [
        lambda: joint_explorer(IRB140),
        lambda: target_explorer(SCARA),
        lambda: motion_explorer(IRB140, START, VIA, GOAL),
    ],
)
def test_a_closed_explorer_raises_nothing(make):
    explorer = make()
    explorer.close()
    name = next(iter(explorer.controls))
    explorer.controls[name].value += 1
    explorer.close()
    assert all(control.comm is None for control in explorer.controls.values())


def test_wrong_calls_say_what_is_wanted():
    two = IRB140.fk(np.zeros((2, 6)))
    for call, kind, words in (
        (lambda: joint_explorer("IRB-140"), TypeError, "arm: wanted an Arm"),
        (lambda: target_explorer(3), TypeError, "arm: wanted a ClosedFormArm"),
        (lambda: target_explorer(three_lever(0.3)), TypeError, "arm: wanted a ClosedFormArm"),
        (lambda: motion_explorer(SCARA, START, VIA, GOAL), TypeError, "start: wanted a ScaraPose"),
        (lambda: motion_explorer(IRB140, START, VIA, (1, 2, 3)), TypeError, "goal: wanted"),
        (lambda: motion_explorer(IRB140, START, two, GOAL), ValueError, "via: wanted one"),
    ):
        with pytest.raises(kind, match=words):
            call()


# --- What a notebook stores -----------------------------------------------------------------------

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
    "import os\nfrom robokin import IRB140, SCARA, Quaternion, Transform, deg, mm, spbu_arm\n"
    "from robokin.show import joint_explorer, motion_explorer, target_explorer"
)


def test_a_notebook_stores_a_still_picture_and_nbval_compares_its_words(tmp_path):
    path = tmp_path / "live.ipynb"
    _notebook(path, [FIRST, *CELLS.values()])
    subprocess.run(
        [sys.executable, ROOT / "tests" / "execute_notebooks.py", path],
        check=True,
        capture_output=True,
    )
    once = path.read_bytes()
    notebook = nbformat.reads(once.decode(), as_version=4)
    assert set(notebook.metadata) == {"kernelspec", "language_info"}
    for cell in notebook.cells[2:]:
        [output] = cell.outputs
        assert set(output.data) == {"text/html", "text/plain"} and output.data[
            "text/plain"
        ].endswith(RUN)
        assert re.search(
            r'<img alt="[^"]{40,}" .*src="data:image/png;base64', output.data["text/html"]
        )
        assert output.data["text/html"].endswith(f"<p>{RUN}</p></div>")
    assert b"widget" not in once and b"model_id" not in once
    assert len(once) < 400_000

    def nbval():
        rules = ROOT / "tests" / "nbval_sanitize.cfg"
        return subprocess.run(
            [
                sys.executable,
                "-m",
                "pytest",
                "-p",
                "no:cacheprovider",
                "--override-ini",
                "addopts=",
                "--nbval",
                "--nbval-current-env",
                "--nbval-sanitize-with",
                rules,
                path,
            ],
            cwd=tmp_path,
            text=True,
            capture_output=True,
        )

    run = nbval()
    assert run.returncode == 0, run.stdout[-3000:]
    path.write_bytes(once.replace(b"8 of 8 branches exist", b"7 of 8 branches exist"))
    assert nbval().returncode != 0, "the words are compared"


# --- In the browser -------------------------------------------------------------------------------


@pytest.fixture
def live(jupyter, page):
    """A notebook with explorers, run; `cell(name)` finds the explorer of a cell."""
    _notebook(jupyter.labs / "live.ipynb", [f"{FIRST}\nprint(os.getpid())", *CELLS.values()])
    jupyter.open(page, "live.ipynb")
    jupyter.run_all(page, "live.ipynb")
    cells = page.locator(".jp-CodeCell")
    for i in range(1, len(CELLS) + 1):
        cells.nth(i).scroll_into_view_if_needed()
        cells.nth(i).locator(".robokin-live canvas").first.wait_for(timeout=30_000)
    pid = int(cells.nth(0).locator(".jp-OutputArea-output").first.text_content())
    place = {name: i + 1 for i, name in enumerate(CELLS)}
    return SimpleNamespace(
        page=page,
        kernel=psutil.Process(pid),
        cell=lambda name: cells.nth(place[name]),
        at=lambda name: cells.nth(place[name]).locator(".robokin-explorer"),
        jupyter=jupyter,
    )


def test_after_many_moves_the_view_shows_the_last_target(live):
    rng, page = random.Random(5), live.page
    names = ["joint", "target", "motion", "scara", "elbow"]
    sliders = {name: live.at(name).locator("[role=slider]").all() for name in names}
    memory = []
    # One explorer after the other: JupyterLab 4.6 keeps 0.1 MB for ever each time that another cell
    # becomes the active one, whatever is in it. The first walk is short and warms up; what the
    # second one leaves behind counts.
    for moves in (4, MOVES // len(names)):
        for name in names:
            for _ in range(moves):
                slider = rng.choice(sliders[name])
                slider.focus()
                for _ in range(rng.randint(1, 4)):
                    page.keyboard.press(
                        rng.choice(["ArrowRight", "ArrowLeft", "PageUp", "PageDown"])
                    )
        _settled(live, names)
        memory.append((live.kernel.memory_info().rss / 1e6, _heap(page)))
    for name, arm in (("target", IRB140), ("scara", SCARA), ("elbow", ELBOW)):
        _agrees_with_ik(live.at(name), arm)
    assert _table(live.at("scara")) == _table(live.at("again")), "views of one object stay in step"
    values = _values(live.at("joint"))
    flange = IRB140.fk(np.array([values[f"q{i + 1}"] for i in range(6)]) * deg).translation / mm
    shown = [float(x) for x in re.findall(r"[xyz] (-?[\d.]+)", _table(live.at("joint"))[0])]
    assert np.allclose(shown[:3], flange, atol=0.051)
    _agrees_with_motion(live.at("motion"))
    (kernel, heap), (kernel_after, heap_after) = memory
    print(
        f"{MOVES} moves: kernel {kernel:.1f} -> {kernel_after:.1f} MB, page {heap:.1f} -> "
        f"{heap_after:.1f} MB"
    )
    assert kernel_after - kernel < 5 and heap_after - heap < 3
    assert page.errors == [] and page.outside == []
    assert page.locator("[data-mime-type='application/vnd.jupyter.stderr']").count() == 0
    assert "Traceback" not in (live.jupyter.home / "server.log").read_text()


def test_keyboard_and_screen_reader_reach_everything(live):
    page = live.page
    for name, wanted in (
        ("joint", ["q1, °", "q2, °", "q3, °", "q4, °", "q5, °", "q6, °"]),
        ("target", ["x, mm", "y, mm", "z, mm", "roll, °", "pitch, °", "yaw, °"]),
        ("motion", ["via x, mm", "via y, mm", "via z, mm", "blend", "duration, s", "time"]),
        ("scara", ["x, mm", "y, mm", "z, mm", "angle, °"]),
    ):
        explorer = live.at(name)
        for label in wanted:
            assert explorer.get_by_role("slider", name=label, exact=True).count() == 1, (
                f"{name}: no slider {label}"
            )
    for name, menus in (
        ("target", ["branch"]),
        ("motion", ["time law", "corner", "branch", "playing speed"]),
    ):
        for menu in menus:
            assert live.at(name).get_by_role("combobox", name=menu, exact=True).count() == 1, (
                f"{name}: no menu {menu}"
            )
        assert live.at(name).get_by_role("group").count() >= 1
    assert (
        live.at("target").get_by_role("img").get_attribute("aria-label").endswith("Home resets it.")
    )
    assert (
        live.at("target")
        .locator("[role=status]")
        .text_content()
        .startswith("8 of 8 branches are usable.")
    )

    # From the first slider on, Tab comes to every other control of the explorer, and the keys move
    # what they reach.
    for name, count in (("target", 7), ("motion", 8)):
        explorer = live.at(name)
        controls = explorer.locator("[role=slider]:visible, select, .rk-scene, button").all()
        controls[0].focus()
        reached, has_focus = set(), "e => e === document.activeElement"
        for _ in range(3 * len(controls)):
            reached |= {i for i, control in enumerate(controls) if control.evaluate(has_focus)}
            page.keyboard.press("Tab")
        assert len(reached) == len(controls) > count, f"{name}: {len(reached)} of {len(controls)}"
    explorer = live.at("target")
    slider, before = explorer.get_by_role("slider", name="x, mm", exact=True), _table(explorer)
    slider.press("ArrowRight")
    until(lambda: _table(explorer) != before, 5, "an arrow key moves nothing", page)
    assert slider.get_attribute("aria-valuetext") == "255"
    explorer.get_by_role("combobox", name="branch").select_option(index=7)
    until(
        lambda: explorer.locator("tr[aria-current=true]").inner_text().startswith("\u25b6 6"),
        5,
        "not chosen",
        page,
    )
    scene = explorer.locator(".rk-scene")
    pixels = scene.evaluate("e => e.toDataURL()")
    scene.press("ArrowLeft")
    until(lambda: scene.evaluate("e => e.toDataURL()") != pixels, 5, "the view does not turn", page)
    assert page.errors == []


def test_views_come_and_go_and_nothing_complains(live):
    page = live.page
    still = live.cell("joint").get_by_text(RUN)
    live.cell("joint").scroll_into_view_if_needed()
    assert still.count() == 1 and not still.is_visible(), "a live view covers its still picture"
    # One of two views of an object is taken away: the other goes on.
    live.cell("scara").locator(".jp-InputArea").click()
    page.get_by_role("menuitem", name="Edit", exact=True).click()
    page.get_by_role("menuitem", name="Clear Cell Output", exact=True).click()
    until(lambda: live.at("scara").count() == 0, 5, "the output does not go", page)
    before = _table(live.at("again"))
    live.at("again").get_by_role("slider", name="x, mm", exact=True).press("ArrowRight")
    until(lambda: _table(live.at("again")) != before, 5, "the other view does not move", page)
    # A restarted kernel: the sliders are dead.
    session = live.jupyter.api("sessions")[0]["kernel"]["id"]
    live.jupyter.api(f"kernels/{session}/restart", "POST")
    page.wait_for_timeout(2500)
    for name in ("target", "motion"):
        slider = live.at(name).locator("[role=slider]").first
        if slider.count():
            slider.focus()
            page.keyboard.press("ArrowRight")
    page.wait_for_timeout(500)
    assert page.errors == []


def test_a_stored_notebook_shows_stills_without_a_kernel(jupyter, page):
    path = jupyter.labs / "stored.ipynb"
    _notebook(path, [FIRST, *CELLS.values()])
    subprocess.run(
        [sys.executable, ROOT / "tests" / "execute_notebooks.py", path],
        check=True,
        capture_output=True,
    )
    jupyter.open(page, path.name)
    for cell in page.locator(".jp-CodeCell").all()[1:]:
        cell.scroll_into_view_if_needed()
        image = cell.locator("img[alt]")
        image.wait_for(timeout=20_000)
        assert image.is_visible() and image.evaluate("image => image.naturalWidth") > 300
        assert cell.get_by_text(RUN).is_visible()
    assert page.get_by_text("Loading widget").count() == 0 and page.errors == []


# --- What a person reads --------------------------------------------------------------------------


def _picture(explorer):
    """The last picture sent, its arrays of float64 decoded."""
    state = explorer._view.picture
    return SimpleNamespace(
        **{k: np.frombuffer(v, "<f8") if isinstance(v, bytes) else v for k, v in state.items()}
    )


def _target(explorer, arm):
    return _asked({name: c.value for name, c in explorer.controls.items() if name != "branch"}, arm)


def _asked(value, arm):
    """The target for slider values in mm and degrees, not by the code of the explorer."""
    place = [value[k] * mm for k in "xyz"]
    if arm is SCARA:
        return ScaraPose(place, value["angle"] * deg)
    if arm is ELBOW:
        return Transform(translation=place)
    turned = Rotation.from_euler("xyz", [value[k] for k in ("roll", "pitch", "yaw")], degrees=True)
    return Transform(Quaternion.from_matrix(turned.as_matrix()), place)


def _same(arm, q, rows, atol=1e-6):
    """Whether both are the same postures: whole turns do not count, NaN is NaN."""
    gap = q - rows
    gap = np.where(arm.prismatic, gap, gap - 2 * np.pi * np.round(gap / (2 * np.pi)))
    return np.array_equal(np.isnan(q), np.isnan(rows)) and np.nanmax(abs(gap), initial=0) < atol


def _table(explorer):
    """The rows of the table, with plain minus signs."""
    text = explorer.locator(".rk-table table").evaluate(
        "table => [...table.rows].map(row => [...row.cells].map(cell => "
        "cell.textContent).join('\\t'))"
    )
    return [row.replace("\u2212", "-").replace("\u2013", "nan") for row in text]


def _values(explorer):
    """The values of the sliders as they are read aloud (`aria-valuenow` has one decimal), by their
    names.
    """
    return {
        slider.get_attribute("aria-label").split(",")[0]: float(
            slider.get_attribute("aria-valuetext").replace("\u2212", "-")
        )
        for slider in explorer.locator("div[role=slider]").all()
    }


def _settled(live, names):
    """Wait until nothing changes any more."""

    def seen():
        return [_table(live.at(name)) for name in names]

    last = seen()
    for _ in range(40):
        live.page.wait_for_timeout(250)
        now = seen()
        if now == last:
            return
        last = now
    pytest.fail("the views do not settle")


def _agrees_with_ik(explorer, arm):
    rows = arm.ik(_asked(_values(explorer), arm))
    shown = np.array(
        [
            [float(x) for x in line.split("\t")[2 : 2 + len(arm.links)]]
            for line in _table(explorer)[1:]
        ]
    )
    assert _same(arm, shown * np.where(arm.prismatic, mm, deg), rows, atol=0.06 * deg)
    exists = ~np.isnan(rows[:, 0])
    verdicts = [line.split("\t")[1] for line in _table(explorer)[1:]]
    assert [v.startswith("usable") for v in verdicts] == (
        exists & within(arm, rows).all(axis=-1)
    ).tolist()


def _agrees_with_motion(explorer):
    value = _values(explorer)
    via = Transform(VIA.rotation, [value[f"via {k}"] * mm for k in "xyz"])
    t = np.linspace(0, value["duration"], 241)
    poses = blend(START, via, GOAL, value["blend"], quintic(value["duration"])(t))
    row = int(explorer.get_by_role("combobox", name="branch").input_value().split(":")[0])
    speed = np.nanmax(abs(differentiate(follow(IRB140, IRB140.ik(poses), row), t)), axis=0) / deg
    shown = [float(cell.split(" ")[0]) for cell in _table(explorer)[1].split("\t")[1:]]
    if np.isfinite(speed).all() and value["blend"]:  # a gap and a corner have rules of their own
        assert np.allclose(shown, speed, atol=0.06)


def _heap(page):
    """Megabytes of JavaScript in use after collecting what is not."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"] / 1e6
    session.detach()
    return used


def _notebook(path, sources):
    v4 = nbformat.v4
    cells = [v4.new_markdown_cell("# Explorers", id="title")]
    cells += [v4.new_code_cell(source, id=f"cell-{i}") for i, source in enumerate(sources)]
    kernel = {
        "kernelspec": {
            "display_name": "Python 3 (ipykernel)",
            "language": "python",
            "name": "python3",
        }
    }
    nbformat.write(v4.new_notebook(cells=cells, metadata=kernel), path)
