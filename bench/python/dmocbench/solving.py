"""Solves one problem, or many instances of a problem."""

from __future__ import annotations

import html
import inspect
import types
from typing import Any, Callable, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import _core, plotting
from ._core import Error
from .names import CostForm, Derivatives, Method, Refinement, Solver, Tableau
from .phases import PhaseMotion
from .points import Point, with_names
from .problem import Problem, motion
from .words import arguments_of_solve, in_words_of_python, spelt


class NamedProblem:
    """A built-in problem or a problem from a library, with values of its parameters: problem("cart_pole", mass=2)."""

    def __init__(self, name, **values):
        with in_words_of_python():
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

    def __reduce__(self):
        return _named_problem, (self.name, self.parameters())

    def __repr__(self):
        return f"<problem {self.name}{' ' if self._handle.settings else ''}{self._handle.settings}>"


def _named_problem(name, values):
    return NamedProblem(name, **values)


def problem(name: str, **values: float) -> NamedProblem:
    """Returns the named problem, built in or from a library, with these values of its parameters."""
    return NamedProblem(name, **values)


AnyProblem = Union[Problem, type, NamedProblem, str]


def handle_of(problem: AnyProblem) -> _core.ProblemHandle:
    """The C++ handle of a problem: an instance or subclass of Problem, a named problem, or a name."""
    if isinstance(problem, str):
        problem = NamedProblem(problem)
    elif inspect.isclass(problem) and issubclass(problem, Problem):
        problem = problem()
    if not isinstance(problem, (Problem, NamedProblem)):
        raise Error(f"expected a problem or the name of a problem, not {problem!r}")
    return problem.handle()


def _fill(request, given):
    for name, value in given.items():
        if isinstance(getattr(request, name), int) and isinstance(value, float) and value.is_integer():
            value = int(value)
        try:
            setattr(request, name, value)
        except TypeError:
            raise Error(f"{name}={value!r} is of the wrong type, expected one like {getattr(request, name)!r}") from None
    return request


class Stages:
    """Values at the stages of all intervals, with a row per stage: t, q, v, u, p, y, psi_q, psi_p."""

    t: np.ndarray | None
    q: np.ndarray | None
    v: np.ndarray | None
    u: np.ndarray | None
    p: np.ndarray | None
    y: np.ndarray | None
    psi_q: np.ndarray | None
    psi_p: np.ndarray | None

    def __init__(self, arrays: _core.Motion | None):
        self._arrays = arrays

    def __getattr__(self, name: str) -> Any:
        if name in type(self).__annotations__:
            return None if self._arrays is None else getattr(self._arrays, "stage_" + name)
        raise AttributeError(f"stages have no {name}; they have {', '.join(type(self).__annotations__)}")


