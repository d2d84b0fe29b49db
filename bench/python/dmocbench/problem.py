"""The statement of a problem: a class derived from Problem, with declarative members and formulas."""

from __future__ import annotations

import copy
import difflib
import inspect
import math
import re
from typing import Any, Callable, Mapping, Sequence, Union

import numpy as np

from . import _core
from ._core import Error
from .points import Named, Point, named

_infinity = math.inf

Numbers = Union[float, Sequence[float], Mapping[str, float], None]
"""One number for all entries, a list of numbers, or a dict from names of entries to numbers."""

# Members of the C++ class as messages name them, and as they are called here.
_core.spell_members([
    ("initial_state", "start"), ("final_state", "end"), ("bounds().first", "start"), ("bounds().last", "end"),
    ("bounds().interior", "waypoints"), ("bounds().horizon", "horizon"), ("bounds().", "bounds of "),
    ("configuration_names", "q"), ("control_names", "u"), ("first_order_names", "y"),
    ("Problem::first_order_names", "y"), ("Problem::", ""),
    ("varying()", "a formula"), ("parameter()", "its number"),
])


class _Vector:
    """Declares the entries of a vector."""

    def __init__(self, kind, names, unit, bounds):
        for name in names:
            if not isinstance(name, str) or not name.isidentifier():
                raise Error(f"{kind} need names such as \"theta\", not {name!r}")
            if hasattr(Named, name):
                raise Error(f"{kind} cannot be named {name}, which is already an attribute of numpy arrays")
        if len(set(names)) < len(names):
            raise Error(f"two {kind} have the same name: {', '.join(names)}")
        self.names = tuple(names)
        self.units = _per_name(unit, names, f"unit of {kind}", str)
        self.bounds = bounds

    def limits(self, part):
        """Returns the arrays of lower and upper bounds of a part."""
        lower, upper = self.bounds[part]
        return (
            _numbers(lower, self.names, f"the lower bounds of {', '.join(self.names)}", -_infinity),
            _numbers(upper, self.names, f"the upper bounds of {', '.join(self.names)}", _infinity),
        )


def _per_name(value, names, what, kind):
    """A value for each name, from one value for all, a list, or a dict by names."""
    if isinstance(value, kind):
        return [value] * len(names)
    if isinstance(value, dict):
        _require_known(value, names, what)
        return [value.get(name, "") for name in names]
    values = list(value)
    _require_entries(values, names, what)
    return values


def _require_entries(values, names, what):
    if len(values) != len(names):
        raise Error(f"{what} has {len(values)} {'entry' if len(values) == 1 else 'entries'}, expected {len(names)}")


def _require_known(given, names, what):
    for name in given:
        if name not in names:
            close = difflib.get_close_matches(str(name), names, 1)
            hint = f"; did you mean {close[0]}?" if close else f"; the names are {', '.join(names) or 'none'}"
            raise Error(f"{what} has an unknown entry {name}{hint}")


def _numbers(value, names, what, default):
    """An array with a number for each name, from one for all, a list, or a dict by names; `default` for missing ones."""
    if value is None:
        return np.full(len(names), float(default))
    if isinstance(value, dict):
        _require_known(value, names, what)
        return np.array([_number(value.get(name, default), what) for name in names])
    if np.ndim(value) == 0:
        return np.full(len(names), _number(value, what))
    values = [_number(entry, what) for entry in value]
    _require_entries(values, names, what)
    return np.array(values)


def _number(value, what):
    if isinstance(value, str) or not hasattr(value, "__float__"):
        raise Error(f"{what}: expected a number, got {value!r}")
    return float(value)


