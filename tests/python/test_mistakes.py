"""Mistakes get a sentence that names the Python function, or the user's own exception with its traceback; none a crash."""

import _thread
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import unittest

import numpy as np

import dmocbench as db
import restated
from pendulum import PendulumSwingUp


def variant(**members):
    return type("PendulumSwingUp", (PendulumSwingUp,), members)


class Builds(unittest.TestCase):
    def test_python_files_of_another_build(self):
        package = pathlib.Path(db.__file__).parent
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(package, f"{folder}/dmocbench")
            run = [sys.executable, "-c", "import dmocbench"]
            environment = {**os.environ, "PYTHONPATH": folder}
            self.assertEqual(subprocess.run(run, env=environment, check=False).returncode, 0)
            with open(f"{folder}/dmocbench/points.py", "a", encoding="utf-8") as file:
                file.write("# changed\n")
            answer = subprocess.run(run, env=environment, check=False, capture_output=True, text=True)
            self.assertEqual(answer.returncode, 1)
            self.assertIn("are from different builds", answer.stderr)


class Mistakes(unittest.TestCase):
    def refused(self, sentence, problem=None, kind=db.Error, **options):
        with self.assertRaisesRegex(kind, sentence) as caught:
            db.solve(problem if problem is not None else PendulumSwingUp(), **options)
        return caught.exception

    def test_wrong_sizes(self):
        self.refused("pendulum_swing_up: force has 2 entries, expected 1", variant(force=lambda self, x: [x.u[0], 0.0]))
        self.refused("lagrangian returns 2 entries", variant(lagrangian=lambda self, x: [x.v[0] ** 2, 1.0]))
        self.refused("start: q lacks theta|start: q has an unknown entry phi", variant(start=db.at_rest(phi=0.0)))
        self.refused("start: q has 2 entries, expected 1", variant(start=db.at_rest([0.0, 1.0])))
        self.refused("guess.*q has 3 entries, expected 1", variant(guess=lambda self, t: ([0, 1, 2], [0.0], [0.0])))
        self.refused("symmetry has 2 entries", variant(symmetry=lambda self, q: [1.0, 2.0]))

    def test_missing_members(self):
        for member, sentence in (("q", "lacks q"), ("lagrangian", "lacks lagrangian"), ("start", "lacks start"),
                                 ("end", "lacks end"), ("horizon", "lacks horizon"), ("force", "has controls but lacks force"),
                                 ("running_cost", "lacks running_cost")):
            self.refused(f"pendulum_swing_up {sentence}", variant(**{member: None}))

    def test_misspelt_members(self):
        self.refused("did you mean path_constraints", variant(path_constraint=lambda self, x: [1.0]))
        with self.assertRaisesRegex(db.Error, "has no parameter lenght; it has length"):
            PendulumSwingUp(lenght=1.0)

    def test_no_return(self):
        self.refused("lagrangian: returns None; add the missing \"return\"", variant(lagrangian=lambda self, x: None))
        self.refused("force: entry 0 of the returned value is None", variant(force=lambda self, x: [None]))

    def test_wrong_types(self):
        self.refused("running_cost: returns str", variant(running_cost=lambda self, x: "u"))
        self.refused("start is 0.0, expected state", variant(start=0.0))
        self.refused("horizon: expected a number, got 'two'", variant(horizon="two"))
        self.refused("q is 'theta', expected coordinates", variant(q="theta"))
        self.refused("force is 3, expected a method", variant(force=3))
        self.refused("expected a problem or the name of a problem", 7)
        self.refused("intervals='many' is of the wrong type", intervals="many")
        self.refused("start= takes a Solution, a motion or arrays", start="guess")
        self.refused("intervals=16.5 is of the wrong type", intervals=16.5)
        self.assertTrue(db.solve(PendulumSwingUp(), intervals=16.0, stages=np.float64(1.0)).is_solved)

    def test_numbers_that_are_none(self):
        self.refused("start: q is nan, not a finite number", variant(start=db.at_rest(theta=math.nan)))
        self.refused("the horizon must be positive", variant(horizon=-1.0))
        self.refused("write between\\(lower, upper, guess\\)", variant(horizon=db.free(2.0)))
        self.refused("at its guess in interval 1 .* running_cost is not a number",
                     variant(running_cost=lambda self, x: x.u[0] ** 2 + db.log(x.q.theta - 10.0)))

    def test_bounds_that_do_not_fit(self):
        self.refused("lower bound 1 above the upper bound -1",
                     variant(u=db.controls("tau", lower=1.0, upper=-1.0)))
        self.refused("bounds has an entry 'w'", variant(bounds=lambda self: {"w": (0.0, 1.0)}))
        self.refused("end and bounds of q leave no value for q\\[0\\]",
                     variant(q=db.coordinates("theta", upper=1.0)))

    def test_first_order_states_that_do_not_fit(self):
        y = db.first_order_states("current")
        rates = {"y": y, "first_order_rates": lambda self, x: [x.u.tau - x.y.current]}
        start, end = db.state([0.0], y=[0.0]), db.state([math.pi], y=db.free())
        self.assertTrue(db.solve(variant(**rates, start=start, end=end), intervals=16).is_solved)
        self.refused("start: y is missing; its entries are current", variant(**rates, end=end))
        self.refused("end: y has 2 entries, expected 1", variant(**rates, start=start, end=db.state([math.pi], y=[0.0, 1.0])))
        self.refused("lacks first_order_rates", variant(y=y, start=start, end=end))
        self.refused("first_order_rates has 2 entries, expected 1",
                     variant(y=y, start=start, end=end, first_order_rates=lambda self, x: [x.u.tau, 1.0]))
        self.refused("start: y has 1 entry, expected 0", variant(start=start))
        self.refused("y has no entry voltage; it has current", variant(**{**rates, "force": lambda self, x: [x.y.voltage]},
                                                                       start=start, end=end), AttributeError)

    def test_waypoints(self):
        class Through(restated.PointsAtGivenTimes):
            waypoints = {0.5: [1.0, 2.0]}
        self.refused("waypoints\\[0.5\\] is \\[1.0, 2.0\\], expected state", Through())

        class Late(restated.PointsAtGivenTimes):
            waypoints = {1.5: db.state([1.0, 2.0])}
        self.refused("1.5", Late())

        class Wrong(restated.PointsAtGivenTimes):
            waypoints = {0.5: db.state({"z": 1.0})}
        self.refused("waypoints\\[0.5\\]: q has an unknown entry z", Wrong())

    def test_what_methods_do_not_know(self):
        self.refused("does not support first-order states \\(y\\)", restated.TwoLinkWithMotors(), method="multiple_shooting_rk4_1")
        solution = db.solve(restated.TwoLinkWithMotors(), intervals=64, stages=2)
        with self.assertRaisesRegex(db.Error, "first-order states"):
            solution.estimated_error()
        with self.assertRaisesRegex(db.Error, "cannot be solved in a batch"):
            db.solve_batch(restated.TwoLinkWithMotors(), start=np.zeros((3, 4)))
        self.refused("start= has 2 coordinates, .* but the problem has 1, 1 and 0", PendulumSwingUp(), start=solution)
        self.refused("tableau=\"gauss\", stages=1", "cart_pole_cartesian", method="dmoc", stages=2)

    def test_unknowns_that_nothing_reads(self):
        self.refused("is not read|no formula depends on", variant(stiffness=db.unknown(1.0, lower=0.0, upper=2.0)))
        with self.assertRaisesRegex(db.Error, "stiffness must be a number in \\[0, 2\\]"):
            db.solve(variant(stiffness=db.unknown(3.0, lower=0.0, upper=2.0)))

    def test_bounds_of_formulas_that_do_not_fit(self):
        def integrands(self, x):
            return [x.u.tau**2]

        self.refused("bounds\\['integrals'\\] has nothing to bound", variant(bounds={"integrals": (0.0, 1.0)}))
        self.refused("bounds of integrals has 2 entries, but integrands has 1",
                     variant(integrands=integrands, bounds={"integrals": ([0.0, 1.0], [2.0, 2.0])}))
        self.refused("integrals", variant(integrands=integrands))
        self.refused("2 lower but 3 upper bounds",
                     variant(integrands=integrands, bounds={"integrals": ([0.0, 1.0], [2.0, 2.0, 2.0])}))
        self.refused("lower bound 2 above the upper bound 1", variant(integrands=integrands, bounds={"integrals": (2.0, 1.0)}))

    def test_parameters_out_of_range(self):
        with self.assertRaisesRegex(db.Error, "parameter length must be a number in \\[0.1, 10\\] *.*got 20"):
            PendulumSwingUp(length=20.0)

    def test_names_that_do_not_exist(self):
        self.refused("there is no problem \"pendolo\"", "pendolo")
        self.refused("there is no method \"dmok\"|dmok", method="dmok")
        self.refused("there is no solver|snopt", solver="snopt")
        self.refused("radau", tableau="radau")
        with self.assertRaisesRegex(db.Error, "there is no experiment convergenze"):
            db.run("convergenze", PendulumSwingUp())

    def test_grids_that_are_none(self):
        self.refused("0", intervals=0)
        self.refused("ascend", nodes=[0.0, 0.5, 0.4, 1.0])

    def test_functions_of_math_on_formulas(self):
        self.refused("dmocbench.cos or numpy.cos", variant(lagrangian=lambda self, x: math.cos(x.q.theta)), TypeError)
        self.refused("smooth_if_else", variant(lagrangian=lambda self, x: 1.0 if x.q.theta > 0 else 2.0), TypeError)
        for function in (lambda a: np.where(a > 0.0, a, 0.0), lambda a: np.maximum(a, 0.0), np.sign, lambda a: np.clip(a, 0.0, 1.0)):
            self.refused("smooth_if_else", variant(running_cost=lambda self, x: function(x.u.tau)), TypeError)
        self.refused("smooth_abs", variant(running_cost=lambda self, x: np.abs(x.u.tau)), TypeError)
        self.refused("inv", variant(running_cost=lambda self, x: np.linalg.inv(np.array([[x.u.tau]]))[0]), TypeError)
        self.refused("log10", variant(running_cost=lambda self, x: np.log10(x.u.tau)), TypeError)

    def test_what_solutions_do_not_have(self):
        solution = db.solve(PendulumSwingUp(), intervals=8)
        for ask, sentence in ((lambda: solution.u, "solution.stages.u"), (lambda: solution.tau, "column\\(\"tau\"\\)"),
                              (lambda: solution.success, "has no success; it has .*is_solved"),
                              (lambda: solution.stages.w, "stages have no w; they have t, q, v, u")):
            with self.assertRaisesRegex(AttributeError, sentence):
                ask()
        with self.assertRaisesRegex(db.Error, "there is no phi; choose one of theta, tau"):
            solution.column("phi")

    def test_controls_that_nothing_reads(self):
        self.refused("no formula depends on the control tau",
                     variant(force=lambda self, x: [0.0], running_cost=lambda self, x: x.q[0] ** 2))

    def test_exceptions_of_the_user_keep_their_traceback(self):
        def force(self, x):
            return [x.u.tau / my_constant]  # noqa: F821

        frames = []
        try:
            db.solve(variant(force=force))
        except NameError as error:
            frames = traceback.extract_tb(error.__traceback__)
        self.assertTrue(any(frame.name == "force" and frame.filename == __file__ for frame in frames))

    def test_exceptions_of_the_user_in_experiments_keep_their_traceback(self):
        class Late(PendulumSwingUp):
            asked = 0

            def guess(self, t):
                Late.asked += 1
                if Late.asked > 200:
                    raise ZeroDivisionError("late")
                return [1.5 * t], [1.5], [0.0]

        import tempfile

        with tempfile.TemporaryDirectory() as out, self.assertRaisesRegex(ZeroDivisionError, "late"):
            db.run("solve", Late(), out=out, method="dmoc", intervals=300)

    def test_recursion(self):
        self.refused("recursion", variant(lagrangian=lambda self, x: self.lagrangian(x)), RecursionError)

    def test_a_solve_within_a_formula(self):
        inner = []

        def lagrangian(self, x):
            inner.append(db.solve(PendulumSwingUp(), intervals=8).cost)
            return PendulumSwingUp.lagrangian(self, x)

        solution = db.solve(variant(lagrangian=lagrangian), intervals=8)
        self.assertEqual(solution.cost, db.solve(PendulumSwingUp(), intervals=8).cost)
        self.assertEqual(set(inner), {solution.cost})

    def test_changing_and_deleting_the_problem_during_a_solve(self):
        problems = [PendulumSwingUp()]

        def guess(self, t):
            if problems:
                problems.pop().length = 5.0
            return [1.5 * t], [1.5], [0.0]

        problems[0] = variant(guess=guess)()
        cost = db.solve(problems[0], intervals=16).cost
        self.assertFalse(problems)
        self.assertAlmostEqual(cost, db.solve(PendulumSwingUp(), intervals=16).cost, places=9)

    def test_a_copy_that_is_kept_beyond_its_solve(self):
        kept = []

        def lagrangian(self, x):
            kept.append(self)
            return PendulumSwingUp.lagrangian(self, x)

        problem = variant(lagrangian=lagrangian)()
        db.solve(problem, intervals=8)
        del problem
        with self.assertRaisesRegex(db.Error, "has ended"):
            kept[0].length

    def test_formulas_of_another_thread(self):
        formulas = []
        thread = threading.Thread(
            target=lambda: db.solve(variant(lagrangian=lambda self, x: formulas.append(x.q[0]) or x.v[0] ** 2), intervals=8))
        thread.start()
        thread.join()
        self.assertTrue(formulas)
        self.refused("thread", variant(lagrangian=lambda self, x: x.v[0] ** 2 + formulas[0]))

    def test_keyboard_interrupt_in_a_solve(self):
        timer = threading.Timer(0.3, _thread.interrupt_main)
        begin = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            while True:
                db.solve(PendulumSwingUp(), intervals=20000, solver="ipopt")
        self.assertLess(time.monotonic() - begin, 60.0)

    def test_keyboard_interrupt_in_a_formula(self):
        def lagrangian(self, x):
            raise KeyboardInterrupt

        self.refused("", variant(lagrangian=lagrangian), KeyboardInterrupt)

    def test_arrays_of_batches_that_do_not_fit(self):
        problem = PendulumSwingUp()
        with self.assertRaisesRegex(db.Error, "start has shape \\(3, 3\\), expected \\(3, 2\\)"):
            db.solve_batch(problem, start=np.zeros((3, 3)))
        with self.assertRaisesRegex(db.Error, "same number of instances, got 3, 4"):
            db.solve_batch(problem, start=np.zeros((3, 2)), parameters={"length": np.ones(4)})
        with self.assertRaisesRegex(db.Error, "not a finite number"):
            db.solve_batch(problem, start=np.full((3, 2), np.nan))
        with self.assertRaisesRegex(db.Error, "has no parameter"):
            db.solve_batch(problem, parameters={"mass": np.ones(3)})


if __name__ == "__main__":
    unittest.main()