class Prices:
    """The prices of bounds. A price is the increase of the optimal cost per unit of the active bound: positive for a lower
    bound, negative for an upper bound, 0 where no bound is active. A price is None if there are no such bounds or the solve
    ended without multipliers.

    q, v, y: prices of bounds at the nodes, with a row per node. stage_v, stage_u, path: prices of bounds on velocities,
    controls and path constraints at the stages, per unit of time: moving the bound by e(t) changes the optimal cost by the
    sum of h b_i price_i e(t_i). unknowns: a dict of the prices of the ranges of parameters that the solve chose. horizon: the
    price of the bounds on T, 0 if T is fixed. Prices of integrals are in `Solution.integral_prices`; fixed values at the ends
    have costates.
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
        if name in ("unknowns", "horizon"):
            return getattr(self._answer, "price_" + name)
        if name in type(self).__annotations__:
            return None if self._answer.motion is None else getattr(self._answer.motion, "price_" + name)
        raise AttributeError(f"prices have no {name}; they have {', '.join(type(self).__annotations__)}")


class Solution:
    """A solution: numbers, and arrays of the trajectory with a row per node (or, in `stages`, a row per stage).

    status, message, is_solved; cost, iterations, seconds, setup_seconds, kkt_residual, constraint_violation,
    relative_jump, replay_error (norm of the distance from the final state after a replay; printed by unit),
    largest_violation (of bounds and path constraints along the whole trajectory); t, q, v, p, psi_q, psi_p,
    psi = (psi_q, psi_p); stages.t, .q, .v, .u, .p.
    With first-order states: y, psi_y and stages.y. unknowns: a dict of the parameters that the solve chose; integrals;
    integral_prices: the increase of the optimal cost per unit of the active bound; prices: the same for all other bounds
    (`Prices`). An attribute is None if the solve ended without it. Arrays are views of C++ results and may outlive the
    solution.
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
    coordinate_units: list[str]
    controls: list[str]
    control_units: list[str]
    time_unit: str
    picture: tuple[list[str], np.ndarray]
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

    def __init__(self, answer: Any):
        self._answer = answer

    def __getattr__(self, name: str) -> Any:
        if name in _arrays:
            return None if self._answer.motion is None else getattr(self._answer.motion, name)
        if name in type(self).__annotations__:
            return getattr(self._answer, name)
        if name.startswith("_"):
            raise AttributeError(name)
        if name == "u":
            raise AttributeError("a Solution has no u; controls act at stages; write solution.stages.u and solution.stages.t")
        if name in self.coordinates + self.first_order_states + self.controls:
            raise AttributeError(f"a Solution has no {name}; write solution.column(\"{name}\")")
        raise AttributeError(f"a Solution has no {name}; it has {', '.join(type(self).__annotations__)}, stages, prices, psi, "
                             "message")

    @property
    def message(self) -> str:
        """The outcome of the solve as a sentence."""
        return spelt(self._answer.message, arguments_of_solve)

    def estimated_error(self) -> float:
        """The relative error of q, p and cost, estimated from this solution alone. Raises Error if the solve failed, the
        horizon is free, bounds or path constraints are active, or there are first-order states, unknowns or integrals."""
        with in_words_of_python(arguments_of_solve):
            return self._answer.estimated_error()

    def __dir__(self):
        return sorted({*super().__dir__(), *type(self).__annotations__})

    @property
    def stages(self) -> Stages:
        """Values at the stages."""
        return Stages(self._answer.motion)

    @property
    def phases(self) -> dict[str, PhaseMotion]:
        """The trajectories of the phases of a problem with several phases, by the names of the phases."""
        return {name: PhaseMotion(arrays) for name, arrays in self._answer.phases.items()}

    @property
    def prices(self) -> Prices:
        """The multipliers of all bounds (`Prices`)."""
        return Prices(self._answer)

    @property
    def psi(self) -> np.ndarray | None:
        """The costates, (psi_q, psi_p) side by side: (N + 1) x 2n."""
        return None if self.psi_q is None or self.psi_p is None else np.hstack([self.psi_q, self.psi_p])

    def column(self, name: str) -> np.ndarray | None:
        """A coordinate or a first-order state at the nodes, or a control at the stages, by its name."""
        for names, table in ((self.coordinates, self.q), (self.first_order_states, self.y),
                             (self.controls, self.stages.u)):
            if name in names:
                return None if table is None else table[:, names.index(name)]
        there = self.coordinates + self.first_order_states + self.controls
        raise Error(f"there is no {name}; choose one of {', '.join(there)}")

    def at(self, t: Any) -> Point:
        """The trajectory at a time, or at an array of times, as a point x: x.q, x.v, x.u, x.y, by index or by name, as in
        formulas. For an array of times, x has a row per time. q is piecewise cubic and v is its derivative; u is linear between
        the stages, or the polynomial through the stages of an interval; y is linear between the nodes. Raises Error outside
        the horizon."""
        if self._answer.motion is None:
            raise Error(f"{self.status}: the solution has no trajectory")
        times = np.asarray(t, dtype=float)
        tables = self._answer.motion.at(times.ravel())
        names = (self.coordinates, self.coordinates, self.controls, self.first_order_states)
        q, v, u, y = (with_names(table.reshape(*times.shape, table.shape[-1]), known, kind)
                      for table, known, kind in zip(tables, names, "qvuy"))
        return Point(q, v, u, t, y)

    def plot(self, *names: str) -> Any:
        """Draws coordinates, first-order states and controls over time with matplotlib, with a panel for each unit. Lines
        are the trajectory (`at`), dots its nodes and stages. names: draw only these. Returns an array of the axes; in a script,
        matplotlib.pyplot.show() opens the window, and axes[0].figure.savefig("solution.png") writes a file."""
        return plotting.plot(self, *names)

    def animate(self, shape: Callable[[Any], Any] | None = None, *, frames: int = 100, seconds: float | None = None) -> Any:
        """Returns a matplotlib animation of the trajectory. shape: a function of a point x (`at`) that returns the points
        (x, y) of a line, such as the joints of an arm; by default the points of the problem's picture. seconds: the duration
        of the animation, by default the horizon. Keep a reference to the returned animation; its save("motion.gif") writes a
        file, and IPython.display.HTML(animation.to_jshtml()) shows it in a notebook."""
        return plotting.animate(self, shape, frames=frames, seconds=seconds)

    def to_pandas(self, at: str = "nodes") -> Any:
        """Returns a pandas DataFrame with named columns. at="nodes": a row per node with t, q, rate_NAME, momentum_NAME, y and
        the controls at the nodes (`at`); at="stages": a row per stage with t, q, rate_NAME, momentum_NAME, y and the controls
        as solved."""
        import pandas

        if at not in ("nodes", "stages"):
            raise Error(f'at= takes "nodes" or "stages", not {at!r}')
        part: Any = self if at == "nodes" else self.stages
        if part.t is None:
            raise Error(f"{self.status}: the solution has no trajectory")
        columns = {"t": part.t}
        for prefix, table in (("", part.q), ("rate_", part.v), ("momentum_", part.p)):
            columns.update({prefix + name: table[:, i] for i, name in enumerate(self.coordinates)})
        columns.update({name: part.y[:, i] for i, name in enumerate(self.first_order_states)})
        controls = self.at(self.t).u if at == "nodes" else self.stages.u
        columns.update({name: np.asarray(controls)[:, i] for i, name in enumerate(self.controls)})
        return pandas.DataFrame(columns)

    def __copy__(self) -> Solution:
        return Solution(self._answer)  # which never changes

    def __deepcopy__(self, _memo: Any) -> Solution:
        return Solution(self._answer)

    def __getstate__(self) -> dict[str, Any]:
        """All numbers, including numbers that are computed on first use, but not the problem."""
        if isinstance(self._answer, _Kept):
            return dict(vars(self._answer))
        state = {name: getattr(self._answer, name) for name, value in vars(_core.Answer).items() if isinstance(value, property)}
        try:
            state["error"] = self.estimated_error()
        except Error as reason:
            state["error"] = str(reason)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._answer = _Kept(**state)

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

    def _repr_html_(self) -> str:
        first, *further = (html.escape(line.strip()) for line in repr(self).split("\n"))
        table = ""
        if self.t is not None and self.q is not None:
            begin, end = self.at(self.t[0]), self.at(self.t[-1])
            units = self.coordinate_units or [""] * len(self.coordinates)
            lines = [*zip(self.coordinates, units, begin.q, end.q),
                     *zip(self.first_order_states, [""] * len(begin.y), begin.y, end.y)]
            rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(unit)}</td><td>{a:.6g}</td><td>{b:.6g}</td></tr>"
                           for name, unit, a, b in lines)
            table = f"<table><tr><th></th><th>unit</th><th>t = 0</th><th>t = {self.t[-1]:.6g}</th></tr>{rows}</table>"
        return f"<b>{first}</b><br>{'<br>'.join(further)}{table}"


