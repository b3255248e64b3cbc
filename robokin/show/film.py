"""A film of a player: its scene, without the curves, as an animated GIF."""

import io
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .._arrays import Floats, Ints
from ..arms.arm import Arm
from ..transform import Transform
from . import plots
from .camera import apart, flange, standing
from .drawing import Image, require
from .page import PageScene
from .saving import MARK
from .scene import Scene
from .things import Thing

WIDTH = 640  # pixels
RATE, FRAMES = 12, 120  # maximum number of frames: per second, and in total
BYTES = 3_000_000  # maximum size of a film, which fits in an e-mail
COLOURS = 64
TRACED = 1001  # maximum number of points in a tool's path


class Film:
    """A film of the motion with which a player opens. Fixed things are drawn once; only arms and
    moving things, with their labels, are drawn again for each frame.
    """

    def __init__(
        self,
        t: Floats,
        motions: Sequence[tuple[Arm, Floats]],
        things: Sequence[Thing],
        page: PageScene,
        title: str,
        bases: Floats | None,
    ) -> None:
        self.t, self.motions, self.things = t, motions, things
        self.page, self.title, self.bases = page, title, bases
        self.known = [_known(q) for _, q in motions]

    def gif(self) -> bytes:
        """Return the film as a GIF that repeats forever. Raises ValueError if it is larger than 3
        MB.
        """
        require()
        seconds = float(self.t[-1] - self.t[0])
        count = max(2, min(FRAMES, int(seconds * RATE) + 1))
        times = np.linspace(self.t[0], self.t[-1], count)
        at = np.interp(times, self.t, np.arange(len(self.t))).round().astype(int)
        shown = [Image.fromarray(frame) for frame in self._frames(at)]
        palette = shown[0].quantize(COLOURS, dither=Image.Dither.NONE)
        first, *others = (
            frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in shown
        )
        ends = np.round(100 * seconds / (count - 1) * np.arange(count)).astype(int)  # in 1/100 s
        lasts = [*(10 * np.maximum(np.diff(ends), 2)), 1000]  # ms; the last frame stays longer
        file = io.BytesIO()
        more: Any = {"append_images": others, "duration": lasts, "comment": MARK.encode()}
        first.save(file, "GIF", save_all=True, loop=0, **more)
        size = file.tell()
        if size > BYTES:
            raise ValueError(
                f"path: wanted a film of at most {BYTES / 1e6:.0f} MB, got {size / 1e6:.1f} MB; "
                "show a shorter motion or fewer arms, or save a .html page"
            )
        return file.getvalue()

    def _frames(self, at: Ints) -> Iterator[Floats]:
        """Yield the frames (height, width, 3) at these samples."""
        count = 1 if self.bases is not None else len(self.motions)
        figure = plots.figure(self.title, width=4.5 * count if count > 1 else 6.4, height=4.5)
        figure.set_dpi(WIDTH / figure.get_figwidth())
        figure.text(0.016, 0.985, self.title, fontweight="bold", va="top", parse_math=False)
        feet = standing(self.bases, len(self.motions))
        scenes = []
        for k in range(count):
            scene = Scene(
                figure.add_axes((k / count, 0, 1 / count, 0.93)), self.page["size"], like=self.page
            )
            own = range(len(self.motions)) if count == 1 else [k]
            scenes.append((scene, own))
            self._still(scene, [(*self.motions[i], feet[i]) for i in own])
        canvas: Any = figure.canvas
        canvas.draw()
        behind = canvas.copy_from_bbox(figure.bbox)
        for sample in at:
            canvas.restore_region(behind)
            for scene, own in scenes:
                before = list(scene.ax.get_children())
                fixed = [*scene.drawn], [*scene.labels], [*scene.boxes]
                self._moving(scene, own, feet, sample)
                new = [each for each in scene.ax.get_children() if each not in before]
                for artist in sorted(new, key=lambda each: each.get_zorder()):
                    scene.ax.draw_artist(artist)
                    artist.remove()
                scene.drawn, scene.labels, scene.boxes = fixed
            yield np.array(canvas.buffer_rgba())[..., :3]

    def _still(self, scene: Scene, arms: Sequence[tuple[Arm, Floats, Floats]]) -> None:
        """Draw what does not move: the bases, the paths of the tools, and the fixed things."""
        for arm, q, base in arms:
            scene.base(base)
            some = np.linspace(0, len(q) - 1, min(len(q), TRACED)).astype(int)
            scene.trace(flange(arm, q[some]).translation + base)
        for thing in self.things:
            if not thing.moves:
                thing.draw(scene, None)
        scene.finish()

    def _moving(self, scene: Scene, own: Sequence[int], feet: Floats, sample: int) -> None:
        """Draw the arms `own` and the moving things, with their labels, at one sample. An arm
        without a posture is drawn lighter, in its last posture before.
        """
        for k in own:
            (arm, q), base, known = self.motions[k], feet[k], self.known[k][sample]
            scene.arm(arm, q[known], "last" if known == sample else "first", base)
            if not apart(self.bases):
                scene.triad(Transform(translation=base) @ flange(arm, q[known]), width=2.4)
        for thing in self.things:
            if thing.moves:
                thing.draw(scene, sample)
        scene.place_labels()


def _known(q: Floats) -> Ints:
    """For each sample, the last one up to it that has a posture; the first sample if none has."""
    known = np.isfinite(q).all(axis=-1)
    return np.maximum.accumulate(np.where(known, np.arange(len(q)), 0))
