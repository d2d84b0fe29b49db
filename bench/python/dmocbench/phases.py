"""Problems with several phases: the trajectories between switches, and the conditions at the switches."""

from __future__ import annotations

import re
from typing import Any, Callable, Sequence

import numpy as np

from . import _core
from ._core import Error
from .points import Point, named
from .problem import Problem, _members, _parameters_of


class PhaseEnd(Point):
    """The state at an end of a phase. q, v, y: as in `Point`; p: momentum; t: time since the start of the first phase."""

    __slots__ = ("p",)

    def __init__(self, q, v, t, y, p):
        super().__init__(q, v, None, t, y)
        self.p = p


class PhaseEnds:
    """The ends of all phases: ends.NAME, or ends[i] in the order of the phases."""

    def __init__(self, names, ends):
        self._names = names
        self._ends = ends

    def __getitem__(self, number):
        return self._ends[number]

    def __len__(self):
        return len(self._ends)

    def __getattr__(self, name):
        if name.startswith("_") or name not in self._names:
            raise AttributeError(f"there is no phase {name}; choose one of {', '.join(self._names)}")
        return self._ends[self._names.index(name)]


class Phases(Problem):
    """A problem of several consecutive phases, each of which is a problem. The sum of the phases' costs is minimised.

    Derive a class from Phases and state the phases in order, as attributes that are objects of classes derived from
    Problem, or as phases = {"name": problem, ...}. A horizon = between(...) of a phase makes its duration an unknown,
    duration_NAME. The ends of a phase at a switch are open (`free`) where the switch determines them.

    Optional:

    NAME_to_NAME(self, before, after) = 0: the conditions of a switch between two phases; link(self, before, after) = 0: the
    conditions of all other switches, by default `continuous`; see also `momentum_kept`, `impact`, `dropped`, `new_foothold`.
    conditions(self, first, last) = 0: conditions that depend on several ends, such as last.NAME.q or last[-1].t, the
    total time.
    follows = {"name": "name of the previous phase"}: the order of phases with branches.
    Any number of parameters and of `unknown`s, such as impulses; source, reference and name.

    In a solution, coordinates, first-order states and controls are named PHASE_NAME, with the name of the phase in front.
    `Solution.phases` has the trajectory of every phase. Phases share parameters with the same name.
    """

    _values: dict[str, float]

    def __init__(self, **values: float):
        own = _parameters_of(type(self))
        super().__init__(**{name: value for name, value in values.items() if name in own})
        for name, value in values.items():
            if name not in own:
                self._require_parameter(name)
                self._values[name] = float(value)

    def parameters(self) -> dict[str, float]:
        """The values of all parameters by name, including the parameters of the phases."""
        return dict(self.handle().parameters)

    # Called from C++.

    def _stated_phases(self):
        found = {}
        for cls in reversed(type(self).__mro__):
            found.update({name: value for name, value in vars(cls).items() if isinstance(value, Problem)})
        found.update({name: value for name, value in vars(self).items() if isinstance(value, Problem)})
        found.update(self._value_of("phases") if getattr(self, "phases", None) is not None else {})
        for name, problem in found.items():
            if isinstance(problem, Phases):
                raise Error(f"{self._problem_name()}: phase {name} has phases of its own; state all phases in one class")
            if not re.fullmatch("[A-Za-z][A-Za-z0-9_]*", name):
                raise Error(f"{self._problem_name()}: phases need names such as \"fall\", not {name!r}")
        return found

    def _phase_list(self):
        """(name, problem, number of the phase that it follows or None) of every phase."""
        names = list(found := self._stated_phases())
        follows = getattr(self, "follows", {})
        for name in [*follows, *follows.values()]:
            if name not in names:
                raise Error(f"{self._problem_name()}: follows refers to {name}, which is not a phase; the phases are "
                            f"{', '.join(names)}")
        return [(name, _core.ProblemHandle(problem), names.index(follows[name]) if name in follows else None)
                for name, problem in found.items()]

    def _require_parameter(self, name):
        shared = {key for phase in self._stated_phases().values() for key in _parameters_of(type(phase))}
        if name not in shared:
            super()._require_parameter(name)

    def _check(self):
        name = self._problem_name()
        if not self._stated_phases():
            raise Error(f"{name} has no phases; write fall = Flight(), with a class Flight derived from Problem")
        for member in sorted(_members - {"name", "source", "reference", "cost_scale"}):
            if getattr(self, member, None) is not None:
                raise Error(f"{name} states {member}, which is not used; state it in each phase")
        names = list(self._stated_phases())
        for member in vars(type(self)):
            before, found, after = member.partition("_to_")
            if found and callable(getattr(self, member)) and not (before in names and after in names):
                raise Error(f"{name}: {member} does not join two phases; the phases are {', '.join(names)}")

    def _stated_members(self):
        return [name for name in ("link", "conditions", "cost_scale") if getattr(self, name, None) is not None]

    def _end_at(self, q_names, y_names, q, v, t, y, p):
        return PhaseEnd(named(q, q_names, "q"), named(v, q_names, "v"), t, named(y, y_names, "y"), named(p, q_names, "p"))

    def _link(self, before_name, after_name, before, after):
        link = getattr(self, f"{before_name}_to_{after_name}", None) or getattr(self, "link", None) or continuous
        return link(before, after)

    def _conditions(self, names, first, last):
        return self.conditions(PhaseEnds(names, first), PhaseEnds(names, last))