def coordinates(*names: str, unit: str | Sequence[str] | Mapping[str, str] = "", lower: Numbers = None,
                upper: Numbers = None, rate_lower: Numbers = None, rate_upper: Numbers = None) -> Any:
    """Declares the configuration q by the names of its entries.

    unit: the unit of each entry (for pictures and tables). lower, upper: bounds on q at every node; rate_lower, rate_upper:
    bounds on q' at every stage. Each argument is one value for all entries, a list, or a dict by names.
    """
    return _Vector("coordinates", names, unit, {"q": (lower, upper), "v": (rate_lower, rate_upper)})


def controls(*names: str, unit: str | Sequence[str] | Mapping[str, str] = "", lower: Numbers = None,
             upper: Numbers = None) -> Any:
    """Declares the control u by the names of its entries, with bounds at every stage, as for `coordinates`."""
    return _Vector("controls", names, unit, {"u": (lower, upper)})


def first_order_states(*names: str, unit: str | Sequence[str] | Mapping[str, str] = "", lower: Numbers = None,
                       upper: Numbers = None) -> Any:
    """Declares first-order states y by the names of their entries: quantities with a rate but no inertia, such as a mass or a
    current. Bounds hold at every node, as for `coordinates`."""
    return _Vector("first-order states", names, unit, {"y": (lower, upper)})


class parameter:
    """A number of a problem that users may set: Pendulum(length=2.0), problem.length = 2.0, or --set length=2.

    In formulas, self.length is a number, or a formula if the parameter varies between instances (`solve_batch`, sweeps).
    """

    def __init__(self, value: float, unit: str = "", meaning: str = "", lower: float = -_infinity,
                 upper: float = _infinity, whole: bool = False):
        self.value = _number(value, "the value of a parameter")
        self.unit = unit
        self.meaning = meaning
        self.lower = float(lower)
        self.upper = float(upper)
        self.whole = bool(whole)
        self.is_unknown = False
        self.name = ""

    def __set_name__(self, owner, name):
        self.name = name

    def check(self, value):
        value = _number(value, f"parameter {self.name}")
        _core.check_parameter(self.name, value, self.lower, self.upper, self.whole)
        return value

    def __get__(self, instance: Any, owner: Any = None) -> Any:
        if instance is None:
            return self
        reader = instance.__dict__.get("_reader")
        if reader is not None:
            return reader.read(self.name)
        value = instance._values.get(self.name, self.value)
        return int(value) if self.whole else value

    def __set__(self, instance: Any, value: float) -> None:
        if instance.__dict__.get("_reader") is not None:
            raise Error(f"parameter {self.name} cannot be set while the problem is solved")
        instance._values[self.name] = self.check(value)


class unknown(parameter):
    """A parameter that a solve chooses within its range, starting at `guess`. `Solution.unknowns` has the chosen value.
    Formulas must depend on the parameter; start, end, horizon and bounds use the guess."""

    def __init__(self, guess: float, unit: str = "", meaning: str = "", lower: float = -_infinity,
                 upper: float = _infinity):
        super().__init__(guess, unit, meaning, lower, upper)
        self.is_unknown = True


class between:
    """A number that a solve chooses between two bounds. guess: the value at which solves start, by default the middle."""

    def __init__(self, lower: float, upper: float, guess: float | None = None):
        self.lower = _number(lower, "between")
        self.upper = _number(upper, "between")
        if guess is None:
            guess = 0.5 * (self.lower + self.upper)
            if not math.isfinite(guess):
                raise Error("between: an infinite bound needs guess=")
        self.guess = _number(guess, "between: guess")


class free(between):
    """A number that a solve chooses without bounds. guess: the value at which solves start."""

    def __init__(self, guess: float = 0.0):
        super().__init__(-_infinity, _infinity, guess)


class state:
    """A state at an end of the horizon or at a waypoint. q, v, y: configuration, rates and first-order states, each as a list
    or a dict by names.

    Entries are numbers, `free(guess)` or `between(lower, upper, guess)`. v=None means at rest. A problem without
    coordinates has only y.
    """

    def __init__(self, q: Any = None, v: Any = None, y: Any = None):
        self.q = q
        self.v = v
        self.y = y

    def resolved(self, q_names, y_names, where):
        """(values, lower bounds, upper bounds) of q, v and y."""
        y = () if self.y is None and not y_names else self.y
        return {"q": _end_part(self.q, q_names, f"{where}: q"), "v": _end_part(self.v, q_names, f"{where}: v", is_rate=True),
                "y": _end_part(y, y_names, f"{where}: y")}