_arrays = {"t", "q", "v", "p", "y", "psi_q", "psi_p", "psi_y", "integrals", "integral_prices"}


class _Kept(types.SimpleNamespace):
    """The contents of a pickled solution, in place of the C++ solution."""

    def estimated_error(self):
        if isinstance(self.error, str):
            raise Error(self.error)
        return self.error


# Advice after a failed or doubtful solve, by its remedy.
_remedies = {
    "none": "",
    "more_time": "more time (most_seconds=) or fewer intervals.",
    "finite_formula": "bounds that keep the coordinates away from that formula's singularity, and a guess within these bounds.",
    "radians": "radians: {coordinate} changes by {size:g}, which looks like an angle in degrees.",
    "other_units": "units of other sizes: {coordinate} is about {size:.1g}, {smallest} about {smallest_size:.1g}; solvers work "
                   "best with sizes near 1.",
    "longer_horizon": "a longer horizon than T = {size:g}, or wider bounds: the ends may be out of reach.",
    "longer_phases": "longer phases, or wider bounds: the ends may be out of reach.",
    "solver_auto": "solver=\"auto\".",
    "several_solvers": "solver=\"auto\": interior_point, then ipopt, then a solve from a feasible trajectory.",
    "common_start": "another start, such as start= with a solution by a different method.",
    "another_guess": "another guess, or start= with a solution near the one you want.",
    "finer_grid": "accuracy=1e-4, or more intervals: with these controls {coordinate} misses its final value by {size:.2g} of "
                  "its range.",
    "feedback": "feedback to follow this trajectory. The system is unstable: without feedback, {coordinate} misses its "
                "final value by {size:.2g} of its range.",
}


