"""A player saved as an animated picture, whose frames show the motion."""

import numpy as np
import pytest
from PIL import Image

from robokin import IRB140, SCARA, Transform, deg
from robokin.show import animate, film, joint_explorer
from robokin.show.things import Mark

T = np.linspace(0, 4, 401)
WAY = np.linspace(0, 1, 401)[:, None] * np.array([90, 30, -40, 60, 50, 20]) * deg


def frames(player, path):
    """The frames of a saved film, and their durations in ms."""
    player.save(path)
    with Image.open(path) as picture:
        found, lasts = [], []
        for k in range(picture.n_frames):
            picture.seek(k)
            found.append(np.array(picture.convert("RGB")))
            lasts.append(picture.info["duration"])
    return np.array(found), lasts


def alike(one, other):
    """Whether two frames are equal except for single pixels: each film has its own palette."""
    return (abs(one.astype(int) - other).max(axis=-1) > 40).mean() < 2e-3


def test_frames_show_the_motion_at_their_times(tmp_path):
    """A film of the reversed motion has the same pictures in reverse order; while the arm is at
    rest, the pictures are equal.
    """
    there, lasts = frames(animate(IRB140, T, WAY), tmp_path / "there.gif")
    assert there.shape[1:] == (450, 640, 3) and len(there) == 4 * film.RATE + 1
    assert sum(lasts[:-1]) == 4000 and min(lasts) > 1000 / film.RATE - 10
    back, _ = frames(animate(IRB140, T, WAY[::-1]), tmp_path / "back.gif")
    assert all(map(alike, there, back[::-1]))
    assert not any(map(alike, there[:-4], there[4:]))
    # the second half takes three times as long
    uneven = np.concatenate([T[:201], 2 + 3 * (T[201:] - 2)])
    slow, _ = frames(animate(IRB140, uneven, WAY), tmp_path / "slow.gif")
    assert alike(slow[len(slow) // 4], there[len(there) // 2])


def test_long_motion_has_fewer_frames_per_second(tmp_path):
    found, lasts = frames(animate(IRB140, 5 * T, WAY), tmp_path / "long.gif")
    assert len(found) == film.FRAMES and sum(lasts[:-1]) == 20_000
    assert (tmp_path / "long.gif").stat().st_size < film.BYTES


def test_moving_things_are_drawn_and_missing_ones_are_not(tmp_path):
    moving = Transform(translation=np.column_stack([WAY[:, 0] / 3, WAY[:, 1], 0.3 + 0 * T]))
    ball = np.column_stack([0.3 + 0 * T, WAY[:, 0] / 5, 0.2 + 0 * T])
    q = np.column_stack([WAY[:, :3], 0.05 + 0 * T])
    around = {"targets": {"goal": moving}, "circles": [(ball, 0.05)]}
    both, _ = frames(animate([SCARA, SCARA], T, [q, q[::-1]], **around), tmp_path / "both.gif")
    assert len(both) == 49 and not alike(both[0], both[-1])
    still = np.repeat(q[:1], len(T), axis=0)
    moved, _ = frames(animate(SCARA, T, still, **around), tmp_path / "moved.gif")
    assert not alike(moved[0], moved[-1])
    lost = np.where(T[:, None] > 2, np.nan, WAY)
    found, _ = frames(animate(IRB140, T, lost), tmp_path / "lost.gif")
    dark = (found.max(axis=-1) < 100).sum(axis=(1, 2))  # pixels of the arm and a few labels
    assert dark[-1] < dark[:20].min() / 3
    # the last posture stays, lighter: all that was dark, except the labels, has another colour now
    paper = found[0, 0, 0]
    posture = found[int(2 * film.RATE)].max(axis=-1) < 100
    there = (abs(found[-1].astype(int) - paper).sum(axis=-1) > 60)[posture]
    assert there.mean() > 0.9
    begin, _ = frames(animate(IRB140, T, lost[::-1]), tmp_path / "begin.gif")
    dark = (begin.max(axis=-1) < 100).sum(axis=(1, 2))
    assert dark[0] < dark[-20:].min() / 3


def test_labels_of_moving_things_are_next_to_them():
    """A thing that is missing in the second half of the film has no label there."""
    at = np.arange(0, 401, 40)
    still = np.repeat(WAY[:1], len(T), axis=0)
    way = [0.3, 0.5, 0.9] + T[:, None] / 4 * [0.4, -0.8, -0.4]
    for places, shown in ((way, 11), (np.where(T[:, None] > 2, np.nan, way), 6)):
        things = Mark(places, "", 1e-6), Mark(places), Mark(places, "a moving label")
        speck, point, named = (
            animate(IRB140, T, still, things=[thing]).film._frames(at) for thing in things
        )
        found = []
        for k, (one, two, three) in enumerate(zip(speck, point, named, strict=True)):
            place, word = _changed(one, two), _changed(two, three)
            assert (len(place) > 20) == (len(word) > 100) == (k < shown)
            if k >= shown:
                assert not len(place) and not len(word)
                continue
            found.append(place.mean(axis=0))
            away = abs(word - found[-1])
            assert away.max() < 150 and away.sum(axis=-1).min() < 40, (
                "the label is not near its point"
            )
        assert len(found) == shown and np.linalg.norm(found[-1] - found[0]) > 50


def test_other_files_are_kept_and_large_films_are_refused(tmp_path, monkeypatch):
    player = animate(IRB140, T, WAY)
    mine = tmp_path / "mine.gif"
    Image.new("RGB", (4, 4)).save(mine)
    before = mine.read_bytes()
    with pytest.raises(ValueError, match="not a saved player; nothing is overwritten"):
        player.save(mine)
    assert mine.read_bytes() == before
    player.save(tmp_path / "again.gif")
    player.save(tmp_path / "again.gif")
    monkeypatch.setattr(film, "BYTES", 50_000)
    with pytest.raises(ValueError, match=r"wanted a film of at most 0 MB, got 0\.\d MB"):
        player.save(tmp_path / "large.gif")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["again.gif", "mine.gif"]
    with pytest.raises(ValueError, match="wanted a name that ends in .html"):
        joint_explorer(IRB140).save(tmp_path / "explorer.gif")


def _changed(one, other):
    """The pixels (k, 2), row and column, in which two pictures differ."""
    return np.argwhere(abs(one.astype(int) - other).max(axis=-1) > 60)
