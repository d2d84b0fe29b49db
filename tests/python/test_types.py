"""Type hints name what the package has, no more and no less, and type checkers accept them."""

import ast
import inspect
import os
import subprocess
import tempfile
import unittest

import dmocbench as db
from dmocbench import _core

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
