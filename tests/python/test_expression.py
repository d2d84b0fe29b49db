"""Traced numbers in Python: operators, functions, numpy, and what they refuse with which advice."""

import math
import unittest

import numpy as np

import dmocbench as db
from pendulum import PendulumSwingUp


class Seen(PendulumSwingUp):
    """Hands the point of its Lagrangian to a function."""

    def __init__(self, look):
        super().__init__()
        self.look = look

    def lagrangian(self, x):
        self.look(x)
        return super().lagrangian(x)


def at_point(look):
    Seen(look).handle()


class Expressions(unittest.TestCase):
    def test_have_the_operators_of_numbers(self):
        def look(x):
            a, b = x.q.theta, x.v.theta
            for formula in (a + b, a - b, a * b, a / b, -a, +a, 2 - a, 2.0 / a, np.float64(2.0) * a, a * np.int64(3), a**3,
                            a**-0.5, 1 + a):
                self.assertIsInstance(formula, db.Expression)

        at_point(look)

    def test_have_the_functions_of_numbers_and_of_numpy(self):
        def look(x):
            a = x.q.theta
            for function in (db.sqrt, db.exp, db.log, db.sin, db.cos, db.tan, db.asin, db.acos, db.atan, db.sinh, db.cosh,
                             db.tanh, db.asinh, db.erf, np.sqrt, np.exp, np.log, np.sin, np.cos, np.tan, np.arcsin,
                             np.arccos, np.arctan, np.sinh, np.cosh, np.tanh, np.arcsinh):
                self.assertIsInstance(function(a), db.Expression, function)
            for function in (db.atan2, db.hypot, np.arctan2, np.hypot):
                self.assertIsInstance(function(a, 2.0), db.Expression, function)
            self.assertEqual(repr(np.cos(a) + np.sin(a)), repr(db.cos(a) + db.sin(a)))

        at_point(look)

    def test_print_themselves_as_python_would_write_them(self):
        class Point:
            def __init__(self, **parts):
                self.__dict__.update(parts)

        def formulas(q, v, length):
            a, b = q.theta, v.theta
            return [a, b, 0.5 * length**2 * b**2 + 9.81 * length * db.cos(a), a - (b - length), -(a + b) * length, a / (b * length),
                    1 / (a + 2) + a**3, (a * b)**-0.5, a / b / length, -a**2, (-a)**2, 2 * db.atan2(a, b) - db.hypot(a, b),
                    db.exp(-db.sqrt(a)) * db.erf(b), (a - 1.5) * (-2.5), db.smooth_max(a, b, 0.1), (a / b) * (b / length)]

        def look(x):
            numbers = Point(theta=0.7), Point(theta=1.3), 0.4
            wanted = formulas(*numbers)
            for formula, number in zip(formulas(x.q, x.v, x.t), wanted):
                text = repr(formula)
                self.assertNotIn("<", text)
                value = eval(text, {**vars(db), "q": numbers[0], "v": numbers[1], "t": numbers[2]})
                self.assertAlmostEqual(float(value) / float(number), 1.0, places=12, msg=text)
            self.assertEqual(f"{x.q.theta} {x.u.tau if hasattr(x, 'u') else x.v.theta}", "q.theta v.theta")
            grown = x.q.theta
            for _ in range(300):
                grown = db.sin(grown * grown + x.v.theta)
            self.assertRegex(repr(grown), r"^sin\(.{400,600}\.\.\. \(900 operations\)$")

        at_point(look)
        opened = []

        class Open(PendulumSwingUp):
            def lagrangian(self, x):
                opened.append(repr(self.length * x.v.theta))
                return super().lagrangian(x)

        db.solve_batch(Open(), parameters={"length": [1.0, 1.1]}, intervals=8)
        self.assertIn("v.theta*length", opened)

    def test_fill_arrays(self):
        def look(x):
            vector = np.array([x.q.theta, x.v.theta, 1.0], dtype=object)
            matrix = np.array([[1.0, 2.0, 0.0], [0.0, x.q.theta, 1.0]], dtype=object)
            self.assertEqual((matrix @ vector).shape, (2,))
            self.assertIsInstance(vector @ vector, db.Expression)
            self.assertIsInstance((db.cos(vector) * np.array([1.0, 2.0, 3.0])).sum(), db.Expression)
            self.assertIsInstance(x.q.theta * np.array([2.0]), np.ndarray)
            self.assertEqual((x.q - 2.0 * x.v).shape, (1,))
            self.assertEqual(np.sin(x.q).shape, (1,))

        at_point(look)

    def test_of_arrays_without_dimensions_are_formulas(self):
        spline = db.Spline([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])

        def look(x):
            a = x.q.theta
            self.assertIsInstance(x.q @ x.v, db.Expression)
            for function in (db.sqrt, db.cos, spline, lambda b: db.atan2(b, 1.0), lambda b: db.hypot(1.0, b)):
                self.assertEqual(repr(function(np.array(a, dtype=object))), repr(function(a)))
            self.assertEqual(db.cos(np.array(1.0)), math.cos(1.0))

        at_point(look)

    def test_give_functions_of_numbers_where_numbers_are(self):
        self.assertEqual(db.cos(1.0), math.cos(1.0))
        self.assertEqual(db.atan2(1.0, 2.0), math.atan2(1.0, 2.0))
        self.assertEqual(list(db.sin(np.array([1.0, 2.0]))), [math.sin(1.0), math.sin(2.0)])
        self.assertEqual(list(db.sin([1.0, 2.0])), [math.sin(1.0), math.sin(2.0)])

    def refuses(self, kind, advice, use):
        def look(x):
            with self.assertRaisesRegex(kind, advice):
                use(x.q.theta)

        at_point(look)

    def test_refuse_to_branch_and_name_smooth_if_else(self):
        for use in (bool, lambda a: a > 0.0, lambda a: a == 0.0, lambda a: max(a, 1.0), lambda a: not a):
            self.refuses(TypeError, "smooth_if_else", use)

    def test_refuse_to_be_numbers_and_name_the_right_function(self):
        for use in (math.cos, float, int):
            self.refuses(TypeError, "dmocbench.cos or numpy.cos", use)

    def test_functions_refuse_what_is_no_number_also_inside_arrays(self):
        endless = np.empty(1, dtype=object)
        endless[0] = endless
        for function in (db.sin, db.cos, db.exp, db.sqrt):
            for wrong in (b"x", "x", np.array([b"x"]), np.array(["x"]), [1.0, None], endless, {}):
                with self.assertRaisesRegex(TypeError, "takes a number, a formula or an array of them, not "):
                    function(wrong)

    def test_refuse_kinks_and_formulas_as_exponents(self):
        self.refuses(TypeError, "smooth_abs", abs)
        self.refuses(TypeError, r"exp\(y \* log\(x\)\)", lambda a: a**a)
        self.refuses(TypeError, r"exp\(y \* log\(x\)\)", lambda a: 2.0**a)
        self.refuses(TypeError, "jumps", lambda a: a % 2.0)
        self.refuses(TypeError, "takes a number, a formula", lambda a: db.atan2(a, "x"))
        self.refuses(TypeError, "unsupported operand", lambda a: a + "x")

    def test_have_entries_by_name_and_by_number(self):
        def look(x):
            self.assertEqual(repr(x.q.theta), repr(x.q[0]))
            with self.assertRaisesRegex(AttributeError, "q has no entry phi; it has theta"):
                x.q.phi
            with self.assertRaisesRegex(IndexError, "out of bounds"):
                x.q[1]
            self.assertEqual(repr(x.q["theta"]), repr(x.q[0]))
            with self.assertRaisesRegex(AttributeError, "x has no theta; write x.q.theta \\(x.v.theta for its rate\\)"):
                x.theta
            with self.assertRaisesRegex(AttributeError, "x has no qdot; it has q, v"):
                x.qdot
            with self.assertRaisesRegex(AttributeError, "the Lagrangian"):
                x.u

        at_point(look)


if __name__ == "__main__":
    unittest.main()
