"""Limits over values of the parameters of parts, and the designs that leave target motions free."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Mapping, NamedTuple, Optional, Sequence, Union, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._answer import Compiled, html_of, kept
from ._contact_checks import ContactNote, remarked
from ._described_joint import DescribedJoint
from ._errors import UsageError
from ._limits import REASONS
from ._motion import Motion, MotionLike, Motions
from ._native import Sweep as NativeSweep
from ._words import BearingRule, BestDesign, LimitKnownBy, Path, Progress, band_of, number, path_of, progress_of, text_of, word

if TYPE_CHECKING:
    import xarray

#: By what a limit of a sweep is known: its `known_by` are positions in this.
KNOWN_BY: tuple[LimitKnownBy, ...] = get_args(LimitKnownBy)


@dataclass(frozen=True)
class Target:
    """A motion that a design has to leave free.

    `motion` is a name that the joint knows, or a :class:`Motion`; `reach_deg` how far it must turn from its start, up to its
    range; `pelvic_tilt_deg` the anterior tilt of the posture, of a hip; `source` where the angle comes from. To find the best design its
    margin counts divided by `weight`, and a miss times `weight`.
    """

    name: str
    motion: MotionLike
    reach_deg: float
    pelvic_tilt_deg: float = 0
    source: str = ""
    weight: float = 1


TargetLike = Union[Target, tuple[str, MotionLike, float], tuple[str, MotionLike, float, float]]


class EndingPair(NamedTuple):
    """The meshes of either body between which motions end."""

    fixed: str
    mobile: str


@dataclass(frozen=True, eq=False)
class Design:
    """One choice of the swept parameters, and where each target ends with it, (T,) each, as :class:`Sweep` has them.

    `margin_deg` is the least of what the limits have over the reach; NaN if it is in contact in its reference pose. `quantities` are
    measures and pressures, if asked for, by their names; NaN where there is none.
    """

    values: dict[str, float]
    limits_deg: NDArray[np.float64]
    reason: NDArray[np.int8]
    known_by: NDArray[np.int8]
    ended_by: NDArray[np.int32]
    margin_deg: float
    quantities: dict[str, float] = field(default_factory=dict)

    @property
    def safe(self) -> bool:
        """Whether every target is free."""
        return self.margin_deg >= 0

    def __repr__(self) -> str:
        values = ", ".join(f"{name} {value:g}" for name, value in self.values.items())
        return f"Design({values}: {self.margin_deg:+.2f} deg)"


class SafeInterval(NamedTuple):
    """Values of the last parameter from `low` to `high` at which every target is free, with the others at `values`.

    `low_target` and `high_target` name what ends it there; None at the end of the axis.
    """

    values: dict[str, float]
    low: float
    high: float
    low_target: Optional[str]
    high_target: Optional[str]


@dataclass(frozen=True, eq=False, repr=False)
class Sweep(Compiled):
    """Limits of every design of a grid, made by :meth:`Joint.sweep`. With the axes of n1, n2, ... values and T targets:

    Attributes
    ----------
    axes : dict of (n,) float64
        The values of each swept parameter, by its name, in the order of the dimensions.
    units : dict of str
        "deg" or "mm", of each.
    targets : tuple of Target
    limits_deg : (n1, ..., T) float64
        Where each target ends, from its start. NaN of a design in contact in its reference pose.
    reason, known_by : (n1, ..., T) int8
        Positions in :data:`REASONS` and :data:`KNOWN_BY`: by the meshes, or in closed form.
    ended_by : (n1, ..., T) int32
        The position in `pairs` of the meshes that end it; -1 at the end of the range.
    pairs : tuple of EndingPair
    margin_deg : (n1, ...) float64
        The least of what the limits have over the targets' reach.
    safe : (n1, ...) bool
        Where every target is free: `margin_deg` 0 and more.
    probability : (n1, ...) float64 or None
        That a design is safe, over the standard deviations of the parameters, if asked for.
    quantities : dict of (n1, ...) float64
        Measures of the shape and pressures of each design, if asked for, by their names with the unit; NaN where there is none.
    safe_intervals : tuple of SafeInterval
        Along the last parameter, their ends to a hundredth of a step.
    safe_measure, window_measure : float
        Area (length, volume) of what is safe and of all that was swept, in the product of the parameters' units.
    best : Design or None
        As `best_by` says: the design of the largest margin, or the safe one nearest to the joint as it is; None if all are in contact in their
        reference poses.
    here : Design
        The joint as it is.
    notes : what the zone must be read with, each with a :class:`JointRemark`
    caveats : list of str
    best_by : {"largest_margin", "least_change"}
    """

    axes: dict[str, NDArray[np.float64]]
    units: dict[str, str]
    targets: tuple[Target, ...]
    limits_deg: NDArray[np.float64]
    reason: NDArray[np.int8]
    known_by: NDArray[np.int8]
    ended_by: NDArray[np.int32]
    pairs: tuple[EndingPair, ...]
    margin_deg: NDArray[np.float64]
    safe: NDArray[np.bool_]
    probability: Optional[NDArray[np.float64]]
    quantities: dict[str, NDArray[np.float64]]
    safe_intervals: tuple[SafeInterval, ...]
    safe_measure: float
    window_measure: float
    best: Optional[Design]
    here: Design
    notes: tuple[ContactNote, ...]
    caveats: list[str]
    best_by: BestDesign = "largest_margin"
    _native: Optional[NativeSweep] = None

    def __repr__(self) -> str:
        axes = " x ".join(f"{len(values)} {name}" for name, values in self.axes.items())
        return f"Sweep({axes}, {len(self.targets)} targets: {int(self.safe.sum())} of {self.safe.size} designs safe)"

    def _repr_html_(self) -> str:
        rows = [(name, f"{values[0]:g} to {values[-1]:g}") for name, values in self.axes.items()]
        rows.append(("safe", f"{int(self.safe.sum())} of {self.safe.size} designs"))
        return html_of("sweep", rows + [("best", repr(self.best)), ("here", repr(self.here))])

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over the swept parameters and the targets. Needs xarray."""
        import xarray

        over = tuple(self.axes)
        each = (*over, "target")
        variables: dict[str, Any] = {
            "limit_deg": (each, self.limits_deg), "reason": (each, np.array(REASONS)[self.reason]),
            "known_by": (each, np.array(KNOWN_BY)[self.known_by]),
            "ended_by": (each, np.array([*(f"{pair.mobile} on {pair.fixed}" for pair in self.pairs), ""])[self.ended_by]),
            "margin_deg": (over, self.margin_deg), "safe": (over, self.safe)}
        if self.probability is not None:
            variables["probability"] = (over, self.probability)
        variables.update({name: (over, values) for name, values in self.quantities.items()})
        return xarray.Dataset(variables, coords={
            **self.axes, "target": [each.name for each in self.targets],
            "reach_deg": ("target", [each.reach_deg for each in self.targets])})

    def _shown(self) -> NativeSweep:
        """What a report shows of it."""
        return kept(self._native, "sweep", "a report shows")

    def write(self, folder: Path) -> list[str]:
        """sweep.json, designs.csv, safe.csv and of two parameters zone.vtp, as `condyle sweep --out` writes them but without
        provenance, for `python3 -m condyle.plot`. Their paths are returned."""
        return kept(self._native, "sweep", "its files need").write(path_of(folder, "folder"))