class Iteration(NamedTuple):
    """One iteration of a solver, as passed to the callback of `solve`."""

    solver: str
    """The running solver; "auto" tries several in turn."""
    number: int
    """The number of the iteration; counting restarts at 1 with every grid and solver."""
    cost: float
    """The cost at the iterate."""
    violation: float
    """The largest violation of a constraint of the discrete program."""
    stationarity: float
    """The largest entry of the gradient of the Lagrangian, as measured by the solver."""


Start = Union["Solution", motion, Sequence[Any]]
"""The start of a solve: a Solution, a `motion`, or the arrays (t, q), (t, q, v), (t, q, v, u) or (t, q, v, u, y)."""


def _arrays_of(start, handle):
    """The trajectory of a start, for C++."""
    if start is None:
        return None
    if isinstance(start, Solution):
        if start._answer.motion is None:
            raise Error(f"{start.status}: the solution to start from has no trajectory")
        return start._answer.motion
    if isinstance(start, (tuple, list)):
        if not 2 <= len(start) <= 5:
            raise Error(f"start= has {len(start)} arrays, expected (t, q), (t, q, v), (t, q, v, u) or (t, q, v, u, y)")
        start = motion(*start)
    if not isinstance(start, motion):
        raise Error(f"start= takes a Solution, a motion or arrays (t, q, v, u), not {type(start).__name__}")
    count = len(start.t)
    u = np.zeros((count, len(handle.controls))) if start.u is None else start.u
    y = np.zeros((count, 0)) if start.y is None else start.y
    return _core.Motion.of_nodes(start.t - start.t[0], start.q, start.v, u, y)


