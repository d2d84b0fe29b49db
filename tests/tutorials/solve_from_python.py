#!/usr/bin/env python3
"""The energy-optimal transfer of the two-link manipulator from Python: no compiler, nothing but the standard library.

    python3 solve_from_python.py [libdmocbench.so]

The functions are those of dmocbench.h, which says what each of them does.
"""
import ctypes
import sys

dmocbench = ctypes.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libdmocbench.so")


class Options(ctypes.Structure):
    """dmocbench_options."""

    _fields_ = [
        ("method", ctypes.c_char_p),
        ("tableau", ctypes.c_char_p),
        ("stages", ctypes.c_int),
        ("intervals", ctypes.c_size_t),
        ("solver", ctypes.c_char_p),
        ("tolerance", ctypes.c_double),
        ("most_seconds", ctypes.c_double),
    ]


def declare(name, result, *arguments):
    """Tells ctypes what a function takes and returns."""
    function = getattr(dmocbench, "dmocbench_" + name)
    function.restype = result
    function.argtypes = arguments
    return function


Handle = ctypes.c_void_p
text = ctypes.c_char_p
last_error = declare("last_error", text)
problem_count = declare("problem_count", ctypes.c_size_t)
problem_name = declare("problem_name", text, ctypes.c_size_t)
make_problem = declare("make_problem", Handle, text)
free_problem = declare("free_problem", None, Handle)
set_parameter = declare("set_parameter", ctypes.c_int, Handle, text, ctypes.c_double)
control_name = declare("control_name", text, Handle, ctypes.c_size_t)
default_options = declare("default_options", None, ctypes.POINTER(Options))
solve = declare("solve", Handle, Handle, ctypes.POINTER(Options))
solve_from = declare("solve_from", Handle, Handle, ctypes.POINTER(Options), Handle)
solve_accurately = declare("solve_accurately", Handle, Handle, ctypes.POINTER(Options), ctypes.c_double, text)
estimate_error = declare("estimate_error", ctypes.c_int, Handle, ctypes.POINTER(ctypes.c_double))
free_solution = declare("free_solution", None, Handle)
is_solved = declare("is_solved", ctypes.c_int, Handle)
message = declare("message", text, Handle)
number_of = declare("number", ctypes.c_int, Handle, text, ctypes.POINTER(ctypes.c_double))
size_pointer = ctypes.POINTER(ctypes.c_size_t)
array_of = declare("array", ctypes.POINTER(ctypes.c_double), Handle, text, size_pointer, size_pointer)


def number(solution, name):
    """A number of a solution."""
    value = ctypes.c_double()
    if number_of(solution, name.encode(), ctypes.byref(value)) != 0:
        raise ValueError(last_error().decode())
    return value.value


def array(solution, name):
    """An array of a solution as a list of rows; numpy.ctypeslib.as_array would copy nothing."""
    rows, columns = ctypes.c_size_t(), ctypes.c_size_t()
    values = array_of(solution, name.encode(), ctypes.byref(rows), ctypes.byref(columns))
    if not values:
        raise ValueError(last_error().decode())
    width = columns.value
    return [values[k * width : (k + 1) * width] for k in range(rows.value)]


def main():
    print("problems:", ", ".join(problem_name(i).decode() for i in range(problem_count())))
    problem = make_problem(b"two_link_manipulator")
    if not problem:
        raise SystemExit(last_error().decode())
    if set_parameter(problem, b"mass_1", 1.5) != 0:
        raise SystemExit(last_error().decode())
    if set_parameter(problem, b"mass_1", -1.0) != 0:  # a sentence, no crash
        print("refused:", last_error().decode())

    options = Options()
    default_options(ctypes.byref(options))
    options.intervals = 32
    solution = solve(problem, ctypes.byref(options))
    if not solution:
        raise SystemExit(last_error().decode())
    if not is_solved(solution):
        raise SystemExit(message(solution).decode())
    print(f"cost: {number(solution, 'cost'):.15g}")
    last = array(solution, "q")[-1]
    print(f"ends at t = {array(solution, 't')[-1][0]:g} in q = ({last[0]:g}, {last[1]:g})")
    first = array(solution, "stage_u")[0]
    print("first controls:", ", ".join(f"{control_name(problem, i).decode()} = {u:.6g}" for i, u in enumerate(first)))
    error = ctypes.c_double()
    if estimate_error(solution, ctypes.byref(error)) != 0:
        raise SystemExit(last_error().decode())
    print(f"estimated relative error: {error.value:.1e}")

    set_parameter(problem, b"mass_1", 1.6)  # a heavier arm, from the motion of the lighter one
    heavier = solve_from(problem, ctypes.byref(options), solution)
    if not heavier or not is_solved(heavier):
        raise SystemExit(last_error().decode())
    print(f"with mass_1 = 1.6: {number(heavier, 'cost'):.15g} after {number(heavier, 'iterations'):.0f} iterations")
    accurate = solve_accurately(problem, ctypes.byref(options), 1e-6, b"hp")
    if not accurate or not is_solved(accurate):
        raise SystemExit(last_error().decode())
    print(f"to {number(accurate, 'estimated_error'):.0e}: {number(accurate, 'cost'):.9g} on "
          f"{number(accurate, 'intervals'):.0f} intervals with {number(accurate, 'stages'):.0f} stages")
    for handle in (solution, heavier, accurate):
        free_solution(handle)
    free_problem(problem)


if __name__ == "__main__":
    main()
