"""Compare the length of each lab with what a student can read in an hour.

    python tests/lab_sizes.py                      all labs
    python tests/lab_sizes.py notebooks/05_...     only these

The script counts the part before "Your turn": the words of the text without formulas, and the code
cells with their lines, except folded cells. It allows one minute per 170 words, one for each code
cell, two for each prediction and twelve for each exercise.
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
        return self.words / READ + self.cells + 2 * self.predictions + 12 * self.exercises

    @property
    def reading(self) -> float:
        """The time in minutes without the exercises."""
        return self.minutes - 12 * self.exercises


MOST = Size(words=1800, cells=18, lines=200, sections=8, predictions=10, exercises=3)
MINUTES, READING = 90, 60
START = "00_start_here"  # a lab that takes ten minutes


def measure(path: Path) -> Size:
    """The size of the lab at `path`."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    sources = [(cell, "".join(cell["source"])) for cell in cells]
    turn = [n for n, (_, text) in enumerate(sources) if re.search(r"^#+ Your turn", text, re.M)]
    before = sources[: turn[0] if turn else None]
    code = "\n".join(text for cell, text in sources if cell["cell_type"] == "code")
    prose = [text for cell, text in before if cell["cell_type"] == "markdown"]
    shown = [text for cell, text in before if cell["cell_type"] == "code" and not folded(cell)]
    return Size(
        words=sum(len(words(text)) for text in prose),
        cells=len(shown),
        lines=sum(line.strip() != "" for text in shown for line in text.splitlines()),
        sections=len(re.findall(r"^## \d+\. ", "\n".join(prose), re.M)),
        predictions=len(re.findall(r"^predict\(", code, re.M)),
        exercises=len(re.findall(r"^check\(", code, re.M)),
    )


def folded(cell) -> bool:
    """Whether the source of a code cell is hidden."""
    return cell["metadata"].get("jupyter", {}).get("source_hidden", False)


def words(text: str) -> list[str]:
    """The words of a text, including those in tables, but without formulas and addresses."""
    text = re.sub(r"\$\$.*?\$\$|\$[^$]+\$", " ", text, flags=re.S)
    text = re.sub(r"\]\([^)]*\)", "] ", text)
    return re.findall(r"\w[\w'’.-]*", text)


def main() -> int:
    paths = [Path(name) for name in sys.argv[1:]] or sorted((ROOT / "notebooks").glob("*.ipynb"))
    print(f"{'lab':32}{'words':>6}{'cells':>6}{'lines':>6}{'sections':>9}{'asks':>5}"
          f"{'tasks':>6}{'minutes':>8}{'reading':>8}")  # fmt: skip
    long = 0
    for path in paths:
        size = measure(path)
        over = too_long(path.stem, size)
        long += bool(over)
        print(f"{path.stem:32}{size.words:6}{size.cells:6}{size.lines:6}{size.sections:9}"
              f"{size.predictions:5}{size.exercises:6}{size.minutes:8.0f}{size.reading:8.0f}"
              f"  {'; '.join(over)}")  # fmt: skip
    print(f"{len(paths) - long} of {len(paths)} within the limits")
    return 1 if long else 0


def too_long(name: str, size: Size) -> list[str]:
    """A message for each limit that the lab exceeds."""
    over = [f"{field} above {most}" for field, most in MOST._asdict().items()
            if getattr(size, field) > most]  # fmt: skip
    over += [f"minutes above {MINUTES}"] * (round(size.minutes, 6) > MINUTES)
    reading = 10 if name == START else READING
    return over + [f"reading above {reading}"] * (round(size.reading, 6) > reading)


if __name__ == "__main__":
    sys.exit(main())
