"""Things in a scene: their data, and how a new kind is added."""

import json
import os
import re
import shutil
import subprocess
import sys
from typing import get_args
from unittest import mock

import numpy as np
import pytest
from conftest import ROOT, awake
from matplotlib.text import Text
from scenes import TURNED, T, scenes

from robokin import IRB140, Transform
from robokin.show import animate, numbers
from robokin.show.things import Faces, Mark, PageThing, Target

EARLIER = json.loads((ROOT / "tests/data/scenes_11a2279.json").read_text(encoding="utf-8"))
with mock.patch.object(numbers, "EQUAL", 0):  # the earlier version kept other samples of equal ones
    NOW = scenes()


def today(scene):
    """A scene of commit 11a2279, converted to the current keys."""
    kept = {key: scene[key] for key in ("size", "flat", "grid", "seen", "floor", "view")}
    things = [
        {"kind": "target", "name": old["name"], "pose": old.get("way", old.get("pose"))}
        for old in scene["targets"]
    ]
    for old in scene["marks"]:
        name, at = old["name"], old.get("way", old.get("at"))
        if "reading" in old:
            name = old["reading"] | {"name": name, "decimals": old["decimals"]}
        things.append({"kind": "mark", "name": name, "radius": old["radius"], "at": at})
    if "faces" in scene:
        things.append({"kind": "faces", "corners": scene["faces"]})
    defaults = {"grows": False, "solid": False, "bases": None}
    kept |= {key: scene.get(key, value) for key, value in defaults.items()}
    return kept | {"things": things}


@pytest.mark.parametrize("name", EARLIER)
def test_scenes_have_the_values_of_the_earlier_version(name):
    assert NOW.keys() == EARLIER.keys()
    assert NOW[name] == today(EARLIER[name])


