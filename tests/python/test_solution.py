"""What users do with a solution: read it at any time, draw it, show it, keep it, watch it on its way."""

import contextlib
import copy
import io
import multiprocessing
import os
import pickle
import subprocess
import sys
import unittest

import numpy as np

import dmocbench as db
import restated
from pendulum import PendulumSwingUp

here = os.path.dirname(os.path.abspath(__file__))


def arrays_of(solution):
    parts = [(solution, ("t", "q", "v", "p", "psi", "y", "psi_y")), (solution.stages, ("t", "q", "v", "u", "p", "y", "psi_q")),
             (solution.prices, ("q", "v", "stage_u", "path"))]
    return [getattr(part, name) for part, names in parts for name in names]


def is_same(a, b):
    return all((one is None) == (other is None) and (one is None or np.array_equal(one, other))
               for one, other in zip(arrays_of(a), arrays_of(b)))


def missing(package):
    try:
        __import__(package)
    except ImportError:
        return True
    return False


class Trajectories(unittest.TestCase):
    def test_pass_through_nodes_and_their_rates_are_derivatives(self):
        solution = db.solve(restated.CartPole(), intervals=64)
        at_nodes = solution.at(solution.t)
        self.assertLess(abs(at_nodes.q - solution.q).max(), 1e-14)
        self.assertLess(abs(at_nodes.v - solution.v).max(), 1e-13)
        times, step = np.linspace(0.1, 1.9, 50), 1e-5
        slopes = (solution.at(times + step).q - solution.at(times - step).q) / (2.0 * step)
        self.assertLess(abs(slopes - solution.at(times).v).max(), 1e-6)
        self.assertLess(abs(solution.at(solution.stages.t).u - solution.stages.u).max(), 1e-12)

    def test_of_first_order_states_are_read_by_name(self):
        solution = db.solve(restated.TwoLinkWithMotors(), intervals=32, stages=2)
        point = solution.at(0.5)
        self.assertEqual(point.y.current_1, point.y[0])
        self.assertEqual(solution.at([0.25, 0.5]).y.current_2[1], point.y[1])

    def test_are_points_for_the_formulas_of_the_problem(self):
        problem = restated.CartPole()
        solution = db.solve(problem, intervals=512)
        times = np.linspace(0.0, 2.0, 2001)
        cost = np.trapezoid if hasattr(np, "trapezoid") else np.trapz
        costs = [problem.running_cost(solution.at(t)) for t in times]
        self.assertAlmostEqual(cost(costs, times) / solution.cost, 1.0, places=3)
        self.assertIsInstance(problem.lagrangian(solution.at(0.3)), float)

    def test_end_at_the_horizon(self):
        solution = db.solve(PendulumSwingUp(), intervals=16)
        with self.assertRaisesRegex(db.Error, r"t = 1.6 lies outside the horizon \[0, 1.5\]"):
            solution.at(1.6)
        with self.assertRaisesRegex(db.Error, "t = nan lies outside"):
            solution.at(float("nan"))


class Starts(unittest.TestCase):
    def test_are_solutions_motions_and_arrays(self):
        solved = db.solve(restated.CartPole(), intervals=64)
        u = np.array(solved.at(solved.t).u)
        fresh = db.solve(restated.CartPole(), intervals=64)
        for start in (solved, (solved.t, solved.q, solved.v, u), [solved.t + 3.0, solved.q], db.motion(solved.t, solved.q, u=u)):
            again = db.solve(restated.CartPole(), intervals=64, start=start)
            self.assertTrue(again.is_solved)
            self.assertLess(again.iterations, fresh.iterations)
            self.assertAlmostEqual(again.cost / solved.cost, 1.0, places=9)

    def test_that_do_not_fit_are_refused(self):
        for start, sentence in ((3, "start= takes a Solution, a motion or arrays"), (([0, 1],), "start= has 1 arrays"),
                                (([0, 1], [[0, 0], [1, 1]]), "start= has 2 coordinates, 1 controls"),
                                (([1, 0], [[0], [1]]), "times, in ascending order")):
            with self.assertRaisesRegex(db.Error, sentence):
                db.solve(PendulumSwingUp(), start=start)


