"""Compare the length of each lab with what a student can read and do in an hour.

    python tests/lab_sizes.py                      all labs
    python tests/lab_sizes.py notebooks/05_...     only these

The core path is everything before the heading "More": the words of the text up to "Your turn"
without formulas, the code cells with their lines, except folded cells, the predictions and the
exercises. The script allows one minute per 170 words, one for each code cell, two for each
prediction and twelve for each exercise. The whole lab also includes the part under "More". A gap is
the time, in minutes, between two moving views before "Your turn"; views in predictions do not
count.
"""

import json
import re
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
READ = 170  # words per minute


class Size(NamedTuple):
    words: int
    cells: int
    lines: int
    sections: int
    predictions: int
    exercises: int

    @property
    def minutes(self) -> float:
        return self.reading + 12 * self.exercises

    @property
    def reading(self) -> float:
        """The time in minutes without the exercises."""
        return self.words / READ + self.cells + 2 * self.predictions


class Length(NamedTuple):
    core: Size
    whole: Size
    gap: float  # the longest gap, in minutes


CORE = Size(words=1200, cells=12, lines=150, sections=8, predictions=5, exercises=2)
MINUTES = {"core": 60, "whole": 90}
SHORT = {"13_rotor": 30, "14_conveyor": 30}  # maximum minutes for the whole lab
START = "00_start_here"  # it may take at most ten minutes without its exercise
GAP = 10  # minutes
MOVES = re.compile(r"^(?:\w+ = )?(?:animate|(?:\w+_)?(?:explorer|player))\(", re.M)


def measure(path: Path) -> Length:
    """Return the length of the lab at `path`."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    turn = _first(cells, r"^#+ Your turn")
    more = _first(cells, r"^#+ More\b")
    end = _first(cells, r"^#+ In short")
    core, rest = _size(cells[:turn]), _size(cells[more:])
    tasks = sum(len(re.findall(r"^check\(", _text(cell), re.M)) for cell in cells[turn:end])
    core = core._replace(exercises=tasks)
    return Length(core, Size(*map(sum, zip(core, rest, strict=True))), _gap(cells[:turn]))


def _first(cells, heading: str) -> int:
    found = [k for k, cell in enumerate(cells) if re.search(heading, _text(cell), re.M)]
    return found[0] if found else len(cells)


def _text(cell) -> str:
    return "".join(cell["source"])


def _size(cells) -> Size:
    code = "\n".join(_text(cell) for cell in cells if cell["cell_type"] == "code")
    prose = [_text(cell) for cell in cells if cell["cell_type"] == "markdown"]
    shown = [_text(cell) for cell in cells if cell["cell_type"] == "code" and not folded(cell)]
    return Size(
        words=sum(len(words(text)) for text in prose),
        cells=len(shown),
        lines=sum(line.strip() != "" for text in shown for line in text.splitlines()),
        sections=len(re.findall(r"^## \d+\. ", "\n".join(prose), re.M)),
        predictions=len(re.findall(r"^predict\(", code, re.M)),
        exercises=len(re.findall(r"^check\(", code, re.M)),
    )


def _gap(cells) -> float:
    """Return the longest time, in minutes, between two moving views or after the last one."""
    longest = now = 0.0
    for cell in cells:
        if cell["cell_type"] == "code" and MOVES.search(_text(cell)):
            now = 0.0
        else:
            now += _size([cell]).reading
        longest = max(longest, now)
    return longest


def folded(cell) -> bool:
    """Whether the source of a code cell is hidden."""
    return cell["metadata"].get("jupyter", {}).get("source_hidden", False)


def words(text: str) -> list[str]:
    """The words of a text and its tables, but not those in formulas, addresses and comments."""
    text = re.sub(r"\$\$.*?\$\$|\$[^$]+\$", " ", text, flags=re.S)
    text = re.sub(r"\]\([^)]*\)", "] ", text)
    text = re.sub(r"<!--.*?-->", " ", text, flags=re.S)
    return re.findall(r"\w[\w'’.-]*", text)


def too_long(name: str, length: Length) -> list[str]:
    """Return a message for each limit that the lab exceeds."""
    core, whole, gap = length
    over = [f"{field} {getattr(core, field)} above {most}"
            for field, most in CORE._asdict().items() if getattr(core, field) > most]  # fmt: skip
    for part, size in (("core", core), ("whole", whole)):
        most = min(MINUTES[part], SHORT.get(name, 90))
        over += [f"{part} {size.minutes:.0f} min above {most}"] * (round(size.minutes, 6) > most)
    over += [f"reading {core.reading:.0f} min above 10"] * (name == START and core.reading > 10)
    return over + [f"gap {gap:.0f} min above {GAP}"] * (round(gap, 6) > GAP)


def main() -> int:
    paths = [Path(name) for name in sys.argv[1:]] or sorted((ROOT / "notebooks").glob("*.ipynb"))
    print(f"{'lab':32}{'words':>6}{'cells':>6}{'lines':>6}{'sections':>9}{'asks':>5}"
          f"{'tasks':>6}{'core':>6}{'whole':>6}{'gap':>5}")  # fmt: skip
    long = 0
    for path in paths:
        core, whole, gap = length = measure(path)
        over = too_long(path.stem, length)
        long += bool(over)
        print(f"{path.stem:32}{core.words:6}{core.cells:6}{core.lines:6}{core.sections:9}"
              f"{core.predictions:5}{core.exercises:6}{core.minutes:6.0f}{whole.minutes:6.0f}"
              f"{gap:5.0f}  {'; '.join(over)}")  # fmt: skip
    print(f"{len(paths) - long} of {len(paths)} within the limits")
    return 1 if long else 0


if __name__ == "__main__":
    sys.exit(main())
