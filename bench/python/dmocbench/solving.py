"""Solving one problem, or many instances of it."""

from __future__ import annotations

import inspect
from typing import Any, Mapping, Union

import numpy as np

from . import _core
from ._core import Error
from .problem import Problem


class NamedProblem:
    """A problem that is built in, or that a library has, with values of its parameters: problem("cart_pole", mass=2)."""

    def __init__(self, name, **values):
        self._handle = _core.ProblemHandle.named(name, {key: float(value) for key, value in values.items()})

    def handle(self):
        return self._handle

    @property
    def name(self):
        return self._handle.name

    @property
    def description(self):
        return self._handle.description

    def parameters(self):
        """The values of all parameters by name."""
        return dict(self._handle.parameters)

    def __repr__(self):
        return f"<problem {self.name}{' ' if self._handle.settings else ''}{self._handle.settings}>"


def problem(name: str, **values: float) -> NamedProblem:
    """The named problem, built in or from a library, with these values of its parameters."""
    return NamedProblem(name, **values)


AnyProblem = Union[Problem, type, NamedProblem, str]


def handle_of(problem: AnyProblem) -> _core.ProblemHandle:
    """The C++ handle of a problem: an instance or subclass of Problem, a named problem, or a name."""
    if isinstance(problem, str):
        problem = NamedProblem(problem)
    elif inspect.isclass(problem) and issubclass(problem, Problem):
        problem = problem()
    if not isinstance(problem, (Problem, NamedProblem)):
        raise Error(f"expected a problem, or its name, not {problem!r}")
    return problem.handle()


def _fill(asked, given):
    for name, value in given.items():
        try:
            setattr(asked, name, value)
        except TypeError:
            raise Error(f"{name}={value!r} is of the wrong type, expected one like {getattr(asked, name)!r}") from None
    return asked


class Stages:
    """Values at the stages of all intervals, a row each: t, q, v, u, p, y, psi_q, psi_p."""

    t: np.ndarray | None
    q: np.ndarray | None
    v: np.ndarray | None
    u: np.ndarray | None
    p: np.ndarray | None
    y: np.ndarray | None
    psi_q: np.ndarray | None
    psi_p: np.ndarray | None

    def __init__(self, answer: _core.Answer):
        self._answer = answer

    def __getattr__(self, name: str) -> Any:
        if name in type(self).__annotations__:
            return getattr(self._answer, "stage_" + name)
        raise AttributeError(f"stages have no {name}; they have {', '.join(type(self).__annotations__)}")


class Prices:
    """By how much the least cost grows per unit of the bound that acts: positive for a lower bound, negative for an upper
    one, 0 where none acts. None where nothing of the kind is bounded, or the solve ended without multipliers.

    q, v, y: of bounds at the nodes, a row each. stage_v, stage_u, path: of bounds of velocities, controls and path
    constraints at the stages, per unit of time: moving the bound by e(t) changes the least cost by the sum of
    h b_i price_i e(t_i). unknowns: a dict, of the ranges of parameters that the solve chose. horizon: of the bounds of T, 0
    where it is given. Integrals have theirs in `Solution.integral_prices`; values that are given at the ends have costates.
    """

    q: np.ndarray | None
    v: np.ndarray | None
    y: np.ndarray | None
    stage_v: np.ndarray | None
    stage_u: np.ndarray | None
    path: np.ndarray | None
    unknowns: dict[str, float]
    horizon: float | None

    def __init__(self, answer: _core.Answer):
        self._answer = answer

    def __getattr__(self, name: str) -> Any:
        if name in type(self).__annotations__:
            return getattr(self._answer, "price_" + name)
        raise AttributeError(f"prices have no {name}; they have {', '.join(type(self).__annotations__)}")