def at_rest(*q: Any, **by_name: Any) -> state:
    """A state at rest: at_rest(theta=0.0), or at_rest([0.0, 1.0])."""
    if len(q) > 1 or (q and by_name):
        raise Error("at_rest takes coordinates by name, or one list of coordinates")
    return state(q[0] if q else by_name)


def _end_part(part, names, what, is_rate=False):
    if part is None:
        part = [0.0] * len(names) if is_rate else None
    if part is None:
        raise Error(f"{what} is missing; its entries are {', '.join(names)}")
    if isinstance(part, dict):
        _require_known(part, names, what)
        missing = [name for name in names if name not in part]
        if missing and not is_rate:
            raise Error(f"{what} lacks {', '.join(missing)}; write free() for free entries")
        part = [part.get(name, 0.0) for name in names]
    if isinstance(part, between):
        part = [part] * len(names)
    if np.ndim(part) == 0 and not isinstance(part, (list, tuple)):
        part = [part]
    part = list(part)
    _require_entries(part, names, what)
    entries = [entry if isinstance(entry, between) else _fixed(entry, what) for entry in part]
    return tuple(np.array([getattr(entry, side) for entry in entries]) for side in ("guess", "lower", "upper"))


def _fixed(value, what):
    number = _number(value, what)
    if not math.isfinite(number):
        raise Error(f"{what} is {number}, not a finite number")
    return between(number, number, number)


class motion:
    """A guess from arrays, linear between the times t. q: an array len(t) x n; v: by default the slopes of q; u: by
    default 0; y: by default the straight line between the ends. t is in the problem's time; for a different horizon, the
    guess is stretched."""

    def __init__(self, t: Any, q: Any, v: Any = None, u: Any = None, y: Any = None):
        self.t = np.asarray(t, dtype=float)
        if self.t.ndim != 1 or len(self.t) < 2 or not np.all(np.diff(self.t) > 0.0):
            raise Error("motion: t must have at least two times, in ascending order")
        self.q = _table(q, self.t, "q")
        self.v = np.gradient(self.q, self.t, axis=0) if v is None else _table(v, self.t, "v")
        self.u = None if u is None else _table(u, self.t, "u")
        self.y = None if y is None else _table(y, self.t, "y")

    def at(self, t, horizon):
        """(q, v, u, y) at a time; None for missing tables."""
        t = self.t[0] + t / horizon * (self.t[-1] - self.t[0])
        return tuple(None if part is None else np.array([np.interp(t, self.t, column) for column in part.T])
                     for part in (self.q, self.v, self.u, self.y))


def _table(values, t, name):
    table = np.atleast_1d(np.asarray(values, dtype=float))
    table = table.reshape(-1, 1) if table.ndim == 1 else table
    if table.ndim != 2 or len(table) != len(t):
        raise Error(f"motion: {name} has {len(table)} rows, expected one for each of the {len(t)} times")
    return table


_declared = {"q", "u", "y", "start", "end", "horizon", "bounds", "waypoints", "guess", "cost_scale", "name", "source",
             "time_unit", "reference", "path_constraint_names", "boundary_condition_names"}
_formulas = {"lagrangian", "force", "running_cost", "first_order_rates", "integrands", "path_constraints", "constraints",
             "velocity_constraints",
             "boundary_conditions", "final_cost", "symmetry", "picture"}
_members = _declared | _formulas