def _axes_of(vary: Mapping[str, Sequence[float]]) -> list[tuple[str, float, float, float]]:
    if not isinstance(vary, Mapping):
        raise UsageError(f"vary: parameters by their names are needed, not {type(vary).__name__}")
    axes = []
    for name, values in vary.items():
        text_of(name, "vary")
        if not isinstance(values, (tuple, list)) or len(values) != 3:
            raise UsageError(f"{name}: a first and a last value and a step are needed, not {type(values).__name__}")
        first, last, step = (number(value, name) for value in values)
        axes.append((name, first, last, step))
    return axes


def _target_of(given: TargetLike, known: Motions) -> tuple[Any, ...]:
    if not isinstance(given, Target):
        if not isinstance(given, (tuple, list)) or not 3 <= len(given) <= 4:
            raise UsageError(f"targets: a Target, or name, motion and reach_deg are needed, not {type(given).__name__}")
        given = Target(*given)
    name = text_of(given.name, "targets")
    return (name, known.tuple_of(known[given.motion]), number(given.reach_deg, f"target {name}: reach_deg"),
            number(given.pelvic_tilt_deg, f"target {name}: pelvic_tilt_deg"), text_of(given.source, f"target {name}: source"),
            number(given.weight, f"target {name}: weight"))


def _force_of(given: ArrayLike) -> list[float]:
    components = [number(each, "force_n") for each in np.ravel(np.asarray(given, dtype=object))]
    if len(components) != 3:
        raise UsageError(f"force_n: three numbers are needed, not {len(components)}")
    return components


