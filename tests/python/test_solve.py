"""Solves of problems stated in Python: the same as those of C++, for every method, tableau and solver."""

import math
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import dmocbench as db
import restated
from pendulum import PendulumSwingUp

library = os.environ.get("DMOCBENCH_TEST_LIBRARY")


class Decay(db.Problem):
    """first-order states alone"""

    u, y = db.controls("u"), db.first_order_states("x")
    horizon, start, end = 1.0, db.state(y=[1.0]), db.state(y=[0.75])
    waypoints = {0.75: db.state(y=[0.9])}

    def first_order_rates(self, x):
        return [x.u.u]

    def running_cost(self, x):
        return x.y.x**2 + x.u.u**2


class FirstOrderStatesAlone(unittest.TestCase):
    def test_have_their_closed_form_by_every_method(self):
        part = lambda t, a, b: (a * a + b * b) / math.tanh(t) - 2 * a * b / math.sinh(t)
        for method in ("dmoc", "hamiltonian", "tangent"):
            solution = db.solve(Decay(), method, intervals=32, stages=2)
            self.assertAlmostEqual(solution.cost, part(0.75, 1.0, 0.9) + part(0.25, 0.9, 0.75), delta=1e-7)
            self.assertEqual(solution.picture[0], ["t_in_s", "x", "u"])

    def test_have_nothing_to_compare(self):
        for methods, says in (("dmoc,tangent", True), ("dmoc", False)):
            with tempfile.TemporaryDirectory() as folder:
                run = f"import dmocbench, test_solve; dmocbench.run('objective', test_solve.Decay, out={folder!r}, method={methods!r}, intervals=8)"
                done = subprocess.run([sys.executable, "-c", run], cwd=os.path.dirname(__file__), capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            sentence = "decay has only first-order states: all methods coincide, so there is nothing to compare"
            self.assertEqual(sentence in done.stdout, says, done.stdout)

    def test_get_a_sentence_for_what_needs_coordinates(self):
        for member in ("lagrangian", "force"):
            wrong = type("Decay", (Decay,), {member: lambda self, x: [0.0]})
            with self.assertRaisesRegex(db.Error, f"decay has {member}.self, ...., but no coordinates"):
                db.solve(wrong())
        with self.assertRaisesRegex(db.Error, "start has q or v, but there are no coordinates"):
            db.solve(type("Decay", (Decay,), {"start": db.state([0.0], y=[1.0])})())


class Bob(db.Problem):
    """a pendulum in Cartesian coordinates whose rod bears a limited tension"""

    q, u = db.coordinates("x", "y"), db.controls("f")
    horizon, start, end = 1.5, db.at_rest([0.0, -1.0]), db.at_rest([1.0, 0.0])
    bounds = {"path": (None, 14.0)}

    def lagrangian(self, x):
        return 0.5 * (x.v @ x.v) - 9.81 * x.q.y

    def constraints(self, q):
        return [0.5 * (q @ q - 1.0)]

    def force(self, x):
        return [-x.u.f * x.q.y, x.u.f * x.q.x]

    def running_cost(self, x):
        return x.u.f**2

    def path_constraints(self, x):
        return self.constraint_multipliers(x)


class BobByItsTension(Bob):
    def path_constraints(self, x):
        return [(x.v @ x.v - 9.81 * x.q.y) / (x.q @ x.q)]


class ForcesOfConstraint(unittest.TestCase):
    def test_are_bounded_as_the_tension_that_the_multiplier_is(self):
        for method in ("dmoc", "hamiltonian", "tangent"):
            bounded, stated = (db.solve(cls(), method, intervals=64) for cls in (Bob, BobByItsTension))
            self.assertTrue(bounded and stated, bounded.message)
            self.assertAlmostEqual(bounded.cost / stated.cost, 1.0, delta=1e-9)
            self.assertGreater(bounded.cost, 1.001 * db.solve(type("Free", (Bob,), {"bounds": {}, "path_constraints": None})(),
                                                              method, intervals=64).cost)

    def test_are_read_in_formulas_only(self):
        with self.assertRaisesRegex(db.Error, "only in path_constraints"):
            Bob().constraint_multipliers(None)


class Pendulum(unittest.TestCase):
    @unittest.skipIf(library is None, "no library of problems is given")
    def test_has_the_formulas_and_the_bits_of_the_one_in_cpp(self):
        db.load_library(library)
        in_cpp = db.problem("pendulum_swing_up")
        self.assertEqual(PendulumSwingUp().handle().operation_count(), in_cpp.handle().operation_count())
        for method in ("dmoc", "hamiltonian", "tangent", "multiple_shooting_rk4_1"):
            for solver in ("interior_point", "ipopt"):
                a = db.solve(PendulumSwingUp(), method, intervals=48, solver=solver)
                b = db.solve(in_cpp, method, intervals=48, solver=solver)
                self.assertTrue(a.is_solved, a)
                self.assertEqual(a.cost, b.cost)
                for one, other in ((a.q, b.q), (a.p, b.p), (a.stages.u, b.stages.u)):
                    self.assertTrue(np.array_equal(one, other))

    @unittest.skipIf(library is None, "no library of problems is given")
    def test_has_the_parameters_of_the_one_in_cpp(self):
        db.load_library(library)
        a = db.solve(PendulumSwingUp(length=1.3), intervals=32)
        b = db.solve(db.problem("pendulum_swing_up", length=1.3), intervals=32)
        self.assertEqual(a.cost, b.cost)
        self.assertNotEqual(a.cost, db.solve(PendulumSwingUp(), intervals=32).cost)

    def test_is_solved_by_every_method_tableau_and_solver(self):
        near = db.solve(PendulumSwingUp(), intervals=64, stages=2)  # one of several minima
        costs = [db.solve(PendulumSwingUp(), method, intervals=64, tableau=tableau, stages=stages, solver=solver, start=near)
                 for method in db.methods() if not ("midpoint" in method or method.startswith("galerkin"))  # of order 2
                 for tableau, stages in (("gauss", 2), ("lobatto", 3))
                 for solver in ("interior_point", "ipopt", "auto", "sqp")
                 if not (method.startswith(("single", "multiple")) and tableau == "lobatto")]
        self.assertGreater(len(costs), 20)
        solved = [solution.cost for solution in costs if solution.is_solved]
        self.assertGreater(len(solved), 0.8 * len(costs))
        self.assertLess(np.ptp(solved), 1e-3 * min(solved))

    def test_has_arrays_of_the_motion(self):
        solution = db.solve(PendulumSwingUp(), intervals=10, stages=2)
        self.assertEqual([part.shape for part in (solution.t, solution.q, solution.v, solution.p, solution.psi)],
                         [(11,), (11, 1), (11, 1), (11, 1), (11, 2)])
        self.assertEqual([part.shape for part in (solution.stages.t, solution.stages.u, solution.stages.q)],
                         [(20,), (20, 1), (20, 1)])
        self.assertAlmostEqual(solution.q[-1, 0], np.pi, places=12)
        self.assertTrue(np.array_equal(solution.column("theta"), solution.q[:, 0]))
        self.assertRegex(repr(solution), "(?s)solved.*cost.*iterations.*replay error.*largest violation")

    def test_prints_the_replay_error_by_unit_and_counts_in_the_singular(self):
        printed = repr(db.solve(PendulumSwingUp(), intervals=32))
        self.assertRegex(printed, r"\(gauss, 1 stage, 32 intervals\): solved")
        self.assertRegex(printed, r"replay error [0-9.e-]+ rad, [0-9.e-]+ rad/s; largest violation")
        self.assertIn(", 2 stages, ", repr(db.solve(PendulumSwingUp(), intervals=32, stages=2)))

    def test_doubts_angles_that_look_like_degrees(self):
        class InDegrees(PendulumSwingUp):
            horizon = 20.0
            end = db.at_rest(theta=180.0)

        self.assertIn("Try radians: theta changes by 180", repr(db.solve(InDegrees(), intervals=64)))
        self.assertNotIn("Try", repr(db.solve(PendulumSwingUp(), intervals=32)))

    def test_advises_after_a_failure_in_words_of_python(self):
        self.assertIn("Try solver=\"auto\"", repr(db.solve(PendulumSwingUp(), solver="ipopt", most_iterations=2)))

    def test_ends_with_the_time_of_the_call(self):
        # Each takes more than ten seconds without a limit, and about one with it; machines may be busy.
        for given in ({"accuracy": 1e-10}, {"accuracy": 1e-10, "solver": "sqp"}, {"solver": "sqp"}):
            began = time.monotonic()
            solution = db.solve("robot_arm", "tangent", intervals=256, most_seconds=1, **given)
            self.assertLess(time.monotonic() - began, 5, given)
            self.assertEqual(solution.status, "time limit", given)

    def test_reaches_an_accuracy(self):
        solution = db.solve(PendulumSwingUp(), accuracy=1e-6, refinement="hp", intervals=16)
        self.assertTrue(solution.is_solved, solution)
        self.assertLess(solution.estimated_error(), 1e-6)
        self.assertGreater(solution.iterations, db.solve(PendulumSwingUp(), intervals=16).iterations)
        fine = db.solve(PendulumSwingUp(), intervals=512, stages=2)
        self.assertLess(abs(solution.cost - fine.cost), 1e-5 * fine.cost)

    def test_starts_from_a_solution(self):
        first = db.solve(PendulumSwingUp(), intervals=32)
        again = db.solve(PendulumSwingUp(length=1.01), intervals=64, start=first)
        self.assertTrue(again.is_solved)
        self.assertLess(again.iterations, first.iterations)

    def test_starts_from_arrays(self):
        class Guessed(PendulumSwingUp):
            guess = db.motion([0.0, 0.75, 1.5], [[0.0], [0.5 * np.pi], [np.pi]])

        a, b = db.solve(Guessed(), intervals=32), db.solve(PendulumSwingUp(), intervals=32)
        self.assertAlmostEqual(a.cost, b.cost, places=8)

    def test_reports_a_solve_that_fails_by_its_status(self):
        solution = db.solve(PendulumSwingUp(), most_iterations=1)
        self.assertFalse(solution.is_solved)
        self.assertEqual(solution.status, "iteration limit")
        self.assertIn("iteration limit", repr(solution))

    def test_arrays_outlive_solution_and_problem(self):
        problem = PendulumSwingUp()
        solution = db.solve(problem, intervals=16)
        q, u = solution.q, solution.stages.u
        expected = q.copy(), u.copy()
        del problem, solution
        self.assertTrue(np.array_equal(q, expected[0]) and np.array_equal(u, expected[1]))
        with self.assertRaises(ValueError):
            q[0, 0] = 1.0

    def test_does_not_leak(self):
        def resident():
            with open("/proc/self/statm") as file:
                return int(file.read().split()[1]) * 4096

        def work(count):
            for _ in range(count):
                db.solve(PendulumSwingUp(), intervals=16, solver="interior_point")

        work(50)
        before = resident()
        references = sys.getrefcount(PendulumSwingUp)
        work(200)
        self.assertLess(resident() - before, 8 * 2**20)
        self.assertLessEqual(sys.getrefcount(PendulumSwingUp), references + 2)

    def test_lets_other_threads_run_while_it_solves(self):
        count = 0
        done = threading.Event()

        def solve():
            db.solve(PendulumSwingUp(), intervals=4096, solver="interior_point")
            done.set()

        thread = threading.Thread(target=solve)
        thread.start()
        while not done.wait(0.001):
            count += 1
        thread.join()
        self.assertGreater(count, 3)

    def test_is_solved_in_several_threads_alike(self):
        costs = []
        threads = [threading.Thread(target=lambda: costs.append(db.solve(PendulumSwingUp(), intervals=128).cost))
                   for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(costs), 6)
        self.assertEqual(len(set(costs)), 1)


class RestatedProblems(unittest.TestCase):
    def test_of_the_library_have_its_costs(self):
        for cls, name in ((restated.CartPole, "cart_pole"), (restated.DoubleIntegrator, "double_integrator"),
                          (restated.Hovercraft, "hovercraft"), (restated.SphericalPendulum, "spherical_pendulum"),
                          (restated.TwoLinkManipulator, "two_link_manipulator"),
                          (restated.RollingDisk, "rolling_disk")):
            with self.subTest(name):
                a, b = (db.solve(problem, intervals=64, solver="interior_point") for problem in (cls(), name))
                self.assertTrue(a.is_solved, a)
                self.assertLess(abs(a.cost - b.cost), 1e-10 * abs(b.cost))

    @unittest.skipIf(library is None, "no library of problems is given")
    def test_with_every_kind_of_statement_have_the_costs_of_those_in_cpp(self):
        db.load_library(library)
        for cls, name in ((restated.TwoLinkWithMotors, "two_link_with_motors"),
                          (restated.OrbitalTransferWithMass, "orbital_transfer_with_mass"),
                          (restated.CannonballOfUnknownRadius, "cannonball"), (restated.ChainOfGivenLength, "hanging_chain"),
                          (restated.PushedInABand, "pushed_in_a_band"), (restated.PointsAtGivenTimes, "waypoints")):
            for method in ("dmoc", "tangent"):
                with self.subTest(name, method=method):
                    a, b = (db.solve(problem, method, intervals=64, stages=2) for problem in (cls(), name))
                    self.assertEqual(a.status, b.status)
                    self.assertTrue(a.is_solved or method == "tangent", a)
                    self.assertLess(abs(a.cost - b.cost), 1e-9 * abs(b.cost))
                    self.assertEqual(a.unknowns.keys(), b.unknowns.keys())

    def test_with_first_order_states_have_arrays_of_them(self):
        solution = db.solve(restated.TwoLinkWithMotors(), intervals=64, stages=2)
        self.assertTrue(solution.is_solved, solution)
        self.assertEqual([part.shape for part in (solution.y, solution.psi_y, solution.stages.y)], [(65, 2), (65, 2), (128, 2)])
        self.assertTrue(np.array_equal(solution.y[0], [0.0, 0.0]))
        self.assertTrue(np.array_equal(solution.column("current_2"), solution.y[:, 1]))
        induced = np.column_stack([solution.v[:, 0], solution.v[:, 1] - solution.v[:, 0]])
        change = np.diff(solution.y, axis=0)  # the voltages that the equations of the motors then need
        resisted = solution.y + induced
        voltage = 0.1 * change / np.diff(solution.t)[:, None] + 0.5 * (resisted[1:] + resisted[:-1])
        self.assertLess(abs(voltage - solution.stages.u.reshape(64, 2, 2).mean(axis=1)).max(), 0.02 * abs(voltage).max())

    def test_with_unknowns_report_what_they_found(self):
        solution = db.solve(restated.CannonballOfUnknownRadius(), intervals=64, stages=2)
        fixed = type("Fixed", (restated.CannonballOfUnknownRadius,),
                     {"radius": db.parameter(solution.unknowns["radius"] * 1.01)})
        self.assertNotAlmostEqual(solution.unknowns["radius"], 0.05, places=3)
        self.assertGreater(db.solve(fixed(), intervals=64, stages=2).cost, solution.cost)

    def test_with_integral_constraints_report_their_prices(self):
        solution = db.solve(restated.ChainOfGivenLength(), intervals=64, stages=2)
        self.assertAlmostEqual(solution.integrals[0], 4.0, places=9)
        longer, shorter = (db.solve(restated.ChainOfGivenLength(length=length), intervals=64, stages=2)
                           for length in (4.01, 3.99))
        self.assertAlmostEqual(solution.integral_prices[0], (longer.cost - shorter.cost) / 0.02, places=4)

    def test_with_bounds_of_path_constraints_keep_both_sides(self):
        solution = db.solve(restated.PushedInABand(), intervals=64)
        u, v = solution.stages.u[:, 0], solution.stages.v[:, 0]
        self.assertAlmostEqual((u + v).max(), 5.0, places=6)
        self.assertAlmostEqual((u + v).min(), -5.0, places=6)
        self.assertAlmostEqual(u.max(), 4.5, places=6)

    def test_report_the_prices_of_bounds(self):
        """Against differences of solves with other bounds."""
        def changed(base, **members):
            return type(base.__name__, (base,), members)()

        def slope(problem_of, at):
            more, less = (db.solve(problem_of(at + step), intervals=32, stages=2, tolerance=1e-11) for step in (1e-3, -1e-3))
            return (more.cost - less.cost) / 2e-3

        def in_band(upper):
            return changed(restated.PushedInABand, bounds={"path": ([-5.0, -math.inf], [upper, 4.5])})
        prices = db.solve(in_band(5.0), intervals=32, stages=2).prices
        acting = np.minimum(prices.path[:, 0], 0.0).sum() * (0.5 / 32)  # h b_i
        self.assertLess(acting, -0.01)
        self.assertAlmostEqual(acting, slope(in_band, 5.0), places=4)
        self.assertIsNone(prices.q)
        self.assertEqual((prices.unknowns, prices.horizon), ({}, 0.0))

        def at_most(radius):
            return changed(restated.CannonballOfUnknownRadius,
                           radius=db.unknown(0.03, "m", "of the ball", 0.01, radius))
        price = db.solve(at_most(0.035), intervals=32, stages=2).prices.unknowns["radius"]
        self.assertLess(price, 0.0)
        self.assertLess(abs(price / slope(at_most, 0.035) - 1.0), 0.01)

        def within(longest):
            return changed(restated.DoubleIntegrator, horizon=db.between(0.5, longest, guess=1.0))
        self.assertAlmostEqual(db.solve(within(1.2), intervals=32, stages=2).prices.horizon, -18.0 / 1.2**4, places=5)
        with self.assertRaisesRegex(AttributeError, "prices have no weight; they have q, v"):
            db.solve(within(1.2), intervals=32).prices.weight

    def test_of_textbooks_have_the_published_costs(self):
        for cls, cost, places, options in (
            (restated.ControlRate, 24.0 / 13.0, 3, {"intervals": 200}),
            (restated.HangingChain, 5.06848011099341, 3, {"intervals": 128}),
            (restated.MoonLanding, 1.4203126, 3, {"intervals": 128, "method": "tangent"}),
            (restated.Cannonball, -3.21336476, 5, {"intervals": 128, "stages": 2}),
            (restated.SlidingMass, 0.4, 4, {"intervals": 50, "solver": "ipopt"}),
        ):
            with self.subTest(cls.__name__):
                solution = db.solve(cls(), **options)
                self.assertIsNotNone(solution.cost, solution)
                self.assertAlmostEqual(solution.cost, cost, places=places, msg=str(solution))


if __name__ == "__main__":
    unittest.main()
