"""What is wrong is refused by a sentence, and threads do not disturb each other."""
import ctypes
import os
import sys
import threading

sys.argv = sys.argv[:2]
import solve_from_python as tutorial  # noqa: E402


def refuses(word, result):
    assert not result or result == 1, result
    sentence = tutorial.last_error().decode()
    assert word in sentence, (word, sentence)


refuses("moon", tutorial.make_problem(b"moon"))
refuses("NULL", tutorial.make_problem(None))
problem = tutorial.make_problem(b"forced_oscillator")
for variable in ("DMOCBENCH_INSTRUCTION_SET", "DMOCBENCH_NATIVE_CODE"):  # that of the threads is read once
    os.environ[variable] = "sometimes"
    refuses(variable, tutorial.make_problem(b"forced_oscillator"))
    del os.environ[variable]
refuses("colour", tutorial.set_parameter(problem, b"colour", 1.0))
assert tutorial.control_name(problem, 99) is None


def options_with(**values):
    options = tutorial.Options()
    tutorial.default_options(ctypes.byref(options))
    options.intervals = 16
    for name, value in values.items():
        setattr(options, name, value)
    return ctypes.byref(options)


refuses("magic", tutorial.solve(problem, options_with(method=b"magic")))
refuses("NULL", tutorial.solve(problem, options_with(tableau=None)))
refuses("solver", tutorial.solve(problem, options_with(solver=b"magic")))
refuses("multiple_shooting", tutorial.solve(problem, options_with(method=b"single_shooting_rk4_1")))
for wrong in ({"stages": 0}, {"stages": 99}, {"intervals": 0}, {"intervals": 2**63}, {"tolerance": -1.0}):
    refuses("", tutorial.solve(problem, options_with(**wrong)))
refuses("options", tutorial.solve(problem, None))
assert not tutorial.is_solved(None)
refuses("start from", tutorial.solve_from(problem, options_with(), None))
refuses("magic", tutorial.solve_accurately(problem, options_with(), 1e-4, b"magic"))
refuses("1e-14", tutorial.solve_accurately(problem, options_with(), 0.0, b"h"))
other = tutorial.make_problem(b"two_link_manipulator")
of_other = tutorial.solve(other, options_with())
refuses("different numbers", tutorial.solve_from(problem, options_with(), of_other))
error = ctypes.c_double()
refuses("NULL", tutorial.estimate_error(of_other, None))

# The estimate is that of the difference from a far finer grid, and what is asked for is reached.
assert tutorial.estimate_error(of_other, ctypes.byref(error)) == 0, tutorial.last_error()
fine = tutorial.solve_from(other, options_with(intervals=512), of_other)
coarse_cost, fine_cost = (tutorial.number(solution, "cost") for solution in (of_other, fine))
assert abs(coarse_cost - fine_cost) <= 1.5 * error.value * abs(fine_cost), (coarse_cost, fine_cost, error.value)
accurate = tutorial.solve_accurately(other, options_with(), 1e-5, b"h")
assert tutorial.is_solved(accurate) and tutorial.number(accurate, "estimated_error") <= 1e-5
assert abs(tutorial.number(accurate, "cost") - fine_cost) < 1e-4 * abs(fine_cost)
late = tutorial.solve(tutorial.make_problem(b"acrobot"), options_with(most_seconds=1e-6, intervals=256))
assert late and not tutorial.is_solved(late), "a solve without time is no result"

costs = []


def work():
    own = tutorial.make_problem(b"forced_oscillator")
    solution = tutorial.solve(own, options_with(intervals=32))
    assert tutorial.make_problem(b"moon") is None  # leaves its sentence in this thread
    costs.append(tutorial.number(solution, "cost"))
    tutorial.free_solution(solution)
    tutorial.free_problem(own)


before = tutorial.last_error()
threads = [threading.Thread(target=work) for _ in range(4)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert len(costs) == 4 and len(set(costs)) == 1, costs
assert tutorial.last_error() == before
tutorial.free_problem(problem)
