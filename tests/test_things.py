"""Things in a scene: their data, and how a new kind is added."""

import json

import pytest
from conftest import ROOT
from scenes import scenes

EARLIER = json.loads((ROOT / "tests/data/scenes_11a2279.json").read_text(encoding="utf-8"))
NOW = scenes()


def today(scene):
    """A scene of commit 11a2279 under the keys of today."""
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
    return (
        kept | {key: scene.get(key, value) for key, value in defaults.items()} | {"things": things}
    )


@pytest.mark.parametrize("name", EARLIER)
def test_scenes_have_the_numbers_of_the_earlier_edition(name):
    assert NOW.keys() == EARLIER.keys()
    assert NOW[name] == today(EARLIER[name])