class Problem:
    """A mechanical optimal control problem: minimise the integral of `running_cost` plus `final_cost`.

    Derive a class from Problem and state

    q = coordinates("theta", ...), u = controls("tau", ...) (may be left out), any number of `parameter`s; a problem
    without q has only y, and all methods then have the same solution;
    horizon: a number, or between(lower, upper, guess) for a free horizon;
    start, end: a `state` or `at_rest` each;
    lagrangian(self, x): L(q, v, t); force(self, x): the generalised force, n entries (may be left out);
    running_cost(self, x): the integrand of the cost.

    Optional:

    final_cost(self, last): the cost of the final state, where last.t is the horizon;
    boundary_conditions(self, first, last) = 0: conditions on both ends;
    constraints(self, q) = 0: constraints of a mechanism in redundant coordinates; velocity_constraints(self, q, v) = 0:
    constraints that are linear in v, as for wheels and blades;
    path_constraints(self, x) >= 0, or within bounds = {"path": (lower, upper)}, where equal bounds make an equality; they may
    use self.constraint_multipliers(x);
    waypoints: a dict from shares of the horizon to state(...), the conditions at these times; omitted parts and entries are
    free;
    integrands(self, x): functions whose integrals over the horizon lie within bounds = {"integrals": (lower, upper)};
    y = first_order_states("mass", ...) with first_order_rates(self, x), used as x.y.mass: quantities with a rate but no
    inertia; L is varied with y held fixed;
    any number of `unknown`s: parameters that a solve chooses;
    bounds: a dict from "q", "v", "u", "y", "path" or "integrals" to (lower, upper), needed for the latter two and for bounds
    that depend on parameters; each side is one number for all entries, a list, a dict by names, or None;
    guess(self, t) -> (q, v), (q, v, u) or (q, v, u, y), or a `motion`: the trajectory at which solves start;
    symmetry(self, q): the generator of a group action, n entries;
    cost_scale: the factor by which the cost is multiplied for solvers;
    picture(self, x): a dict from names to a formula or (formula, unit); name, source, time_unit ("s", 1.0), reference
    (cost, digits, certificate), path_constraint_names, boundary_condition_names: words for tables and figures.

    start, end, horizon, bounds, waypoints and cost_scale may also be methods if they depend on parameters. The docstring
    of the class describes the problem. Formulas are traced once: they may contain loops and function calls, but may not
    branch on x. They may contain functions of dmocbench (sin, sqrt, smooth_abs, Spline, ...), the same functions of numpy,
    and arrays of formulas.
    """

    q: Any
    horizon: Any
    start: Any
    end: Any
    lagrangian: Callable[..., Any]

    def __init__(self, **values: float):
        for name, value in values.items():
            self._require_parameter(name)
            setattr(self, name, value)

    def __new__(cls, *_arguments, **_values):
        instance = super().__new__(cls)
        instance._values = {}
        return instance

    def __repr__(self):
        values = ", ".join(f"{name}={value:g}" for name, value in self._values.items())
        return f"{type(self).__name__}({values})"

    def handle(self) -> _core.ProblemHandle:
        """The checked problem for C++. Raises Error if something is missing or does not fit."""
        return _core.ProblemHandle(self)

    def parameters(self) -> dict[str, float]:
        """The values of all parameters by name."""
        return {name: getattr(self, name) for name in _parameters_of(type(self))}

    # Called from C++.

    def _require_parameter(self, name):
        names = list(_parameters_of(type(self)))
        if name not in names:
            raise Error(f"{self._problem_name()} has no parameter {name}; it has {', '.join(names) or 'none'}")

    def constraint_multipliers(self, x):
        """The multipliers of `constraints`, followed by the multipliers of `velocity_constraints`, as formulas of x for use in
        path_constraints. The force on the system is minus the gradients times the multipliers."""
        reader = self.__dict__.get("_reader")
        if reader is None:
            raise Error("constraint_multipliers can be used only in path_constraints while the problem is solved")
        return reader.constraint_multipliers(x.q, x.v, x.u, x.y, x.t)

    def _bound(self, reader):
        self._check()
        bound = copy.copy(self)
        bound._values = dict(self._values)
        bound.__dict__["_reader"] = reader
        return bound

    def _check(self):
        _check_members(self)

    def _problem_name(self):
        name = getattr(type(self), "name", None)
        return name if isinstance(name, str) else re.sub(r"(?<!^)(?<!_)(?=[A-Z])", "_", type(self).__name__).lower()

    def _coordinate_names(self):
        return list(self._coordinates().names)

    def _coordinates(self):
        return getattr(self, "q", None) or coordinates(_core.no_configuration)

    def _control_names(self):
        return list(self._controls().names)

    def _controls(self):
        return getattr(self, "u", None) or controls()

    def _first_order_names(self):
        return list(self._first_order_states().names)

    def _first_order_states(self):
        return getattr(self, "y", None) or first_order_states()

    def _declared_parameters(self):
        return [(one.name, one.value, one.unit, one.meaning, one.lower, one.upper, one.whole,
                 one.is_unknown)
                for one in _parameters_of(type(self)).values()]

    def _stated_members(self):
        return [name for name in _members if getattr(self, name, None) is not None]

    def _has_constant_numbers(self):
        constants = (state, between, int, float, dict, type(None))
        stated = [inspect.getattr_static(self, name, None) for name in ("start", "end", "horizon", "bounds", "waypoints")]
        return all(isinstance(value, constants) for value in stated)

    def _value_of(self, name):
        value = getattr(self, name)
        return value() if callable(value) else value

    def _number_of(self, name):
        return _number(self._value_of(name), name)

    def _point(self, q, v, u, t, y):
        names = self._coordinates().names
        control = None if u is None else named(u, self._controls().names, "u")
        return Point(named(q, names, "q"), named(v, names, "v"), control, t, named(y, self._first_order_names(), "y"))

    def _coordinates_at(self, q, letter="q"):
        return named(q, self._coordinates().names, letter)

    def _end(self, name):
        end = self._value_of(name)
        if not isinstance(end, state):
            raise Error(f"{name} is {end!r}, expected state(...) or at_rest(...)")
        if getattr(self, "q", None) is None:  # a configuration that rests
            if end.q is not None or end.v is not None:
                raise Error(f"{name} has q or v, but there are no coordinates; write state(y=...)")
            rest = 0.0 if name == "start" else free()
            end = state([rest], [rest], end.y)
        return end.resolved(self._coordinate_names(), self._first_order_names(), name)

    def _horizon(self):
        horizon = self._value_of("horizon")
        if isinstance(horizon, free):
            raise Error("horizon is free(...), but it needs bounds; write between(lower, upper, guess), where lower > 0")
        if isinstance(horizon, between):
            return horizon.guess, horizon.lower, horizon.upper
        number = _number(horizon, "horizon")
        return number, number, number

    def _bounds(self):
        declared = {"q": self._coordinates(), "v": self._coordinates(), "u": self._controls(), "y": self._first_order_states()}
        bounds = {part: vector.limits(part) for part, vector in declared.items()}
        stated = self._value_of("bounds") if getattr(self, "bounds", None) is not None else {}
        if not isinstance(stated, dict):
            raise Error(f"bounds is {type(stated).__name__}, expected a dict such as {{\"u\": (lower, upper)}}")
        for part, limits in stated.items():
            what = f"bounds[{part!r}]"
            if part not in (*bounds, "path", "integrals"):
                raise Error(f"bounds has an entry {part!r}; the entries are {', '.join(bounds)}, path and integrals")
            if not isinstance(limits, (list, tuple)) or len(limits) != 2:
                raise Error(f"{what} is {limits!r}, expected (lower, upper)")
            if part in declared:
                names = declared[part].names
                bounds[part] = tuple(_numbers(side, names, what, default)
                                     for side, default in zip(limits, (-_infinity, _infinity)))
            else:
                bounds[part] = self._bounds_of_formulas(limits, what, part)
        return bounds

    def _waypoints(self):
        """A list of (share of the horizon, bounds of the given parts), in the order of time."""
        stated = self._value_of("waypoints") if getattr(self, "waypoints", None) is not None else {}
        if not isinstance(stated, dict):
            raise Error(f"waypoints is {type(stated).__name__}, expected a dict such as {{0.5: state(q)}}")
        result = []
        for time, at in stated.items():
            where = f"waypoints[{time!r}]"
            if not isinstance(at, state):
                raise Error(f"{where} is {at!r}, expected state(...)")
            parts = {}
            for part, given, names in (("q", at.q, self._coordinate_names()), ("v", at.v, self._coordinate_names()),
                                       ("y", at.y, self._first_order_names())):
                if given is None:
                    continue
                if isinstance(given, dict):
                    _require_known(given, names, f"{where}: {part}")
                    given = {**{name: free() for name in names}, **given}
                parts[part] = _end_part(given, names, f"{where}: {part}")[1:]
            result.append((_number(time, "waypoints: a time"), parts))
        return sorted(result, key=lambda entry: entry[0])

    def _bounds_of_formulas(self, limits, what, part):
        """Lower and upper bounds, with an entry per formula, or one for all formulas."""
        if getattr(self, {"path": "path_constraints", "integrals": "integrands"}[part], None) is None:
            raise Error(f"{what} has nothing to bound; write path_constraints(self, x) or integrands(self, x)")
        names = list(getattr(self, "path_constraint_names", [])) if part == "path" else []
        sides = []
        for side, default in zip(limits, (-_infinity, _infinity)):
            if isinstance(side, dict):
                sides.append(_numbers(side, names, what, default))
            else:
                entries = [default if side is None else side] if np.ndim(side) == 0 else side
                sides.append(np.array([_number(entry, what) for entry in entries]))
        if 1 not in map(len, sides) and len(sides[0]) != len(sides[1]):
            raise Error(f"{what} has {len(sides[0])} lower but {len(sides[1])} upper bounds; give equal numbers")
        return tuple(np.broadcast_arrays(*sides))

    def _numbers(self):
        numbers = {"horizon": self._horizon()}
        for where, name in (("first", "start"), ("last", "end")):
            for part, (guess, lower, upper) in self._end(name).items():
                numbers[f"{where}_{part}"] = guess
                numbers[f"{where}_{part}_bounds"] = (lower, upper)
        for part, limits in self._bounds().items():
            numbers[part + "_bounds"] = limits
        numbers["waypoints"] = self._waypoints()
        return numbers

    def _guess_at(self, t):
        guess = self.guess
        horizon = self._horizon()[0]
        point = guess.at(t, horizon) if isinstance(guess, motion) else guess(t)
        if not isinstance(point, (tuple, list)) or not 2 <= len(point) <= 4:
            raise Error(f"guess returns {type(point).__name__}, expected (q, v), (q, v, u) or (q, v, u, y)")
        q, v, u, y = (*point, None, None)[:4]
        if getattr(self, "q", None) is None:
            q = v = 0.0
        if u is None:
            u = np.zeros(len(self._controls().names))
        if y is None:
            first, last = (self._end(name)["y"][0] for name in ("start", "end"))
            y = first + t / horizon * (last - first)
        return tuple(np.atleast_1d(np.asarray(part, dtype=float)) for part in (q, v, u, y))

    def _words(self):
        cls = type(self)
        doc = cls.__doc__ if cls.__doc__ != Problem.__doc__ else None
        reference = getattr(self, "reference", None)
        if reference is not None:
            cost, digits, *words = reference
            reference = (float(cost), int(digits), words[0] if words else "stated by the user")
        return {
            "description": " ".join((doc or "").strip().split("\n\n")[0].split()).rstrip("."),
            "source": getattr(self, "source", ""),
            "reference": reference,
        }

    def _card(self):
        guess = getattr(getattr(self, "guess", None), "__doc__", None)
        return {
            **self._words(),
            "guess": " ".join((guess or "as stated").split()) if not isinstance(
                getattr(self, "guess", None), motion) else "linear between given points",
            "configuration_units": self._coordinates().units if any(self._coordinates().units) else [],
            "control_units": self._controls().units if any(self._controls().units) else [],
            "time_unit": tuple(getattr(self, "time_unit", ("s", 1.0))),
            "path_constraint_names": list(getattr(self, "path_constraint_names", [])),
            "boundary_condition_names": list(getattr(self, "boundary_condition_names", [])),
        }

    def _picture(self, x):
        if getattr(self, "picture", None) is None:
            pairs = [(getattr(self, "q", None) or coordinates(), x.q), (self._first_order_states(), x.y),
                     (self._controls(), x.u)]
            return [(name, unit, value) for declared, values in pairs
                    for name, unit, value in zip(declared.names, declared.units, values)]
        quantities = self.picture(x)
        return [(name, value[1], value[0]) if isinstance(value, tuple) else (name, "", value)
                for name, value in quantities.items()]


