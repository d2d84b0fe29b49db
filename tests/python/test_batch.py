"""Batches from and to numpy arrays have the answers of single solves."""

import time
import unittest

import numpy as np

import dmocbench as db
from pendulum import PendulumSwingUp


class Cart(db.Problem):
    """a unit mass from rest to rest, whose least cost is 6 d^2 / T^3"""

    q, u = db.coordinates("x"), db.controls("f")
    horizon, start, end = 100.0, db.at_rest([0.0]), db.at_rest([1.0])

    def lagrangian(self, x):
        return 0.5 * x.v.x**2

    def force(self, x):
        return [x.u.f]

    def running_cost(self, x):
        return 0.5 * x.u.f**2


class Batches(unittest.TestCase):
    def test_over_tiny_distances_have_the_least_cost_wherever_they_are_solved(self):
        distance = 10.0 ** np.arange(-30.0, 3.5, 0.5)
        nothing = 0.0 * distance
        for method in ("dmoc", "hamiltonian", "tangent"):
            for offset in (0.0, 1.0):
                batch = db.solve_batch(Cart(), start=np.column_stack([nothing + offset, nothing]),
                                       end=np.column_stack([distance + offset, nothing]), intervals=32, method=method)
                moved = (distance + offset) - offset
                solved = np.asarray(batch.is_solved, dtype=bool)
                self.assertTrue(solved[distance > 1e-5].all(), batch.status)
                solved &= moved > 1e-13 * offset  # less is round-off of the ends
                least = 6.0 * moved[solved] ** 2 / Cart.horizon**3
                self.assertTrue((np.abs(batch.cost[solved] - least) <= 0.05 * least).all(), batch.cost[solved] / least)

    def test_over_states_have_the_answers_of_single_solves(self):
        start = np.column_stack([np.linspace(-0.2, 0.2, 17), np.zeros(17)])
        batch = db.solve_batch(PendulumSwingUp(), start=start, intervals=32, motions=True)
        self.assertTrue(batch.is_solved.all(), batch.status)
        for i in (0, 5, 16):
            problem = type("PendulumSwingUp", (PendulumSwingUp,), {"start": db.at_rest([start[i, 0]])})
            single = db.solve(problem, intervals=32, solver="interior_point")
            self.assertAlmostEqual(batch.cost[i], single.cost, delta=1e-8 * single.cost)
            self.assertTrue(np.allclose(batch.q[i], single.q, atol=1e-6))
            self.assertTrue(np.allclose(batch.u[i], single.stages.u, atol=1e-5))

    def test_over_parameters_have_the_answers_of_single_solves(self):
        length = np.linspace(0.8, 1.2, 9)
        batch = db.solve_batch(PendulumSwingUp(), parameters={"length": length}, intervals=32)
        self.assertTrue(batch.is_solved.all(), batch.status)
        for i in (0, 4, 8):
            single = db.solve(PendulumSwingUp(length=length[i]), intervals=32, solver="interior_point")
            self.assertAlmostEqual(batch.cost[i], single.cost, delta=1e-8 * single.cost)

    def test_do_not_depend_on_the_number_of_threads(self):
        start = np.column_stack([np.linspace(-0.2, 0.2, 40), np.zeros(40)])
        one, two = (db.solve_batch(PendulumSwingUp(), start=start, intervals=32, threads=threads) for threads in (1, 2))
        self.assertTrue(np.array_equal(one.cost, two.cost))

    def test_end_with_the_time_of_the_call(self):
        start = np.column_stack([np.linspace(-0.2, 0.2, 2000), np.zeros(2000)])
        began = time.monotonic()
        batch = db.solve_batch(PendulumSwingUp(), start=start, intervals=4096, most_seconds=1)
        self.assertLess(time.monotonic() - began, 5)
        self.assertEqual(set(batch.status) - {"solved"}, {"time limit"})
        length = np.linspace(0.8, 1.2, 20)
        batch = db.solve_batch(PendulumSwingUp(), parameters={"length": length}, intervals=64, most_seconds=1e-6)
        self.assertEqual(set(batch.status), {"time limit"})
        self.assertTrue(np.isnan(batch.cost).all())

    def test_keep_answers_when_the_time_ends_while_close_ends_are_solved_again(self):
        end = np.column_stack([np.linspace(1e-7, 2e-7, 100), np.zeros(100)])
        began = time.monotonic()
        self.assertTrue(db.solve_batch(PendulumSwingUp(), end=end, intervals=64).is_solved.all())
        all_take = time.monotonic() - began
        for share in (0.4, 0.5, 0.6, 0.7):
            batch = db.solve_batch(PendulumSwingUp(), end=end, intervals=64, most_seconds=share * all_take)
            self.assertTrue(batch.is_solved.any())
            self.assertLessEqual(set(batch.status), {"solved", "time limit"})

    def test_take_built_in_problems(self):
        batch = db.solve_batch("cart_pole", parameters={"length": [0.45, 0.5, 0.55]}, intervals=48)
        self.assertAlmostEqual(batch.cost[1], db.solve("cart_pole", intervals=48).cost, places=6)

    def test_refuse_values_of_what_a_solve_chooses(self):
        with self.assertRaisesRegex(db.Error, "^cannonball: the unknown radius is determined by the solve and cannot be set"):
            db.solve_batch("cannonball", parameters={"radius": [0.04, 0.05]})


if __name__ == "__main__":
    unittest.main()