def solve(problem: AnyProblem, method: Method = "dmoc", *, intervals: int = 128, tableau: Tableau = "gauss", stages: int = 1,
          solver: Solver = "auto", start: Start | None = None, accuracy: float | None = None,
          refinement: Refinement = "h", nodes: Any = None, tolerance: float | None = None,
          most_iterations: int | None = None, most_seconds: float = 0.0, derivatives: Derivatives = "tape",
          form: CostForm = "bolza", verbose: bool = False, options: Mapping[str, Any] | None = None,
          callback: Callable[[Iteration], Any] | None = None) -> Solution:
    """Solves a problem and returns a `Solution`, whose status shows whether it converged. Raises Error on misuse.

    problem: an instance of a class derived from Problem, the class, a `problem(...)` or the name of a built-in problem.
    method: the transcription. "dmoc"; "hamiltonian" or "tangent" collocation; "multiple_shooting_rk4_1" and
        "single_shooting_rk4_1", where the last parts are the integrator (rk4 or midpoint) and its steps per interval;
        "galerkin_1_1", where the last parts are the degree of q and the control nodes per interval, and tableau= and stages=
        choose the quadrature. `methods()` lists them.
    intervals: N, the number of intervals of a uniform grid.
    tableau: the times of the stages in an interval: "gauss", "lobatto" or "lobatto_shared" (one control where two intervals
        meet). Shooting has its own integrator and uses the tableau only for the stages of the control.
    stages: the number s of stages per interval: 1 to 4 with "gauss" (order 2s), 2 to 4 with "lobatto" (order 2s - 2).
    solver: "auto" (interior_point, then ipopt, then another start), "interior_point" (ours, which uses the structure of the
        program), "ipopt", "sqp" (ours, an active-set method) or "nlopt" (SLSQP, for small programs).
    start: the start of the solve, by default the guess of the problem: a Solution (its grid, method or problem may be
        different, with the same coordinates and controls; its costates are used too); a `motion`; or arrays (t, q, v, u) with
        ascending t and a row per time, where v and u may be left out.
    accuracy: the estimated relative error of q, p and cost at which to stop, 1e-14 to 0.1. The grid is refined until this
        error is reached; iterations and seconds include all grids. None: solve on one grid.
    refinement: the quantities that accuracy= refines: "h" (the steps) or "hp" (the steps and up to three stages).
    nodes: relative times of the nodes, ascending from 0 to 1, instead of intervals=.
    tolerance: the limit for the residual of the optimality conditions of the scaled program, by default 1e-10.
    most_iterations: the limit for iterations of the solver, by default 500; a solve that reaches it has the status
        "iteration limit".
    most_seconds: the time limit for the call, including set-up and all grids; 0: no limit. A solve that reaches it has the
        status "time limit" and returns the last solution.
    derivatives: the source of derivatives: "tape" (exact, the fastest), "adolc" or "adolc_whole" (by ADOL-C, if built in),
        "finite_differences" (central), "forward_differences" or "dense_differences".
    form: the form of the cost: "bolza" (a sum), or "mayer" (one more unknown per node: the accumulated cost).
    verbose: print the solver's own output and, with accuracy=, a line per grid.
    options: options of the solver by name, such as {"mu_strategy": "adaptive"} for "ipopt".
    callback: a function that is called with an `Iteration` after each iteration; if it returns a true value, the solve ends
        with the status "interrupted", and the solution is the last iterate.
    """
    handle = handle_of(problem)
    given = {"method": method, "intervals": intervals, "tableau": tableau, "stages": stages, "solver": solver,
             "accuracy": accuracy, "refinement": refinement, "most_seconds": most_seconds, "derivatives": derivatives,
             "form": form, "verbose": verbose, "options": {key: str(value) for key, value in (options or {}).items()}}
    for name, value in (("nodes", nodes), ("tolerance", tolerance), ("most_iterations", most_iterations)):
        if value is not None:
            given[name] = value
    request = _fill(_core.Asked(), given)
    if callback is not None and not callable(callback):
        raise Error(f"callback= takes a function of an Iteration, not {callback!r}")
    watch = None if callback is None else lambda *entries: callback(Iteration(*entries))
    with in_words_of_python(arguments_of_solve):
        return Solution(_core.solve(handle, request, _arrays_of(start, handle), watch))


class Batch:
    """Solutions of many instances, with an entry per instance: cost, status, is_solved, iterations; with motions=True also q
    (instances x nodes x n) and u (instances x stages of all intervals x m), which are NaN for instances without a solution."""

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
                method: Method = "dmoc", intervals: int = 64, tableau: Tableau = "gauss", stages: int = 1,
                tolerance: float | None = None, most_iterations: int | None = None, most_seconds: float = 0.0,
                threads: int = 0, motions: bool = False) -> Batch:
    """Solves many instances of one problem, eight side by side in vector registers, on all processors.

    parameters: a dict from names to arrays with one number per instance; start, end: arrays of states (q, v) with a row of
    2n numbers per instance. Missing values are taken from the problem. Both ends and the horizon must be fixed. Each instance
    starts at its own guess; run("sweep") starts all instances from one trajectory and may find other minima. most_seconds:
    the time limit for the whole batch, 0 for no limit; unfinished instances have the status "time limit". Returns a `Batch`.
    Raises Error on misuse.
    """
    handle = handle_of(problem)
    n, m = len(handle.coordinates), len(handle.controls)
    columns = {name: np.asarray(values, dtype=float).ravel() for name, values in (parameters or {}).items()}
    tables = [np.zeros((0, 2 * n)) if table is None else np.asarray(table, dtype=float) for table in (start, end)]
    for name, table in zip(("start", "end"), tables):
        if table.ndim != 2:
            raise Error(f"solve_batch: {name} has {table.ndim} dimensions, expected 2: a row of {2 * n} numbers (q, v) "
                        "per instance")
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
    request = _fill(_core.BatchAsked(), given)
    with in_words_of_python(arguments_of_solve):
        return Batch(_core.solve_batch(handle, request, count, list(columns), values, *tables), n, m)