class Copies(unittest.TestCase):
    def test_by_pickle_have_the_same_numbers_and_serve_the_same_purposes(self):
        for problem, options in ((PendulumSwingUp(), {"intervals": 32}), (restated.TwoLinkWithMotors(), {"stages": 2}),
                                 (restated.CannonballOfUnknownRadius(), {"stages": 2}), ("cart_pole", {"method": "tangent"}),
                                 (restated.PushedInABand(), {"tableau": "lobatto", "stages": 3}),
                                 (PendulumSwingUp(), {"method": "multiple_shooting_rk4_1"}),
                                 (PendulumSwingUp(), {"most_iterations": 1})):
            with self.subTest(problem=str(problem), **options):
                solution = db.solve(problem, **options)
                kept = pickle.loads(pickle.dumps(solution))
                twice = pickle.loads(pickle.dumps(kept))
                for other in (kept, twice, copy.copy(solution), copy.deepcopy(solution), copy.deepcopy(kept)):
                    self.assertEqual(repr(other), repr(solution))
                    self.assertTrue(is_same(other, solution))
                    self.assertEqual(other.unknowns, solution.unknowns)
                    self.assertTrue(np.array_equal(other.at(solution.t).u, solution.at(solution.t).u))
                a, b = (db.solve(problem, **options, start=start) for start in (solution, kept))
                self.assertEqual((a.status, a.iterations, a.cost), (b.status, b.iterations, b.cost))

    def test_by_pickle_keep_the_forces_of_constraint(self):
        for method, names in (("dmoc", ("left_impulses", "right_impulses")), ("tangent", ("stage_constraint_forces",))):
            solution = db.solve("chaplygin_sleigh_cartesian", method=method, intervals=16)
            kept = pickle.loads(pickle.dumps(solution))
            for name in names:
                forces, copied = (getattr(one._answer.motion, name) for one in (solution, kept))
                self.assertGreater(abs(forces).max(), 0.0)
                self.assertTrue(np.array_equal(forces, copied))

    def test_by_pickle_know_their_estimated_error_or_why_there_is_none(self):
        solution = db.solve(PendulumSwingUp(), intervals=32)
        self.assertEqual(pickle.loads(pickle.dumps(solution)).estimated_error(), solution.estimated_error())
        bounded = db.solve(restated.PushedInABand(), intervals=32)
        for one in (bounded, pickle.loads(pickle.dumps(bounded))):
            with self.assertRaisesRegex(db.Error, "bound"):
                one.estimated_error()

    def test_of_problems_are_solved_alike(self):
        for problem in (PendulumSwingUp(length=1.2), db.problem("cart_pole", length=0.6)):
            other = pickle.loads(pickle.dumps(problem))
            self.assertEqual(db.solve(problem, intervals=16).cost, db.solve(other, intervals=16).cost)

    def test_come_out_of_process_pools(self):
        problems = [PendulumSwingUp(length=0.9), PendulumSwingUp(length=1.1), db.problem("cart_pole", length=0.6)]
        here_and_now = [db.solve(problem).cost for problem in problems]
        for way in ("fork", "spawn"):
            with self.subTest(way), multiprocessing.get_context(way).Pool(2) as pool:
                self.assertEqual([solution.cost for solution in pool.map(db.solve, problems)], here_and_now)