class Solution:
    """An answer: numbers, and arrays of the motion with a row per node (a row per stage in `stages`).

    status, message, is_solved; cost, iterations, seconds, setup_seconds, kkt_residual, constraint_violation,
    relative_jump, replay_error (norm of the distance from the end when the controls are replayed; printed by unit),
    largest_violation (of bounds and path constraints anywhere on the motion); t, q, v, p, psi_q, psi_p,
    psi = (psi_q, psi_p); stages.t, .q, .v, .u, .p.
    With first-order states y, psi_y and stages.y; unknowns: a dict of the parameters that the solve chose; integrals, and
    integral_prices: by how much the least cost grows per unit of the bound that acts; prices: of all other bounds (`Prices`).
    None where the solve ended without it. Arrays are views of C++ results; they may outlive the solution.
    """

    problem: str
    method: str
    tableau: str
    stage_count: int
    intervals: int
    solver: str
    status: str
    is_solved: bool
    cost: float | None
    iterations: int | None
    seconds: float
    setup_seconds: float | None
    kkt_residual: float | None
    constraint_violation: float | None
    relative_jump: float | None
    replay_error: float | None
    largest_violation: float | None
    coordinates: list[str]
    controls: list[str]
    t: np.ndarray | None
    q: np.ndarray | None
    v: np.ndarray | None
    p: np.ndarray | None
    psi_q: np.ndarray | None
    psi_p: np.ndarray | None
    first_order_states: list[str]
    y: np.ndarray | None
    psi_y: np.ndarray | None
    unknowns: dict[str, float]
    integrals: np.ndarray | None
    integral_prices: np.ndarray | None

    def __init__(self, answer: _core.Answer):
        self._answer = answer

    def __getattr__(self, name: str) -> Any:
        if name in type(self).__annotations__:
            return getattr(self._answer, name)
        if name.startswith("_"):
            raise AttributeError(name)
        if name == "u":
            raise AttributeError("a Solution has no u; controls act at stages: write solution.stages.u, at solution.stages.t")
        if name in self.coordinates + self.first_order_states + self.controls:
            raise AttributeError(f"a Solution has no {name}; write solution.column(\"{name}\")")
        raise AttributeError(f"a Solution has no {name}; it has {', '.join(type(self).__annotations__)}, stages, prices, psi, "
                             "message")

    @property
    def message(self) -> str:
        """The outcome of the solve, in a sentence."""
        return self._answer.message

    def estimated_error(self) -> float:
        """The estimated relative error of q, p and cost, from this answer alone. Throws Error if the solve failed, the
        horizon is free, bounds or path constraints are active, or there are first-order states, unknowns or integrals."""
        return self._answer.estimated_error()

    def __dir__(self):
        return sorted({*super().__dir__(), *type(self).__annotations__})

    @property
    def stages(self) -> Stages:
        """Values at the stages."""
        return Stages(self._answer)

    @property
    def prices(self) -> Prices:
        """What bounds cost."""
        return Prices(self._answer)

    @property
    def psi(self) -> np.ndarray | None:
        """The costates, (psi_q, psi_p) side by side: (N + 1) x 2n."""
        return None if self.psi_q is None or self.psi_p is None else np.hstack([self.psi_q, self.psi_p])

    def column(self, name: str) -> np.ndarray | None:
        """A coordinate or a first-order state at the nodes, or a control at the stages, by its name."""
        for names, table in ((self.coordinates, self.q), (self.first_order_states, self.y),
                             (self.controls, self._answer.stage_u)):
            if name in names:
                return None if table is None else table[:, names.index(name)]
        there = self.coordinates + self.first_order_states + self.controls
        raise Error(f"there is no {name}; there are {', '.join(there)}")

    def to_pandas(self) -> Any:
        """The nodes as a DataFrame of pandas: t, q, v, p and y by names."""
        import pandas

        columns = {"t": self.t}
        for prefix, table in (("", self.q), ("rate_", self.v), ("momentum_", self.p)):
            if table is None:
                raise Error(f"{self.status}: the solution has no motion")
            columns.update({prefix + name: table[:, i] for i, name in enumerate(self.coordinates)})
        columns.update({name: self.column(name) for name in self.first_order_states})
        return pandas.DataFrame(columns)

    def __repr__(self):
        def text(value, form):
            return "none" if value is None else format(value, form)

        def counted(count, noun):
            return f"{text(count, 'd')} {noun}{'' if count == 1 else 's'}"

        lines = [f"{self.problem} by {self.method} ({self.tableau}, {counted(self.stage_count, 'stage')}, "
                 f"{counted(self.intervals, 'interval')}): {self.status}"]
        lines.append(f"  cost {text(self.cost, '.12g')}, {counted(self.iterations, 'iteration')} of {self.solver}, "
                     f"{self.seconds * 1e3:.3g} ms")
        if self.is_solved:
            lines.append(f"  replay error {self._answer.replay_in_words}; largest violation "
                         f"{text(self.largest_violation, '.2g')}")
        else:
            lines.append(f"  {self.message}")
        if advice := _remedies[self._answer.advice["remedy"]]:
            lines.append("  Try " + advice.format(**self._answer.advice))
        return "\n".join(lines)


# What may help after a failed or doubtful solve, by the remedy that its answer names.
_remedies = {
    "none": "",
    "more_time": "more time (most_seconds=) or fewer intervals.",
    "finite_formula": "bounds that keep the coordinates away from the singularity of that formula, and a guess within them.",
    "radians": "radians: {coordinate} changes by {size:g}, which looks like an angle in degrees.",
    "other_units": "other units: {coordinate} is about {size:.1g}, {smallest} about {smallest_size:.1g}; sizes near 1 suit solvers.",
    "longer_horizon": "a longer horizon than T = {size:g}, or wider bounds: the ends may be out of reach.",
    "solver_auto": "solver=\"auto\".",
    "several_solvers": "solver=\"auto\": interior_point, then ipopt, then a feasible motion as the start.",
    "common_start": "another start: start= with a solution by another method.",
    "another_guess": "another guess, or start= with a solution near the one you want.",
    "finer_grid": "accuracy=1e-4, or more intervals: with these controls {coordinate} ends {size:.2g} of its range from where it "
                  "should.",
    "feedback": "feedback to follow this trajectory. The system is unstable: with these controls alone {coordinate} ends {size:.2g} of "
                "its range from where it should.",
}


