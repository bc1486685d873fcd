# SPDX-License-Identifier: Apache-2.0
"""How long a build still takes, by the time that packages took before and take now."""

from pathlib import Path
from typing import Dict, Iterable, Optional

FILE = 'launch_build_seconds'  # in the build tree of a package: how long its last build took


class Estimate:
    """Of packages whose build trees are below `build`. The times are seconds."""

    def __init__(self, names: Iterable[str], build: Path):
        self._build = build
        self._left: Dict[str, Optional[float]] = {name: self._last(name) for name in names}
        self._known = [seconds for seconds in self._left.values() if seconds is not None]
        self._work = 0.0  # of the packages that have ended

    def _last(self, name: str) -> Optional[float]:
        try:
            return float((self._build / name / FILE).read_text())
        except (OSError, ValueError):
            return None

    def ended(self, name: str, seconds: float, built: bool) -> None:
        self._left.pop(name, None)
        self._known.append(seconds)
        self._work += seconds
        if built and (self._build / name).is_dir():
            (self._build / name / FILE).write_text(f'{seconds:.1f}\n')

    def seconds_left(self, elapsed: float) -> Optional[float]:
        """None while too little is known: less than three packages have a time."""
        if len(self._known) < 3:
            return None
        usual = sum(self._known) / len(self._known)
        left = sum(usual if seconds is None else seconds for seconds in self._left.values())
        side_by_side = max(1.0, self._work / elapsed) if elapsed > 0 else 1.0
        return left / side_by_side


def in_words(seconds: float) -> str:
    if seconds < 90:
        return f'about {max(1, round(seconds))} s left'
    if seconds < 90 * 60:
        return f'about {round(seconds / 60)} min left'
    return f'about {seconds / 3600:.1f} h left'