class Watching(unittest.TestCase):
    def test_sees_every_iteration_and_the_cost_at_the_end(self):
        for solver in ("interior_point", "ipopt", "sqp", "nlopt", "auto"):
            with self.subTest(solver):
                seen = []
                solution = db.solve(restated.CartPole(), intervals=16, solver=solver, callback=seen.append)
                self.assertTrue(solution.is_solved)
                self.assertEqual([one.number for one in seen], list(range(1, len(seen) + 1)))
                self.assertEqual(len(seen), solution.iterations or len(seen))
                self.assertEqual({one.solver for one in seen}, {solution.solver})
                self.assertAlmostEqual(seen[-1].cost / solution.cost, 1.0, places=6)
                self.assertLess(seen[-1].violation, 1e-6)
                self.assertLess(seen[-1].violation, seen[0].violation)

    def test_does_not_change_a_solve(self):
        a, b = (db.solve(restated.CartPole(), callback=callback) for callback in (None, lambda iteration: None))
        self.assertEqual((a.cost, a.iterations), (b.cost, b.iterations))
        self.assertTrue(is_same(a, b))

    def test_ends_a_solve_when_it_says_so(self):
        for solver in ("interior_point", "ipopt", "sqp", "nlopt", "auto"):
            with self.subTest(solver):
                seen = []
                solution = db.solve(restated.CartPole(), solver=solver, intervals=16,
                                    callback=lambda one: seen.append(one) or one.number == 2)
                self.assertEqual((solution.status, len(seen)), ("interrupted", 2))
                if solver != "nlopt":  # whose answer is the nearest point that it has visited
                    self.assertAlmostEqual(solution.cost / seen[-1].cost, 1.0, places=6)

    def test_may_solve_another_problem_which_it_does_not_see(self):
        others, seen = [], []

        def look(iteration):
            seen.append(iteration.number)
            others.append(db.solve(PendulumSwingUp(), intervals=16).cost)

        solution = db.solve(restated.CartPole(), intervals=16, callback=look)
        self.assertEqual(seen, list(range(1, solution.iterations + 1)))
        self.assertEqual(set(others), {db.solve(PendulumSwingUp(), intervals=16).cost})

    def test_ends_an_accuracy_and_keeps_the_grid_before(self):
        grids = []

        def third_grid(iteration):
            grids.extend([iteration] if iteration.number == 1 else [])
            return len(grids) == 3

        solution = db.solve(restated.CartPole(), intervals=32, accuracy=1e-8, callback=third_grid)
        self.assertEqual((solution.status, len(grids)), ("interrupted", 3))
        self.assertIsNotNone(solution.cost)

    def test_raises_what_it_raises(self):
        def fail(iteration):
            raise LookupError(f"in iteration {iteration.number}")

        for options in ({}, {"solver": "ipopt"}, {"accuracy": 1e-4}):
            with self.assertRaisesRegex(LookupError, "in iteration 1"):
                db.solve(restated.CartPole(), callback=fail, **options)
        self.assertTrue(db.solve(restated.CartPole()).is_solved)
        with self.assertRaisesRegex(db.Error, "callback= takes a function"):
            db.solve(PendulumSwingUp(), callback=3)

    def test_of_an_accuracy_prints_a_line_per_grid(self):
        code = ("import dmocbench as db; from pendulum import PendulumSwingUp\n"
                "db.solve(PendulumSwingUp(), intervals=16, accuracy=1e-5, verbose=True)")
        done = subprocess.run([sys.executable, "-c", code], cwd=here, check=True, capture_output=True, text=True)
        grids = [line for line in done.stdout.splitlines() if line.startswith("grid of ")]
        self.assertGreater(len(grids), 1)
        self.assertRegex(grids[0], r"^grid of 16 intervals, 1 stage: estimated error \d\.\de-\d\d, \d+ iterations, \S+ s$")
        with contextlib.redirect_stdout(io.StringIO()) as silent:
            db.solve(PendulumSwingUp(), intervals=16, accuracy=1e-5)
        self.assertEqual(silent.getvalue(), "")


