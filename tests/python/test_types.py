"""Type hints name what the package has, no more and no less, and type checkers accept them."""

import ast
import inspect
import os
import re
import subprocess
import sys
import tempfile
import typing
import unittest
from typing import get_args

import dmocbench as db
from dmocbench import _core, names
from pendulum import PendulumSwingUp

here = os.path.dirname(os.path.abspath(__file__))
package = os.path.dirname(os.path.abspath(db.__file__))


def public(names):
    return {name for name in names if not name.startswith("_")}


def stated(body):
    """The names that statements of a stub define."""
    names = set()
    for statement in body:
        if isinstance(statement, (ast.ClassDef, ast.FunctionDef)):
            names.add(statement.name)
        elif isinstance(statement, ast.AnnAssign):
            names.add(statement.target.id)
    return names


class Stubs(unittest.TestCase):
    def setUp(self):
        with open(os.path.join(package, "_core.pyi")) as file:
            self.body = ast.parse(file.read()).body

    def test_name_what_the_module_has(self):
        self.assertEqual(public(stated(self.body)), public(vars(_core)))

    def test_name_what_its_classes_have(self):
        for stub in self.body:
            if isinstance(stub, ast.ClassDef) and stub.name != "Error":
                with self.subTest(stub.name):
                    self.assertEqual(public(stated(stub.body)), public(vars(getattr(_core, stub.name))))


class Hints(unittest.TestCase):
    def test_of_functions_name_every_argument(self):
        for name in public(vars(db)):
            value = getattr(db, name)
            if inspect.isfunction(value):
                with self.subTest(name):
                    missing = [argument.name for argument in inspect.signature(value).parameters.values()
                               if argument.annotation is inspect.Parameter.empty]
                    self.assertEqual(missing, [])

    def test_of_names_are_the_names_in_cpp(self):
        def listed(kind):
            words = [sys.executable, "-m", "dmocbench", "list", "--names", kind]
            return subprocess.run(words, check=True, capture_output=True, text=True).stdout.split()

        literal_methods, _any_string = get_args(names.Method)
        for kind, there in ((names.Solver, listed("solver")), (names.Tableau, listed("tableau")), (literal_methods, db.methods())):
            self.assertEqual(sorted(get_args(kind)), sorted(there))
        programs = {name for name, _ in _core.programs()}
        without_extensions = {"low_thrust", "primitives", "read-sol", "step_control", "write-nl"}
        self.assertIn(set(get_args(names.Experiment)) - programs, (set(), without_extensions))
        self.assertLessEqual(programs, set(get_args(names.Experiment)))
        self.assertLessEqual(set(listed("derivatives")), set(get_args(names.Derivatives)))  # ADOL-C may be missing
        for keyword, kind in (("form", names.CostForm), ("refinement", names.Refinement)):
            for name in get_args(kind):
                db.solve(PendulumSwingUp(), intervals=8, **{keyword: name})

    def test_of_arguments_of_solve_are_explained_with_their_values(self):
        doc = inspect.getdoc(db.solve)
        hints = typing.get_type_hints(db.solve)
        for name in inspect.signature(db.solve).parameters:
            self.assertRegex(doc, rf"(?m)^{name}: ")
            explained = re.search(rf"(?ms)^{name}: .*?(?=^\w+: |\Z)", doc)[0]
            if typing.get_origin(hints[name]) is typing.Literal:
                for value in get_args(hints[name]):
                    self.assertIn(f'"{value}"', explained)

    def test_of_what_users_call_have_docstrings(self):
        for name in public(vars(db)):
            value = getattr(db, name)
            if not inspect.ismodule(value):
                self.assertTrue(inspect.getdoc(value), name)

    @unittest.skipIf(not os.path.exists("/usr/bin/mypy"), "mypy is not installed")
    def test_are_accepted_by_a_type_checker(self):
        with tempfile.TemporaryDirectory() as cache:
            files = [package, os.path.join(here, "pendulum.py"), os.path.join(here, "restated.py")]
            done = subprocess.run(["/usr/bin/mypy", "--ignore-missing-imports", "--cache-dir", cache, *files],
                                  capture_output=True, text=True, cwd=here, env={**os.environ, "MYPYPATH": os.path.dirname(package)})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