def _parameters_of(cls):
    """All parameters of a class by name; the parameters of its base classes come first."""
    found = {}
    for base in reversed(cls.__mro__):
        found.update({name: value for name, value in vars(base).items() if isinstance(value, parameter)})
    return found


def _check_members(problem):
    name = problem._problem_name()
    has_configuration = getattr(problem, "q", None) is not None or getattr(problem, "y", None) is None
    of_configuration = (("q", "q = coordinates(\"theta\")"), ("lagrangian", "lagrangian(self, x)"))
    for member, kind in ((of_configuration if has_configuration else ()) +
                         (("start", "start = at_rest(...)"), ("end", "end = at_rest(...)"), ("horizon", "horizon = 1.0"))):
        if getattr(problem, member, None) is None:
            raise Error(f"{name} lacks {member}; write {kind}")
    for member in () if has_configuration else ("lagrangian", "force", "constraints", "symmetry"):
        if getattr(problem, member, None) is not None:
            raise Error(f"{name} has {member}(self, ...), but no coordinates; write q = coordinates(\"theta\")")
    for member, maker in (("q", "coordinates"), ("u", "controls"), ("y", "first_order_states")):
        value = getattr(problem, member, None)
        if value is not None and not isinstance(value, _Vector):
            raise Error(f"{name}: {member} is {value!r}, expected {maker}(\"name\", ...)")
    if has_configuration and not problem.q.names:
        raise Error(f"{name}: q = coordinates() has no names")
    if has_configuration and getattr(problem, "u", None) is not None and getattr(problem, "force", None) is None:
        raise Error(f"{name} has controls but lacks force(self, x)")
    if getattr(problem, "y", None) is not None and getattr(problem, "first_order_rates", None) is None:
        raise Error(f"{name} has first-order states but lacks first_order_rates(self, x)")
    if getattr(problem, "running_cost", None) is None and getattr(problem, "final_cost", None) is None:
        raise Error(f"{name} lacks running_cost(self, x) and final_cost(self, last); write at least one of them")
    for member in _formulas:
        value = getattr(problem, member, None)
        if value is not None and not callable(value):
            raise Error(f"{name}: {member} is {value!r}, expected a method {member}(self, x)")
    _refuse_misspelt(problem, name)


def _refuse_misspelt(problem, name):
    for cls in type(problem).__mro__:
        if cls is Problem:
            return
        for member, value in vars(cls).items():
            if member.startswith("_") or member in _members or isinstance(value, parameter):
                continue
            close = difflib.get_close_matches(member, _members, 1, cutoff=0.85)
            if close and getattr(problem, close[0], None) is None:
                raise Error(f"{name} has a member {member}, which is not used; did you mean {close[0]}?")