def solve(problem: AnyProblem, method: str = "dmoc", *, intervals: int = 128, tableau: str = "gauss", stages: int = 1,
          solver: str = "auto", start: Solution | None = None, accuracy: float | None = None, refinement: str = "h",
          nodes: Any = None, tolerance: float | None = None, most_iterations: int | None = None,
          most_seconds: float = 0.0, derivatives: str = "tape", form: str = "bolza", verbose: bool = False,
          options: Mapping[str, Any] | None = None) -> Solution:
    """Solves a problem and returns a `Solution`, whose status shows whether it converged.

    problem: an instance of a class derived from Problem, or the name of a built-in problem. method: one of `methods()`.
    intervals: N of a uniform grid; nodes: relative node times from 0 to 1 instead. start: a Solution to begin with,
    else the guess of the problem. accuracy: refines the grid ("h"), or also the number of stages ("hp"), until the
    estimated relative error is at most that; iterations and seconds are then of all grids together. most_seconds: of the
    call, its set-up and all grids together, 0 for no limit; then the status is "time limit", and the answer the last one.
    options: the solver's, by name. Throws Error on misuse.
    """
    if start is not None and not isinstance(start, Solution):
        raise Error(f"start= takes a Solution, not {type(start).__name__}; state a guess in the problem")
    given = {"method": method, "intervals": intervals, "tableau": tableau, "stages": stages, "solver": solver,
             "accuracy": accuracy, "refinement": refinement, "most_seconds": most_seconds, "derivatives": derivatives,
             "form": form, "verbose": verbose, "options": {key: str(value) for key, value in (options or {}).items()}}
    for name, value in (("nodes", nodes), ("tolerance", tolerance), ("most_iterations", most_iterations)):
        if value is not None:
            given[name] = value
    asked = _fill(_core.Asked(), given)
    return Solution(_core.solve(handle_of(problem), asked, start._answer if start is not None else None))


class Batch:
    """Answers to many instances, a row each: cost, status, is_solved, iterations; with motions=True also q (instances x
    nodes x n) and u (instances x stages of all intervals x m), NaN where there is none."""

    cost: np.ndarray
    status: np.ndarray
    is_solved: np.ndarray
    iterations: np.ndarray
    q: np.ndarray | None
    u: np.ndarray | None

    def __init__(self, arrays: Mapping[str, Any], n: int, m: int):
        self.cost = arrays["cost"]
        self.status = np.array(arrays["status"])
        self.is_solved = np.array(arrays["is_solved"], dtype=bool)
        self.iterations = arrays["iterations"]
        self.q = arrays["q"].reshape(len(self.cost), -1, n) if arrays["q"].size else None
        self.u = arrays["u"].reshape(len(self.cost), -1, m) if arrays["u"].size else None

    def __len__(self):
        return len(self.cost)

    def __repr__(self):
        return f"<{len(self)} instances, {int(self.is_solved.sum())} solved>"


def solve_batch(problem: AnyProblem, *, parameters: Mapping[str, Any] | None = None, start: Any = None, end: Any = None,
                method: str = "dmoc", intervals: int = 64, tableau: str = "gauss", stages: int = 1,
                tolerance: float | None = None, most_iterations: int | None = None, most_seconds: float = 0.0,
                threads: int = 0, motions: bool = False) -> Batch:
    """Solves many instances of one problem, eight side by side in vector registers, on all processors.

    parameters: a dict of names to arrays, one number per instance; start, end: arrays of states (q, v), a row of 2n
    numbers per instance. Missing values are the problem's. Both ends and the horizon must be fixed. most_seconds: of the
    whole batch, 0 for no limit; instances that are not solved by then are a "time limit". Returns a `Batch`. Throws Error
    on misuse.
    """
    handle = handle_of(problem)
    n, m = len(handle.coordinates), len(handle.controls)
    columns = {name: np.asarray(values, dtype=float).ravel() for name, values in (parameters or {}).items()}
    tables = [np.zeros((0, 2 * n)) if table is None else np.asarray(table, dtype=float) for table in (start, end)]
    for name, table in zip(("start", "end"), tables):
        if table.ndim != 2:
            raise Error(f"solve_batch: {name} has {table.ndim} dimensions, expected a row of {2 * n} numbers (q, v) per "
                        "instance")
    counts = {len(values) for values in columns.values()} | {len(table) for table in tables if len(table)}
    if len(counts) != 1:
        raise Error("solve_batch: arrays of parameters, start and end must have the same number of instances, got "
                    f"{', '.join(map(str, sorted(counts))) or 'none'}")
    count = counts.pop()
    values = np.column_stack(list(columns.values())) if columns else np.zeros((0, 0))
    given = {"method": method, "intervals": intervals, "tableau": tableau, "stages": stages, "threads": threads,
             "motions": motions, "most_seconds": most_seconds}
    given.update({name: value for name, value in (("tolerance", tolerance), ("most_iterations", most_iterations))
                  if value is not None})
    asked = _fill(_core.BatchAsked(), given)
    return Batch(_core.solve_batch(handle, asked, count, list(columns), values, *tables), n, m)
