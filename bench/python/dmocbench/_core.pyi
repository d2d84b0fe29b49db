"""The C++ part of the package dmocbench."""

from typing import Any, Callable, Sequence, SupportsFloat, Union

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

no_configuration: str
tag_of_python_code: str

class Error(Exception): ...

class Expression:
    def __init__(self, value: float) -> None: ...
    def __add__(self, other: Number) -> Expression: ...
    def __radd__(self, other: Number) -> Expression: ...
    def __sub__(self, other: Number) -> Expression: ...
    def __rsub__(self, other: Number) -> Expression: ...
    def __mul__(self, other: Number) -> Expression: ...
    def __rmul__(self, other: Number) -> Expression: ...
    def __truediv__(self, other: Number) -> Expression: ...
    def __rtruediv__(self, other: Number) -> Expression: ...
    def __pow__(self, exponent: SupportsFloat) -> Expression: ...
    def __neg__(self) -> Expression: ...
    def __pos__(self) -> Expression: ...
    def sqrt(self) -> Expression: ...
    def exp(self) -> Expression: ...
    def log(self) -> Expression: ...
    def sin(self) -> Expression: ...
    def cos(self) -> Expression: ...
    def tan(self) -> Expression: ...
    def arcsin(self) -> Expression: ...
    def arccos(self) -> Expression: ...
    def arctan(self) -> Expression: ...
    def arctan2(self, x: Number) -> Expression: ...
    def hypot(self, y: Number) -> Expression: ...
    def sinh(self) -> Expression: ...
    def cosh(self) -> Expression: ...
    def tanh(self) -> Expression: ...
    def arcsinh(self) -> Expression: ...
    def erf(self) -> Expression: ...
    def conjugate(self) -> Expression: ...

Number = Union[Expression, SupportsFloat]
Function = Callable[[Any], Any]

sqrt: Function
exp: Function
log: Function
sin: Function
cos: Function
tan: Function
asin: Function
acos: Function
atan: Function
sinh: Function
cosh: Function
tanh: Function
asinh: Function
erf: Function

def atan2(y: Number, x: Number) -> Any: ...
def hypot(x: Number, y: Number) -> Any: ...
def smooth_abs(x: Number, eps: float) -> Expression: ...
def smooth_sign(x: Number, eps: float) -> Expression: ...
def smooth_max(x: Number, y: Number, eps: float) -> Expression: ...
def smooth_min(x: Number, y: Number, eps: float) -> Expression: ...
def smooth_if_else(x: Number, a: Number, b: Number, eps: float) -> Expression: ...

class Spline:
    def __init__(self, x: Sequence[float], y: Sequence[float]) -> None: ...
    def __call__(self, x: Number) -> Any: ...

class ProblemReader:
    def read(self, name: str) -> Any: ...
    def constraint_multipliers(self, q: Any, v: Any, u: Any, y: Any, t: Any) -> list[Any]: ...

class ProblemHandle:
    def __init__(self, problem: Any) -> None: ...
    @staticmethod
    def named(name: str, values: dict[str, float] = ...) -> ProblemHandle: ...
    original: Any
    name: str
    settings: str
    description: str
    coordinates: list[str]
    controls: list[str]
    parameters: dict[str, float]
    def operation_count(self) -> int: ...

class Asked:
    method: str
    tableau: str
    stages: int
    intervals: int
    nodes: Array
    solver: str
    derivatives: str
    form: str
    tolerance: float
    most_iterations: int
    most_seconds: float
    verbose: bool
    options: dict[str, str]
    accuracy: float | None
    refinement: str

class BatchAsked:
    method: str
    tableau: str
    stages: int
    intervals: int
    tolerance: float
    most_iterations: int
    most_seconds: float
    threads: int
    motions: bool

class Answer:
    problem: str
    method: str
    tableau: str
    stage_count: int
    intervals: int
    solver: str
    status: str
    message: str
    is_solved: bool
    cost: float | None
    iterations: int | None
    kkt_residual: float | None
    constraint_violation: float | None
    seconds: float
    setup_seconds: float | None
    relative_jump: float | None
    replay_error: float | None
    replay_in_words: str
    advice: dict[str, Any]
    largest_violation: float | None
    coordinates: list[str]
    coordinate_units: list[str]
    controls: list[str]
    control_units: list[str]
    time_unit: str
    first_order_states: list[str]
    unknowns: dict[str, float]
    picture: tuple[list[str], Array]
    price_unknowns: dict[str, float]
    price_horizon: float | None
    motion: Motion | None
    phases: dict[str, dict[str, Any]]
    def estimated_error(self) -> float: ...

class Motion:
    @staticmethod
    def of_nodes(t: Array, q: Array, v: Array, u: Array, y: Array) -> Motion: ...
    def at(self, times: Array) -> tuple[Array, Array, Array, Array]: ...
    integrals: Array | None
    integral_prices: Array | None
    values_of_unknowns: Array | None
    prices_of_unknowns: Array | None
    t: Array | None
    q: Array | None
    v: Array | None
    p: Array | None
    y: Array | None
    psi_q: Array | None
    psi_p: Array | None
    psi_y: Array | None
    left_impulses: Array | None
    right_impulses: Array | None
    stage_t: Array | None
    stage_q: Array | None
    stage_v: Array | None
    stage_u: Array | None
    stage_p: Array | None
    stage_y: Array | None
    stage_y_rates: Array | None
    stage_psi_q: Array | None
    stage_psi_p: Array | None
    stage_psi_y: Array | None
    stage_constraint_forces: Array | None
    price_q: Array | None
    price_v: Array | None
    price_y: Array | None
    price_stage_v: Array | None
    price_stage_u: Array | None
    price_path: Array | None

__version__: str

def continuous(before: Any, after: Any) -> list[Expression]: ...
def momentum_kept(before: Any, after: Any) -> list[Expression]: ...
def dropped(before: Any, after: Any, amount: Any) -> list[Expression]: ...
def impact(before: Any, after: Any, guard: Function, restitution: Number, impulse: Any) -> list[Expression]: ...
def new_foothold(before: Any, after: Any, lagrangian: Callable[..., Any], on_old_foot: Function,
                 on_new_foot: Function) -> list[Expression]: ...
def methods() -> list[str]: ...
def solvers() -> list[str]: ...
def problem_names() -> list[str]: ...
def load_problem_libraries(files: list[str]) -> list[str]: ...
def check_parameter(name: str, value: float, lower: float, upper: float, whole: bool) -> None: ...
def solve(problem: ProblemHandle, asked: Asked, start: Motion | None, callback: Callable[..., Any] | None) -> Answer: ...
def solve_batch(problem: ProblemHandle, asked: BatchAsked, count: int, parameters: list[str], values: Array,
                first: Array, last: Array) -> dict[str, Any]: ...
def run(name: str, arguments: list[str], raises: bool) -> int: ...
def register_problem(problem: ProblemHandle, file: str, source: str) -> None: ...
def spell_members(names: list[tuple[str, str]]) -> None: ...
def programs() -> list[tuple[str, str]]: ...