class PhaseMotion:
    """The trajectory of one phase in a solution. t, q, v, p, psi_q, psi_p, y, psi_y: arrays with a row per node, in the time of
    the whole problem; stages_t, u: arrays with a row per stage; duration; coordinates, controls, first_order_states: lists of
    names."""

    t: np.ndarray
    q: np.ndarray
    v: np.ndarray
    p: np.ndarray
    psi_q: np.ndarray
    psi_p: np.ndarray
    y: np.ndarray
    psi_y: np.ndarray
    stages_t: np.ndarray
    u: np.ndarray
    coordinates: list[str]
    controls: list[str]
    first_order_states: list[str]

    def __init__(self, arrays):
        self.__dict__.update(arrays)
        self.duration = self.t[-1] - self.t[0]

    def column(self, name: str) -> np.ndarray:
        """A coordinate or a first-order state at the nodes, or a control at the stages, by its name."""
        for names, table in ((self.coordinates, self.q), (self.first_order_states, self.y), (self.controls, self.u)):
            if name in names:
                return table[:, names.index(name)]
        there = self.coordinates + self.first_order_states + self.controls
        raise Error(f"there is no {name}; choose one of {', '.join(there)}")


def continuous(before: PhaseEnd, after: PhaseEnd) -> Sequence[Any]:
    """A switch at which q, v and y are continuous; p jumps if the inertia changes."""
    return _core.continuous(before, after)


def momentum_kept(before: PhaseEnd, after: PhaseEnd) -> Sequence[Any]:
    """A switch at which q, p and y are continuous, as in docking; v jumps if the inertia changes."""
    return _core.momentum_kept(before, after)


def dropped(before: PhaseEnd, after: PhaseEnd, amount: Sequence[Any]) -> Sequence[Any]:
    """A switch at which q and v are continuous and y falls by `amount` (an entry per state), as when a rocket drops a stage."""
    return _core.dropped(before, after, list(amount))


def impact(before: PhaseEnd, after: PhaseEnd, guard: Callable[[Any], Any], restitution: Any, impulse: Any) -> Sequence[Any]:
    """An impact on guard(q) = 0. q and y are continuous, p jumps by the gradient of the guard times `impulse` (an `unknown`
    per guard), and the velocity along the gradient is reversed and multiplied by `restitution`."""
    names = before.q._names
    return _core.impact(before, after, lambda q: guard(named(q, names, "q")), restitution, impulse)


def new_foothold(before: PhaseEnd, after: PhaseEnd, lagrangian: Callable[[Point], Any], on_old_foot: Callable[[Any], Any],
                 on_new_foot: Callable[[Any], Any]) -> Sequence[Any]:
    """A switch at which a new foot lands and stays while the old foot leaves. lagrangian(x): the Lagrangian in coordinates in
    which no foot is held; on_old_foot(q), on_new_foot(q): these coordinates as functions of the phases' coordinates before
    and after the switch."""
    return _core.new_foothold(before, after, lambda q, v, t, y: lagrangian(Point(named(q, (), "q"), named(v, (), "v"), None, t,
                                                                                 named(y, (), "y"))),
                              lambda q: on_old_foot(named(q, before.q._names, "q")),
                              lambda q: on_new_foot(named(q, after.q._names, "q")))