class Shown(unittest.TestCase):
    def test_in_a_notebook_with_rows_and_units(self):
        page = db.solve(PendulumSwingUp(), intervals=16)._repr_html_()
        self.assertRegex(page, r"<td>theta</td><td>rad</td><td>0</td><td>3.14159</td>")
        self.assertIn("solved", page)
        self.assertIn("iteration limit", db.solve(PendulumSwingUp(), most_iterations=1)._repr_html_())
        table = db.Table(["name", "size", "none"], [{"name": f"<{i}>", "size": i / 3, "none": None} for i in range(12)])
        self.assertIn("<td>&lt;1&gt;</td><td>0.333333</td>", table._repr_html_())
        self.assertIn("2 more rows", table._repr_html_())
        self.assertNotIn("none", table._repr_html_())
        self.assertRegex(repr(table), r"(?s)12 rows and 3 columns.*<1> +0.333333\n.*2 more rows$")
        self.assertIn("0 rows: name", repr(db.Table(["name"], [])))
        self.assertRegex(repr(db.Table(["same", "other"], [{"same": 1, "other": 1}, {"same": 1, "other": 2}])), r"\nother  same\n")

    @unittest.skipIf(missing("pandas"), "pandas is not installed")
    def test_as_data_frames_with_the_controls(self):
        solution = db.solve(restated.TwoLinkWithMotors(), intervals=16, stages=2)
        nodes, stages = solution.to_pandas(), solution.to_pandas(at="stages")
        self.assertEqual((len(nodes), len(stages)), (17, 32))
        for frame in (nodes, stages):
            self.assertEqual(list(frame.columns), ["t", "theta_1", "theta_2", "rate_theta_1", "rate_theta_2", "momentum_theta_1",
                                                   "momentum_theta_2", "current_1", "current_2", "voltage_1", "voltage_2"])
        self.assertTrue(np.array_equal(stages["voltage_2"], solution.stages.u[:, 1]))
        self.assertTrue(np.array_equal(nodes["voltage_1"], solution.at(solution.t).u[:, 0]))
        with self.assertRaisesRegex(db.Error, 'at= takes "nodes" or "stages"'):
            solution.to_pandas(at="ends")

    @unittest.skipIf(missing("matplotlib"), "matplotlib is not installed")
    def test_in_a_plot_with_names_and_units(self):
        import matplotlib

        matplotlib.use("Agg")
        axes = db.solve(PendulumSwingUp(), intervals=16).plot()
        self.assertEqual([axis.get_ylabel() for axis in axes], ["theta [rad]", "tau [N m]"])
        self.assertEqual(axes[-1].get_xlabel(), "t [s]")
        line = axes[0].lines[0]
        self.assertAlmostEqual(line.get_ydata()[-1], np.pi, places=9)
        motors = db.solve(restated.TwoLinkWithMotors(), intervals=16, stages=2)
        self.assertEqual([axis.get_ylabel() for axis in motors.plot("current_1", "voltage_2")], ["current_1", "voltage_2 [V]"])
        with self.assertRaisesRegex(db.Error, "no phi to plot; choose one of theta, tau"):
            db.solve(PendulumSwingUp(), intervals=16).plot("phi")
        matplotlib.pyplot.close("all")

    @unittest.skipIf(missing("matplotlib"), "matplotlib is not installed")
    def test_in_an_animation_that_ends_where_the_motion_does(self):
        import matplotlib

        matplotlib.use("Agg")

        def rod(x):
            return [(0.0, 0.0), (np.sin(x.q.theta), -np.cos(x.q.theta))]

        solution = db.solve(PendulumSwingUp(), intervals=16)
        for animation, tip in ((solution.animate(rod, frames=3), [0.0, 1.0]),
                               (db.solve("cart_pole", intervals=16).animate(frames=3), [1.0, 0.5])):
            self.assertEqual(animation.to_jshtml().count("data:image/png"), 3)
            line, _ = animation._func(2)
            self.assertLess(abs(np.array(line.get_data())[:, 1] - tip).max(), 1e-6)
        with self.assertRaisesRegex(db.Error, "give animate\\(\\) a function"):
            solution.animate()
        matplotlib.pyplot.close("all")

    def test_as_long_as_nothing_is_drawn_without_matplotlib(self):
        code = "import sys, dmocbench as db; db.solve('cart_pole'); sys.exit('matplotlib' in sys.modules or 'pandas' in sys.modules)"
        self.assertEqual(subprocess.run([sys.executable, "-c", code]).returncode, 0)


if __name__ == "__main__":
    unittest.main()
