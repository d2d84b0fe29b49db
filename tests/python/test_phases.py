"""Problems of several phases: solutions, their motions by phase, and mistakes."""

import csv
import os
import tempfile
import unittest

import numpy as np

import dmocbench as db


class Flight(db.Problem):
    """one flight of a ball"""

    q = db.coordinates("z", unit="m")
    u = db.controls("push", unit="N")
    gravity = db.parameter(9.81, "m/s^2", lower=0.0)
    horizon = db.between(0.05, 2.0, guess=0.6)

    def __init__(self, start, end, **values):
        super().__init__(**values)
        self.start, self.end = start, end

    def lagrangian(self, x):
        return 0.5 * x.v.z**2 - self.gravity * x.q.z

    def force(self, x):
        return x.u

    def running_cost(self, x):
        return 0.5 * x.u.push**2


def fall(**values):
    return Flight(db.at_rest(z=1.0), db.state([db.free()], [db.free(-4.0)]), **values)


def rise(**values):
    return Flight(db.state([db.free()], [db.free(3.0)]), db.state([1.1], [0.5]), **values)


class Ball(db.Phases):
    """a ball bounces once"""

    e = db.parameter(0.7, lower=0.0, upper=1.0)
    impulse = db.unknown(7.0, "N s")
    fall = fall()
    rise = rise()

    def fall_to_rise(self, before, after):
        return db.impact(before, after, lambda q: [q.z], self.e, self.impulse)

    def conditions(self, first, last):
        return [last.rise.t - 1.2]


def variant(**members):
    return type("Ball", (Ball,), members)


class Solutions(unittest.TestCase):
    def test_are_the_closed_form(self):
        for e, cost, time in ((0.7, 13.578573105569905, 0.56528634841633673), (1.0, 10.258191327671888, 0.65117240677679886)):
            for method in ("dmoc", "hamiltonian", "tangent"):
                with self.subTest(e=e, method=method):
                    solution = db.solve(Ball(e=e), method=method, intervals=8, stages=2)
                    self.assertAlmostEqual(solution.cost, cost, delta=1e-9)
                    self.assertAlmostEqual(solution.unknowns["duration_fall"], time, delta=1e-8)
                    self.assertLess(solution.replay_error, 1e-7)

    def test_have_the_motion_of_every_phase(self):
        solution = db.solve(Ball(), intervals=8)
        phases = solution.phases
        self.assertEqual(list(phases), ["fall", "rise"])
        self.assertEqual(phases["fall"].coordinates, ["z"])
        self.assertAlmostEqual(phases["fall"].duration, solution.unknowns["duration_fall"], delta=1e-14)
        self.assertAlmostEqual(phases["rise"].t[0], phases["fall"].t[-1], delta=1e-14)
        self.assertAlmostEqual(phases["rise"].t[-1], 1.2, delta=1e-9)
        self.assertAlmostEqual(phases["rise"].v[0, 0], -0.7 * phases["fall"].v[-1, 0], delta=1e-9)
        self.assertAlmostEqual(phases["rise"].p[0, 0] - phases["fall"].p[-1, 0], solution.unknowns["impulse"], delta=1e-9)
        np.testing.assert_allclose(phases["fall"].column("z"), solution.column("fall_z"))
        self.assertEqual(phases["fall"].u.shape, (8, 1))
        self.assertEqual(db.solve("double_integrator", intervals=8).phases, {})

    def test_share_parameters_of_one_name(self):
        light = db.solve(Ball(gravity=1.6), intervals=8, stages=2)
        stated = variant(fall=fall(gravity=1.6), rise=rise(gravity=1.6))
        self.assertAlmostEqual(light.cost, db.solve(stated(), intervals=8, stages=2).cost, delta=1e-12)
        self.assertEqual(Ball(gravity=1.6).parameters()["gravity"], 1.6)

    def test_of_generated_phases_are_the_ones_of_one_grid(self):
        class Push(db.Problem):
            q, u = db.coordinates("x"), db.controls("f")
            horizon = 0.25

            def __init__(self, start, end):
                self.start, self.end = start, end

            def lagrangian(self, x): return 0.5 * x.v.x**2
            def force(self, x): return x.u
            def running_cost(self, x): return 0.5 * x.u.f**2

        ends = [db.at_rest(x=0.0), *[db.state([db.free(0.5)], [db.free(1.0)])] * 3, db.at_rest(x=1.0)]

        class Pushes(db.Phases):
            phases = {f"p{i}": Push(ends[i], ends[i + 1]) for i in range(4)}

        whole = db.solve("double_integrator", intervals=32)
        parts = db.solve(Pushes(), intervals=8)
        self.assertAlmostEqual(parts.cost, whole.cost, delta=1e-10)
        joined = np.concatenate([parts.phases[f"p{i}"].q[:-1, 0] for i in range(4)])
        np.testing.assert_allclose(joined, whole.q[:-1, 0], atol=1e-10)


