"""dmocbench states optimal control problems of mechanical systems, solves them and compares transcriptions.

    import dmocbench as db

    class Pendulum(db.Problem):
        q = db.coordinates("theta", unit="rad")
        u = db.controls("tau", unit="N m")
        length = db.parameter(1.0, "m", "of the rod", lower=0.1, upper=10)
        horizon = 2.0
        start = db.at_rest(theta=0.0)
        end = db.at_rest(theta=3.141592653589793)

        def lagrangian(self, x):
            return 0.5 * self.length**2 * x.v.theta**2 + 9.81 * self.length * db.cos(x.q.theta)

        def force(self, x):
            return [x.u.tau]

        def running_cost(self, x):
            return 0.5 * x.u.tau**2

    print(db.solve(Pendulum(), method="dmoc", intervals=64))
"""

import hashlib as _hashlib
from pathlib import Path as _Path

from . import _core

# Python files and module of different builds would fail later, by an error far from its cause.
_folder = _Path(__file__).parent
_sums = "".join(_hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(_folder.glob("*.py")))
if _hashlib.sha256(_sums.encode()).hexdigest() != _core.tag_of_python_code:
    raise ImportError(f"the Python files in {_folder} and the module {_core.__file__} are from different builds; build "
                      "dmocbench again, or install both from the same build")

from ._core import (  # noqa: E402, F401
    Error,
    Expression,
    Spline,
    __version__,
    acos,
    asin,
    asinh,
    atan,
    atan2,
    cos,
    cosh,
    erf,
    exp,
    hypot,
    log,
    methods,
    problem_names,
    sin,
    sinh,
    smooth_abs,
    smooth_if_else,
    smooth_max,
    smooth_min,
    smooth_sign,
    solvers,
    sqrt,
    tan,
    tanh,
)
from .experiments import Results, Table, convergence, load_library, read_table, register, run  # noqa: E402, F401
from .phases import PhaseEnd, Phases, continuous, dropped, impact, momentum_kept, new_foothold  # noqa: E402, F401
from .problem import (  # noqa: E402, F401
    Problem,
    at_rest,
    between,
    controls,
    coordinates,
    first_order_states,
    free,
    motion,
    parameter,
    state,
    unknown,
)
from .solving import Batch, Iteration, Solution, problem, solve, solve_batch  # noqa: E402, F401