def _design_of(values: Sequence[float], axes: Sequence[str], found: Mapping[str, Any], margin_deg: float,
               quantities: dict[str, float]) -> Design:
    return Design(dict(zip(axes, map(float, values))), found["limits_deg"], found["reason"], found["known_by"],
                  found["ended_by"], margin_deg, quantities)


def sweep(joint: DescribedJoint, vary: Mapping[str, Sequence[float]], targets: Union[Path, Sequence[TargetLike]],
          band_samples: int, seed: Optional[int], measures: Sequence[str], load: Optional[str],
          force_n: Optional[ArrayLike], best: BestDesign, bearing: BearingRule, bearing_margin_mm: Optional[float],
          accept_reference_contact: bool, progress: Progress) -> Sweep:
    known = Motions(joint._native)
    asked: Union[str, list[tuple[Any, ...]]]
    if isinstance(targets, (list, tuple)):
        asked = [_target_of(each, known) for each in targets]
    else:
        asked = path_of(targets, "targets")
    if force_n is not None and load is None:
        raise UsageError("force_n: needs load, the pose that it is carried at")
    options = {
        "measures": [text_of(key, "measures") for key in ([measures] if isinstance(measures, str) else measures)],
        "load": None if load is None else text_of(load, "load"),
        "force_n": None if force_n is None else _force_of(force_n),
        "band": band_of(band_samples, seed),
        "least_change": word(best, "best", BestDesign) == "least_change",
        "count_bearing": word(bearing, "bearing", BearingRule) == "count",
        "bearing_margin_mm": None if bearing_margin_mm is None else number(bearing_margin_mm, "bearing_margin_mm"),
        "accept_reference_contact": bool(accept_reference_contact)}
    found = _native.sweep(joint._asked, _axes_of(vary), asked, options, progress_of(progress))
    axes = dict(found["axes"])
    names, shape = list(axes), tuple(len(values) for values in axes.values())
    resolved = tuple(Target(name, known.motion_of(motion), reach, tilt, source, weight)
                     for name, motion, reach, tilt, source, weight in found["targets"])
    limits = {key: found[key].reshape(*shape, len(resolved)) for key in ("limits_deg", "reason", "known_by", "ended_by")}
    margin = found["margin_deg"].reshape(shape)
    width = len(found["quantity_names"])
    quantities = {name: found["quantities"][i::width].reshape(shape) for i, name in enumerate(found["quantity_names"])}
    best_design: Optional[Design] = None
    if found["best"] is not None:
        at = np.unravel_index(found["best"], shape)
        best_design = _design_of([axis[i] for axis, i in zip(axes.values(), at)], names,
                          {key: values[at] for key, values in limits.items()}, float(margin[at]),
                          {name: float(values[at]) for name, values in quantities.items()})
    values, ends = found["here"]
    over = ends["limits_deg"] - np.array([each.reach_deg for each in resolved])
    here = _design_of(values, names, ends, math.nan if np.isnan(over).any() else float(over.min()),
                      dict(zip(found["quantity_names"], found["quantities_here"])))

    def named(target: Optional[int]) -> Optional[str]:
        return None if target is None else resolved[target].name

    def interval(line: int, low: float, high: float, low_target: Optional[int], high_target: Optional[int]) -> SafeInterval:
        at = np.unravel_index(line, shape[:-1]) if len(shape) > 1 else ()
        return SafeInterval({name: float(axes[name][i]) for name, i in zip(names, at)}, low, high, named(low_target),
                            named(high_target))

    probability = found["probability"]
    return Sweep(
        axes, {name: joint.parameters[name].unit for name in names}, resolved, limits["limits_deg"], limits["reason"], limits["known_by"], limits["ended_by"],
        tuple(EndingPair(*each) for each in found["pairs"]), margin, margin >= 0,
        None if probability is None else probability.reshape(shape), quantities,
        tuple(interval(*each) for each in found["safe_intervals"]), found["safe_measure"], found["window_measure"], best_design, here,
        remarked(found["notes"]), found["caveats"], best, found["sweep"])