class Experiments(unittest.TestCase):
    """Every experiment sees one problem."""

    def test_have_equal_solutions_and_orders(self):
        with tempfile.TemporaryDirectory() as folder:
            results = db.run("equivalence", Ball, out=folder, intervals=16, tableau="gauss", stages=1)
            self.assertTrue(results)
            slopes = db.convergence(Ball, out=folder, intervals=[16, 32, 64, 128, 256], method=["dmoc", "tangent"])
            self.assertTrue(slopes)
            with open(os.path.join(folder, "convergence_slopes.csv"), encoding="utf-8") as file:
                fitted = [float(row["slope"]) for row in csv.DictReader(file) if row["quantity"] == "state" and row["slope"]]
            self.assertEqual(len(fitted), 2)
            for slope in fitted:
                self.assertAlmostEqual(slope, 2.0, delta=0.1)

    def test_are_solved_by_experiments_that_compare_many_solves(self):
        options = {"derivatives": {}, "local_minima": {"starts": 2}, "savings_by_solver": {},
                   "sequence": {"steps": 2, "over": "e=0.7:1"}}
        for experiment, further in options.items():
            with self.subTest(experiment), tempfile.TemporaryDirectory() as folder:
                results = db.run(experiment, Ball, out=folder, method="dmoc", intervals=8, **further)
                table = results if len(results) else results.further["sequence"]
                rows = [row for row in table if row.get("derivatives", "tape") == "tape"]
                self.assertTrue(rows)
                self.assertEqual({row["status"] for row in rows}, {"solved"})
                self.assertEqual({row.get("sequence", "homotopy") for row in rows}, {"homotopy"})

    def test_sweep_a_parameter(self):
        with tempfile.TemporaryDirectory() as folder:
            db.run("sweep", Ball, out=folder, over="e=0.7:1:2", intervals=32)
            with open(os.path.join(folder, "sweep.csv"), encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual([row["status"] for row in rows], ["solved", "solved"])
        for row, cost in zip(rows, (13.578573105569905, 10.258191327671888)):
            self.assertAlmostEqual(float(row["objective"]), cost, delta=0.01)


class Mistakes(unittest.TestCase):
    def refused(self, sentence, problem):
        with self.assertRaisesRegex(db.Error, sentence):
            db.solve(problem, intervals=8)

    def test_get_a_sentence(self):
        class Nothing(db.Phases):
            pass

        self.refused("nothing has no phases", Nothing)
        self.refused("phase rise: the parameter gravity has another value, range or kind", variant(rise=rise(gravity=1.6)))
        self.refused("has 1 entry,", variant(fall_to_rise=lambda self, before, after: after.q - before.q))
        self.refused("fall_to_moon does not join two phases", variant(fall_to_moon=lambda self, before, after: []))
        self.refused("follows refers to moon", variant(follows={"rise": "moon"}))
        with self.assertRaisesRegex(AttributeError, "there is no phase moon; choose one of fall, rise"):
            db.solve(variant(conditions=lambda self, first, last: [last.moon.t - 1.0]))
        self.refused("link: returns None", variant(fall_to_rise=lambda self, before, after: None))
        self.refused("1 guard has 2 impulses", variant(
            fall_to_rise=lambda self, before, after: db.impact(before, after, lambda q: [q.z], 0.5, [1.0, 2.0])))
        with self.assertRaisesRegex(db.Error, "no parameter moon"):
            Ball(moon=1.0)

    def test_of_members_that_phases_state(self):
        for member in ("guess", "final_cost", "path_constraints", "waypoints"):
            with self.subTest(member), self.assertRaisesRegex(db.Error, f"states {member}, which is not used; state it in each phase"):
                db.solve(variant(**{member: lambda self, *arguments: []})(), intervals=8)

    def test_of_a_scaled_cost_are_the_same(self):
        plain, scaled = db.solve(Ball(), intervals=8), db.solve(variant(cost_scale=1e-3)(), intervals=8)
        self.assertAlmostEqual(scaled.cost, plain.cost, delta=1e-8 * plain.cost)

    def test_without_a_positive_duration(self):
        flight = rise()
        flight.horizon = db.between(0.0, 2.0, guess=0.6)
        self.refused("horizon must be positive|positive", variant(rise=flight))


if __name__ == "__main__":
    unittest.main()