def test_things_argument_gives_the_same_scene_as_the_other_arguments():
    goal, belt = IRB140.fk(TURNED[-1]), [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    apart = animate(
        IRB140,
        T,
        TURNED,
        targets={"goal": goal},
        points={"p": (1, 0, 0)},
        circles={"c": ((0, 1, 0), 0.1)},
        faces=[belt],
        readings={"p": T},
    )
    marks = [Mark((1, 0, 0), "p", reading=T), Mark((0, 1, 0), "c", 0.1)]
    together = animate(IRB140, T, TURNED, things=[Target(goal, "goal"), *marks, Faces([belt])])
    assert together.data["scene"] == apart.data["scene"]


def test_things_copy_their_arguments():
    at, belt = np.array([1.0, 0, 0]), np.eye(3)
    mark, faces = Mark(at, "p"), Faces([belt])
    at[:], belt[:] = 7, 7
    assert mark.page(None)["at"] == [1, 0, 0] and faces.page(None)["corners"][0][0] == [1, 0, 0]
    for array in (mark.at.rows, *faces.corners):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0
    with pytest.raises(AttributeError):
        mark.name = "q"


def test_nan_reading_shows_only_the_name():
    gone = np.where(T > 1, np.nan, T)
    still = animate(IRB140, T, TURNED, points={"p": (1, 0, 0)}, readings={"p": gone}).still
    assert "p" in [text.get_text() for text in still.findobj(Text)]


@pytest.mark.parametrize(
    "make, error, message",
    [
        (lambda: Mark((1, 2, 3, 4)), ValueError, "at: wanted points of shape"),
        (lambda: Mark((1, 2, np.nan)), ValueError, "at: wanted finite"),
        (lambda: Mark((0, 0), 7), ValueError, "name: wanted a string, got 7"),
        (lambda: Mark((0, 0), "p", -1), ValueError, "radius: wanted one positive length"),
        (lambda: Mark((0, 0), "p", None, "x"), ValueError, "reading: wanted numbers"),
        (lambda: Target((0, 0, 1), "p"), TypeError, "target p: wanted a Transform"),
        (lambda: Faces([[(0, 0, 0)]]), ValueError, "faces: wanted 3 to 100 corners"),
        (lambda: animate(IRB140, T, TURNED, things=[7]), TypeError, "things: wanted a Thing"),
        (lambda: animate(IRB140, T, TURNED, things=7), TypeError, "things: wanted a list"),
        (
            lambda: animate(IRB140, T, TURNED, things=[Mark(np.zeros((7, 3)))]),
            ValueError,
            r"at: wanted shape \(61, 3\).*got \(7, 3\)",
        ),
        (
            lambda: animate(IRB140, T, TURNED, things=[Mark((0, 0), "p", reading=T[:3])]),
            ValueError,
            r"reading: wanted shape \(61,\).*got \(3,\)",
        ),
        (
            lambda: animate(
                IRB140, T, TURNED, things=[Target(Transform(translation=np.zeros((5, 3))), "p")]
            ),
            ValueError,
            r"target p: wanted shape \(61,\).*got \(5,\)",
        ),
    ],
)
def test_invalid_things_are_refused(make, error, message):
    with pytest.raises(error, match=message):
        make()


# --- A new kind -----------------------------------------------------------------------------------

FLAG_PY = '''"""Flags: a new kind, for a test."""

from dataclasses import dataclass
from typing import Literal, TypedDict

import numpy as np

from ..._arrays import ArrayLike, Floats, Ints
from ..checks import plain
from .thing import PageWay, Thing, Way, as_place


class PageFlag(TypedDict):
    """A square flag with a label."""

    kind: Literal["flag"]
    label: str
    foot: list[float] | PageWay


@dataclass(frozen=True, init=False, eq=False)
class Flag(Thing):
    """A square flag on a foot."""

    foot: Way
    label: str

    def __init__(self, foot: ArrayLike, label: str) -> None:
        self.hold(foot=as_place(foot, "foot"), label=plain(label, "label"))

    def page(self, kept: Ints | None) -> PageFlag:
        return {"kind": "flag", "label": self.label, "foot": self.foot.page(kept)}

    def seen(self, axis: float) -> Floats:
        return self.foot.rows.reshape(-1, 3) + [0, 0, 0.2]

    def draw(self, scene, sample: int | None) -> None:  # type: ignore[no-untyped-def]
        foot = self.foot.at(sample)
        scene.line(foot + np.array([[0, 0, 0], [0, 0, 0.2]]), color="black")
        scene.label(self.label, foot)
'''

FLAG_JS = """// Flags: a new kind, for a test.

import {colors, polygon} from "./canvas.js";

/** @import {PageFlag} from "./page.js" */
/** @import {Kind} from "./scene.js" */

/** @type {Kind<PageFlag>} */
export const flag = {
  seen: ({foot}) => [foot],
  below() {},
  above({g, cam}, flags, labels) {
    for (const {foot, label} of flags) {
      const [x, y] = cam.to(foot);
      const corners = [0, 1, 2, 3].map(k => [x + 12 * (k > 1 ? 1 : -1), y + 12 * (k % 3 ? 1 : -1)]);
      polygon(g, corners.map(([u, v]) => [u, v]), colors.chosen, colors.chosen, 1);
      labels.push({text: label, at: [x, y + 40], color: colors.ink});
    }
  },
};
"""

PLAYER = """
import sys
from robokin.show import animate
from robokin.show.things import Flag
from scenes import CIRCLING, GONE, IRB140, T, TURNED
things = [Flag((0.9, 0, 0.4), "still"), Flag(CIRCLING, "moves")] + [Flag(GONE - 0.3, "gone")]
animate(IRB140, T, TURNED, things=things).save(sys.argv[1])
"""

RED = """() => {
    const canvas = document.querySelector(".rk-scene"), {width, height} = canvas;
    const data = canvas.getContext("2d").getImageData(0, 0, width, height).data;
    const [r, g, b] = getComputedStyle(canvas).getPropertyValue("--rk-chosen").trim()
        .match(/[0-9a-f]{2}/gi).map(x => parseInt(x, 16));
    let count = 0;
    for (let i = 0; i < data.length; i += 4)
        if (data[i] === r && data[i + 1] === g && data[i + 2] === b) count++;
    return count;
}"""


def test_new_kind_of_thing_needs_only_two_files_and_one_entry(tmp_path, browser):
    """The test follows the instructions in CONTRIBUTING in a copy of robokin, and checks types, the
    still picture, the film and the page.
    """
    for name in ("robokin", "tests"):
        ignore = shutil.ignore_patterns("__pycache__", "*.ipynb", "benchmarks", "course")
        shutil.copytree(ROOT / name, tmp_path / name, ignore=ignore)
    show = tmp_path / "robokin" / "show"
    (show / "things" / "flag.py").write_text(FLAG_PY)
    (show / "js" / "flag.js").write_text(FLAG_JS)
    listed = show / "things" / "__init__.py"
    text = listed.read_text()
    for place, entry in (
        ("^from .thing import", "from .flag import Flag, PageFlag\nfrom .thing import"),
        (r"^__all__ = \[", '__all__ = ["Flag", '),
        (r"^PageThing: TypeAlias = \(?\s*", r"\g<0>PageFlag | "),  # flags are drawn first
    ):
        text, count = re.subn(place, entry, text, flags=re.M)
        assert count == 1, place
    listed.write_text(text)

    def run(*command):
        done = subprocess.run(
            [sys.executable, *map(str, command)],
            cwd=tmp_path,
            env=os.environ
            | {"PYTHONPATH": os.pathsep.join([str(tmp_path), str(tmp_path / "tests")])},
            text=True,
            capture_output=True,
        )
        assert not done.returncode, done.stdout + done.stderr
        return done.stdout

    said = run("tests/javascript.py", "types").split()
    assert said == ["robokin/show/js/page.d.ts", "robokin/show/js/kinds.js"]
    assert "PageFlag" in (show / "js" / "page.d.ts").read_text()
    names = [get_args(table.__annotations__["kind"])[0] for table in get_args(PageThing)]
    assert f"{{flag, {', '.join(names)}}}" in (show / "js" / "kinds.js").read_text()
    run("tests/javascript.py", "tsc")
    run("-c", PLAYER, tmp_path / "player.html")
    run("-c", PLAYER, tmp_path / "player.gif")
    assert (tmp_path / "player.gif").stat().st_size > 10_000
    page = browser.new_page()
    page.goto((tmp_path / "player.html").as_uri())
    awake(page)
    page.wait_for_function(f"({RED})() > 1300")  # three flags, 24 by 24 pixels each
    page.locator("input[type=range]").last.evaluate(
        "x => { x.value = x.max; x.dispatchEvent(new Event('input')); }"
    )
    page.wait_for_function(f"({RED})() < 1300")  # one of the flags is gone
    assert page.evaluate(RED) > 900
    page.close()
