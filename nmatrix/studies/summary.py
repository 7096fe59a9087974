"""What a study comes down to: each contestant once, the few that matter, and one true sentence.

The terminal and the chart say the same sentence. It tells what more and what less time buys than
the reference takes, and is made of the measurements, whatever these are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, StrEnum, auto
from functools import cached_property
from math import floor, isnan, log10, pi, radians

from nmatrix.enums import Space
from nmatrix.studies.measurements import Measurement, Study, Unit, by_setting
from nmatrix.studies.methods import METHODS
from nmatrix.studies.normals import ONE

Rows = Sequence[Measurement]

VISIBLE = radians(0.1)  # a normal that is off by more is seen in a picture
MOST = 8  # contestants that one look takes in
ALIKE = 1.05  # times and errors within this factor of one another are called the same
NEARLY_BEST = {Unit.RADIANS: 10.0, Unit.LEVELS: 1.1, Unit.MULTIPLICATIONS: 1.0}
ROUNDED = {Unit.RADIANS: 1e-14}  # errors up to this are as good as none
NOTHING = 1e-18  # what an error of zero counts as where errors are compared by factors
POWERS_FROM = 1_000  # a factor from here on is told as a power of ten
USUAL_FRAME = "usual frame"
SPOKEN: dict[str, str] = {
    "inverse": "inv(A).T",
    USUAL_FRAME: f"the {USUAL_FRAME}",
    **{one.value: f"{one} space" for one in Space},
}


class Measure(StrEnum):
    """What prices are of: time, or the work that is counted where no time is told."""

    TIME = "time"
    WORK = "counted work"

    @property
    def noun(self) -> str:
        """The measure in one word."""
        return self.rpartition(" ")[2]


class Role(Enum):
    """What a contestant is beside the others."""

    REFERENCE = auto()
    FRONT = auto()  # nothing cheaper is as exact
    BEATEN = auto()
    WRONG = auto()  # off by what everyone sees, somewhere


@dataclass(frozen=True, eq=False)
class Standing:
    """One contestant over all that it was measured on.

    `timed` are the same rows with the times that the clock gave, though they may not be told.
    `known_price` is what the reference costs; prices are multiples of that.
    """

    name: str
    rows: Rows
    timed: Rows
    known_price: float

    @property
    def unit(self) -> Unit:
        """The unit of the errors."""
        return self.rows[0].unit

    @property
    def is_reference(self) -> bool:
        """Whether the others are measured against this one."""
        return any(row.is_reference for row in self.rows)

    @cached_property
    def worst(self) -> float:
        """The largest error."""
        return max(map(_error, self.rows))

    @cached_property
    def easiest(self) -> float:
        """The largest error in the setting where that is least."""
        return min(map(_error, self.rows))

    @property
    def error(self) -> float:
        """The largest error as it counts beside others: one of mere rounding is as any other."""
        return max(self.worst, ROUNDED.get(self.unit, 0.0))

    @cached_property
    def prices(self) -> tuple[float, float]:
        """The lowest and the highest price of its settings; 1 where it is against itself."""
        if self.is_reference:
            return 1.0, 1.0
        found = [row.price / self.known_price for row in self.rows]
        return min(found), max(found)

    @property
    def price(self) -> float:
        """The highest price, which is the one that counts."""
        return self.prices[1]

    @property
    def spread(self) -> tuple[float, float] | None:
        """The ends of the intervals of its times, over all settings."""
        times = [row.timing for row in self.timed if row.timing is not None]
        if not times:
            return None
        return min(one.low for one in times), max(one.high for one in times)

    @property
    def spoken(self) -> str:
        """The name that a sentence has for it."""
        return SPOKEN.get(self.name, self.name)

    @property
    def is_seen(self) -> bool:
        """Whether a picture shows how wrong it is: more than 0.1° off, or no answer, somewhere."""
        return self.unit is Unit.RADIANS and self.worst > VISIBLE

    @property
    def is_everyday(self) -> bool:
        """Whether it is a method that everybody knows."""
        return any(one.name == self.name and one.is_everyday for one in METHODS)


def _error(row: Measurement) -> float:
    """Read the error of a row; one with wrong answers is off by as much as one can be."""
    if row.unit is Unit.RADIANS and (row.failures or isnan(row.error)):
        return pi
    return row.error


@dataclass(frozen=True, eq=False)
class Summary:
    """The contestants of a study, the most exact first; `measure` is what their prices are of."""

    study: Study
    standings: tuple[Standing, ...]
    measure: Measure
    rows: Rows

    @cached_property
    def reference(self) -> Standing:
        """The contestant that the others are measured against."""
        return next(one for one in self.standings if one.is_reference)

    @property
    def settings(self) -> int:
        """The number of settings that each error is the worst of."""
        return len({row.setting for one in self.standings for row in one.rows})

    @cached_property
    def roles(self) -> dict[str, Role]:
        """The role of each contestant, by name."""
        right = [one for one in self.standings if not one.is_seen]

        def is_beaten(one: Standing) -> bool:
            if self.study is Study.SPACES:
                return one not in self.cheapest
            mine = one.price, one.error
            theirs = ((other.price, other.error) for other in right)
            return any(p <= mine[0] and e <= mine[1] and (p, e) != mine for p, e in theirs)

        return {
            one.name: Role.REFERENCE
            if one.is_reference
            else Role.WRONG
            if one.is_seen
            else Role.BEATEN
            if is_beaten(one)
            else Role.FRONT
            for one in self.standings
        }

    @cached_property
    def front(self) -> tuple[Standing, ...]:
        """Those of which none is seen to be wrong, and nothing cheaper is as exact, by price."""
        known = self.reference
        is_on = [one for one in self.standings if self.roles[one.name] is Role.FRONT]
        beats = (one.price <= known.price and one.error <= known.error for one in is_on)
        if not known.is_seen and not any(beats):
            is_on.append(known)
        return tuple(sorted(is_on, key=lambda one: one.price))

    @cached_property
    def more(self) -> Standing | None:
        """The best of those that cost as much as the reference or more and are more exact.

        None where nothing is, or what costs less is as exact as that.
        """
        known, less = self.reference, self.less
        dearer = [one for one in self._right if one.price * ALIKE > 1.0]
        if less and all(less.error <= one.error * ALIKE for one in dearer):
            return None
        return self._knee([one for one in dearer if one.error * ALIKE < known.error])

    @cached_property
    def less(self) -> Standing | None:
        """The best of those that are cheaper than the reference."""
        return self._knee([one for one in self._right if one.price * ALIKE <= 1.0])

    @property
    def _right(self) -> list[Standing]:
        return [one for one in self.standings if not (one.is_reference or one.is_seen)]

    def _knee(self, found: Sequence[Standing]) -> Standing | None:
        """Find the cheapest that is nearly as exact as the most exact."""
        best = min((one.error for one in found), default=0.0)
        good = [one for one in found if one.error <= NEARLY_BEST[one.unit] * best]
        return min(good, key=lambda one: (one.price, one.worst), default=None)

    def shown(self, *, everything: bool) -> tuple[Standing, ...]:
        """Choose the few that one look takes in, or all.

        What the sentence speaks of comes first, then the front of methods, then what everybody
        knows, then what differs most from the reference.
        """
        if everything:
            return self.standings
        known = max(self.reference.worst, NOTHING)
        spoken = (self.reference, self.more, self.less)
        front = self.front if self.study is Study.NORMALS else ()

        def rank(one: Standing) -> tuple[bool, bool, bool, float]:
            far = abs(log10(max(one.worst, NOTHING) / known))
            return one not in spoken, one not in front, not one.is_everyday, -far

        few = sorted(self.standings, key=rank)[:MOST]
        return tuple(one for one in self.standings if one in few)

    @property
    def sentence(self) -> str:
        """What more and what less time buys, in the mark-up of pictures.

        Times and errors are each the worst over all that was measured.
        """
        if self.study is Study.SPACES:
            return self._on_spaces
        if all(one.is_seen for one in self.standings):
            return "Every method is visibly wrong somewhere"
        if self.more is None and self.less and self.less.error * ALIKE < self.reference.error:
            return f"{self._on_less}. More {self.measure.noun} buys no more"
        return f"{self._on_more}. {self._on_less}"

    @property
    def _on_more(self) -> str:
        if self.more is None:
            return f"More {self.measure.noun} buys nothing"
        if self.reference.is_seen:
            return f"{self._share(self.more.price)}: off, but invisibly"
        gain = _gain(self.reference.worst, self.more.worst)
        return f"{self._share(self.more.price)}: {gain}"

    @property
    def _on_less(self) -> str:
        if not any(one.price * ALIKE <= 1.0 for one in self.standings):
            return f"Nothing takes less {self.measure.noun}"
        if self.less is None:
            return f"Less {self.measure.noun}: visibly wrong"
        price = self._share(self.less.price)
        known, found = self.reference.worst, self.less.worst
        if found <= known * ALIKE and not self.reference.is_seen:
            return f"{price}: {_gain(known, found)}"
        if self.less.unit is Unit.RADIANS:
            return f"{price}: off, but invisibly"
        return f"{price}: {_factor(found / known)} as far off"

    def _share(self, price: float) -> str:
        return share(price, self.measure.noun)

    @cached_property
    def cheapest(self) -> tuple[Standing, ...]:
        """Those of the least price, as far as the clock tells them apart."""
        best = min(self.standings, key=lambda one: one.price)
        return tuple(one for one in self.standings if self._is_as_cheap(one, best))

    def _is_as_cheap(self, one: Standing, best: Standing) -> bool:
        if self.measure is Measure.TIME and one.spread is not None and best.spread is not None:
            return one.spread[0] <= best.spread[1]
        return one.price <= best.price

    @property
    def _on_spaces(self) -> str:
        if self.reference in self.cheapest:
            best = min(self.cheapest, key=lambda one: one.price)
            if best.price < self.reference.price:  # their intervals have a part in common
                return f"The clock cannot tell {best.name} space from world space"
            return f"No space takes less {self.measure.noun} than world space"
        names = " or ".join(one.name for one in self.cheapest).capitalize()
        least = self._share(max(one.price for one in self.cheapest)).lower()
        most = "at most " if len(self.cheapest) > 1 else ""
        return f"{names} space: {most}{least} of world space"


def summary(study: Study, rows: Rows, timed: Rows | None = None) -> Summary:
    """Sum a study up; `timed` are its rows with times that may not be told, for their spread.

    Of normals the batches count; rows of one matrix alone are summed up where there are no others.
    """
    groups, times_of = _groups(study, rows), _groups(study, timed or rows)
    known = next(mine for mine in groups.values() if any(row.is_reference for row in mine))
    is_told = rows[0].timing is not None
    known_price = 1.0 if is_told else max(row.price for row in known)
    found = [
        Standing(name, tuple(mine), tuple(times_of[name]), known_price)
        for name, mine in groups.items()
    ]
    found.sort(key=lambda one: (one.worst, one.price))
    return Summary(study, tuple(found), Measure.TIME if is_told else Measure.WORK, rows)


def _groups(study: Study, rows: Rows) -> dict[str, list[Measurement]]:
    """Collect the rows of each contestant.

    Methods meet every batch; a dial's setting is a contestant of its own, and the usual frame is
    one under all its names; spaces compete at the most vertices.
    """
    found: dict[str, list[Measurement]] = {}
    last = list(by_setting(rows))[-1]
    are_alone = all(row.setting.startswith(ONE) for row in rows)
    for row in rows:
        match study:
            case Study.NORMALS:
                name = row.method if row.setting.startswith(ONE) is are_alone else ""
            case Study.SHADING:
                name = USUAL_FRAME if row.is_reference else f"{row.setting} {row.method}"
            case Study.SPACES:
                name = row.method if row.setting == last else ""
        if name:
            found.setdefault(name, []).append(row)
    return found


def share(price: float, noun: str) -> str:
    """Write a multiple of a price.

    Examples
    --------
    >>> [share(price, "time") for price in (0.51, 1.0, 2.05, 10.4, 0.23)]
    ['Half the time', 'The same time', 'Twice the time', '10× the time', '0.23× the time']
    """
    named = (("Half the", 0.5), ("The same", 1.0), ("Twice the", 2.0))
    for words, factor in named:
        if factor / ALIKE < price < factor * ALIKE:
            return f"{words} {noun}"
    return f"{multiple(price)} the {noun}"


def multiple(price: float) -> str:
    """Write a multiple in two digits, or all of its whole ones.

    Examples
    --------
    >>> multiple(0.234), multiple(9.51), multiple(123.4)
    ('0.23×', '9.5×', '123×')
    """
    return f"{price:.2g}×" if price < 9.95 else f"{price:.0f}×"


def _gain(known: float, found: float) -> str:
    """Compare an error with one that is not larger by more than rounding."""
    if found == 0 and known > 0:
        return "not off at all"
    if found * ALIKE >= known:
        return "as exact"
    return f"{_factor(known / found)} as exact"


def _factor(factor: float) -> str:
    """Write a factor, rounded down to a power of ten where it is large."""
    return f"over 10^{{{floor(log10(factor))}}}×" if factor >= POWERS_FROM else multiple(factor)
