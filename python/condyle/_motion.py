"""Motions of a joint, by the names of its angles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Sequence, Union

from . import _native
from ._answer import ByName
from ._errors import UsageError, unknown
from ._native import Joint as NativeJoint
from ._words import number, text_of


class Angles(ByName[float]):
    _what = "angle"


@dataclass(frozen=True)
class Motion:
    """One joint angle changes from where `start_deg` has it, the other two are held.

    `vary` is the angle's name at the joint; under its negative name ("extension") it turns that way. `start_deg` are
    the three angles by their positive names; those left out are 0. `range_deg` is how far it may turn, above 0.
    """

    name: str
    vary: str
    range_deg: float
    start_deg: Mapping[str, float]

    def __repr__(self) -> str:
        start = ", ".join(f"{name} {value:g}" for name, value in self.start_deg.items() if value)
        return f"Motion({self.name!r}: {self.vary} up to {self.range_deg:g} deg{' from ' + start if start else ''})"


MotionLike = Union[str, Motion]


class Motions:
    """The motions that a joint knows, and its angles between words and the compiled part."""

    def __init__(self, joint: NativeJoint) -> None:
        self.angles = tuple(joint.angle_names)
        self.is_hinge = joint.kind == "hinge"
        self.known = tuple(self.motion_of(found) for found in _native.motions(joint))

    def motion_of(self, found: tuple[Any, ...]) -> Motion:
        name, vary, sense, start, range_deg = found
        return Motion(name, self.angles[vary][0 if sense > 0 else 1], range_deg, self.named(start))

    def named(self, degrees: Sequence[float]) -> Angles:
        """The three angles by their positive names."""
        return Angles((positive, value) for (positive, _), value in zip(self.angles, degrees))

    def angle(self, name: str, what: str) -> tuple[int, int]:
        """Which of the three, and its sense under that name."""
        known = tuple(each for pair in self.angles for each in pair)
        if name not in known:
            raise unknown(what, name, known)
        place = known.index(name)
        return place // 2, 1 - 2 * (place % 2)

    def positive_angle(self, name: str, what: str) -> int:
        which, sense = self.angle(name, what)
        if sense < 0:
            raise UsageError(f"{what}: {name} is {self.angles[which][0]} with the opposite sign")
        return which

    def start(self, start_deg: Mapping[str, float]) -> list[float]:
        if not isinstance(start_deg, Mapping):
            raise UsageError(f"start_deg: angles by their names are needed, not {type(start_deg).__name__}")
        angles = [0.0, 0.0, 0.0]
        for name, value in start_deg.items():
            which, sense = self.angle(name, "start_deg")
            angles[which] = sense * number(value, f"start_deg: {name}") + 0.0
        if any(angles[1:]):
            self.refuse_of_hinge("start_deg")
        return angles

    def refuse_of_hinge(self, what: str) -> None:
        """For angles other than the first, as poses are read."""
        if self.is_hinge:
            raise UsageError(f"{what}: a hinge rotates in {self.angles[0][0]} only")

    def tuple_of(self, motion: Motion) -> tuple[Any, ...]:
        vary, sense = self.angle(motion.vary, "vary")
        return (text_of(motion.name, "motion"), vary, sense, self.start(motion.start_deg),
                number(motion.range_deg, "range_deg"))

    def __getitem__(self, named: MotionLike) -> Motion:
        """The motion of that name, or the one given."""
        if isinstance(named, Motion):
            return named
        if isinstance(named, str):
            wanted = named.lower().replace(" ", "_").replace("-", "_")
            for motion in self.known:
                if motion.name == named or motion.name.lower() == wanted:
                    return motion
        raise unknown("motion", named, (each.name for each in self.known))

    def asked(self, motions: Sequence[MotionLike]) -> tuple[Motion, ...]:
        if isinstance(motions, str) or not isinstance(motions, Sequence):
            raise UsageError(f"motions: a list of names is needed, not {type(motions).__name__}")
        return tuple(self[each] for each in motions)
