"""Experiments in process write what the program writes, on problems of Python, of libraries and built-in ones."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import zlib

import dmocbench as db
import restated
from dmocbench import __main__, _core
from pendulum import PendulumSwingUp

program = os.environ.get("DMOCBENCH_TEST_PROGRAM")
library = os.environ.get("DMOCBENCH_TEST_LIBRARY")
here = os.path.dirname(os.path.abspath(__file__))


def without_times(table):
    return [{name: value for name, value in row.items() if "second" not in name and name not in ("library",)}
            for row in table]


def renamed(cls):
    """A problem by another name than the one in C++, which experiments have already."""
    return type(cls.__name__, (cls,), {"name": "my_" + cls()._problem_name()})()


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = folder.name

    def test_of_convergence_return_rows_and_orders(self):
        table = db.convergence(PendulumSwingUp(), out=self.out, intervals=[16, 32, 64, 128, 256, 512],
                               solver="interior_point")
        self.assertEqual(len(table), 18)
        self.assertTrue(table.is_complete)
        orders = [row["slope"] for row in table.orders if row["quantity"] == "state" and row["slope"] is not None]
        self.assertEqual(len(orders), 3)
        for order in orders:
            self.assertAlmostEqual(order, 2.0, delta=0.2)
        with open(os.path.join(self.out, "convergence.json")) as file:
            metadata = json.load(file)
        self.assertTrue(metadata["complete"])
        self.assertIn("pendulum.py", json.dumps(metadata))

    @unittest.skipIf(program is None or library is None, "no program is given")
    def test_write_the_rows_of_the_program(self):
        other = os.path.join(self.out, "program")
        words = ["--problem", "pendulum_swing_up", "--intervals", "16,32", "--solver", "interior_point"]
        subprocess.run([program, "objective", "--library", library, "--out", other, *words], check=False, capture_output=True)
        ours = db.run("objective", PendulumSwingUp(), out=self.out, intervals=[16, 32], solver="interior_point")
        theirs = db.read_table(os.path.join(other, "objective.csv"))
        self.assertEqual(without_times(ours), without_times(theirs))

    def test_run_every_kind_of_experiment(self):
        class WithSymmetry(PendulumSwingUp):
            def symmetry(self, q):
                return [1.0]

        grid = {"intervals": [16, 32], "solver": "interior_point"}
        for experiment, options in (("solve", grid), ("invariants", {}), ("objective", grid), ("iterations", grid),
                                    ("consistency", grid), ("equivalence", grid), ("local_minima", {**grid, "starts": 3}),
                                    ("derivatives", {}), ("adaptive", {}), ("coercivity", {}), ("certify", {}),
                                    ("consistency_order", {})):
            with self.subTest(experiment):
                table = db.run(experiment, WithSymmetry(), out=self.out, **options)
                self.assertGreater(len(table) + sum(map(len, table.further.values())), 0)

    def test_vary_parameters_in_a_sweep(self):
        table = db.run("sweep", PendulumSwingUp(), out=self.out, method="dmoc", intervals=16.0, over="length=0.9:1.1:3")
        self.assertEqual(len(table), 3)
        of_two = db.run("sweep", "cart_pole", out=self.out, name="two", method="dmoc", intervals=16,
                        over=["length=0.5:0.6:2", "bob_mass=0.3:0.4:2"])
        self.assertEqual(len(of_two), 4)
        self.assertEqual(len({row["objective"] for row in table}), 3)

    def test_take_problems_with_every_kind_of_statement(self):
        problems = [renamed(cls) for cls in (restated.TwoLinkWithMotors, restated.CannonballOfUnknownRadius,
                                             restated.ChainOfGivenLength, restated.PushedInABand)]
        table = db.run("solve", problems, out=self.out, method="dmoc", intervals=64, stages=2)
        self.assertEqual(set(table["status"]), {"solved"})
        for row in table:
            motion = db.read_table(os.path.join(self.out, f"solve_{row['problem']}_dmoc_gauss2_64_nodes.csv"))
            for column in {"my_two_link_with_motors": ["current_1"], "my_cannonball": ["radius"]}.get(row["problem"], []):
                self.assertEqual(len(motion[column]), 65)

    def test_are_equal_by_dmoc_and_hamiltonian_collocation_with_first_order_states(self):
        table = db.run("equivalence", renamed(restated.OrbitalTransferWithMass), out=self.out, method="dmoc,hamiltonian",
                       intervals=32)
        self.assertEqual(len(table), 2)
        self.assertLess(table["configuration_difference"][1], 1e-11)

    def test_vary_parameters_of_problems_with_first_order_states(self):
        table = db.run("sweep", renamed(restated.OrbitalTransferWithMass), out=self.out, method="dmoc", intervals=64, stages=2,
                       over="inverse_power=0:5000:3")
        self.assertEqual(len(table), 3)
        single = db.solve(restated.OrbitalTransferWithMass(inverse_power=2500.0), intervals=64, stages=2)
        self.assertAlmostEqual(table["objective"][1] / single.cost, 1.0, places=8)

    def test_use_several_processes(self):
        class Second(PendulumSwingUp):
            """the same by another name"""

        table = db.run("profile", [PendulumSwingUp(), Second()], out=self.out, intervals=[16], jobs=2)
        self.assertEqual({row["problem"] for row in table}, {"pendulum_swing_up", "second"})

    def test_take_the_newest_class_of_a_name(self):
        def cost(factor):
            class Changed(PendulumSwingUp):
                def running_cost(self, x):
                    return factor * x.u[0] ** 2

            return db.run("solve", Changed(), out=self.out, method="dmoc", intervals=16)["objective"][0]

        self.assertAlmostEqual(cost(1.0), 2.0 * cost(0.5), places=8)

    def test_keep_values_of_parameters(self):
        a = db.run("solve", PendulumSwingUp(length=1.2), out=self.out, method="dmoc", intervals=16)
        self.assertAlmostEqual(a["objective"][0], db.solve(PendulumSwingUp(length=1.2), intervals=16).cost, places=8)
        b = db.run("solve", db.problem("cart_pole", length=0.6), out=self.out, method="dmoc", intervals=32)
        self.assertAlmostEqual(b["objective"][0], db.solve(db.problem("cart_pole", length=0.6), intervals=32).cost, places=7)

    def test_raise_what_the_program_would_print(self):
        with self.assertRaisesRegex(db.Error, "^intervals: "):
            db.run("solve", PendulumSwingUp(), out=self.out, intervals="x")
        with self.assertRaisesRegex(db.Error, "there is no option colour="):
            db.run("solve", PendulumSwingUp(), out=self.out, colour="red")

    def test_raise_no_error_without_words_nor_with_words_of_a_command_line(self):
        for experiment in [name for name, _ in _core.programs() if name not in ("new", "write-nl", "read-sol")]:
            for options in ({"colour": "red"}, {"intervals": "x"}, {"problem": "no_such_problem"}):
                with self.subTest(experiment, options=options):
                    try:
                        db.run(experiment, out=self.out, **options)
                    except db.Error as error:
                        self.assertRegex(str(error), r"\w+ \w+")
                        self.assertNotRegex(str(error), r"(?<![\w-])--[a-z]")
                    else:
                        self.fail("nothing was raised")
        with self.assertRaisesRegex(db.Error, r"load_library\(FILE\)"):
            db.run("solve", "no_such_problem", out=self.out)

    def test_of_every_program_take_the_problems_of_a_file(self):
        file = os.path.join(here, "pendulum.py")
        for experiment in [name for name, _ in _core.programs()]:
            with self.subTest(experiment):
                done = self.command(experiment, file, "--help")
                self.assertEqual(done.returncode, 0, done.stderr)
                has_problem = "  --problem " in done.stdout
                self.assertEqual(has_problem, experiment not in __main__._without_problems)

    @unittest.skipIf(program is None, "no program is given")
    def test_of_a_study_write_the_files_of_the_program(self):
        short = {"intervals": "16:64", "starts": 2}
        db.run("study", "double_integrator", out=os.path.join(self.out, "in_python"), **short)
        subprocess.run([program, "study", "--problem", "double_integrator", "--intervals", "16:64", "--starts", "2", "--out",
                        os.path.join(self.out, "program")], check=True, capture_output=True)
        ours, theirs = (db.read_table(os.path.join(self.out, way, "local_minima.csv")) for way in ("in_python", "program"))
        self.assertEqual(without_times(ours), without_times(theirs))
        listings = [sorted(os.listdir(os.path.join(self.out, way))) for way in ("in_python", "program")]
        self.assertEqual(*listings)
        self.assertIn("report.html", listings[0])

    def test_of_a_study_are_about_a_problem_in_python(self):
        done = self.command("study", os.path.join(here, "pendulum.py"), "--intervals", "16:32", "--starts", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.out, "study_pendulum_swing_up", "report.html")) as page:
            self.assertIn("swing-up of a pendulum, least torque", page.read())
        db.run("study", PendulumSwingUp(), out=self.out, intervals="16:32", starts=2)
        self.assertTrue(os.path.exists(os.path.join(self.out, "report.html")))
        with self.assertRaisesRegex(db.Error, "^intervals: "):
            db.run("study", PendulumSwingUp(), out=self.out, intervals="x")

    def test_of_a_file_that_raises_are_refused_in_one_line(self):
        with open(os.path.join(self.out, "wrong.py"), "w") as file:
            file.write("import dmocbench as db\nx = 1\nraise ValueError('no\\nnumber')\n")
        done = self.command("equivalence", "wrong.py")
        self.assertEqual((done.returncode, done.stderr), (2, "dmocbench: wrong.py, line 3: ValueError: no number\n"))

    def test_of_another_build_are_not_resumed(self):
        db.convergence(PendulumSwingUp(), out=self.out, method="dmoc", intervals=[16, 32], part="1/2")
        with open(os.path.join(self.out, "convergence.parts", "1-of-2.rows")) as rows, open(_core.__file__, "rb") as module:
            self.assertIn(f"{zlib.crc32(module.read()):08x}", rows.readline())  # of the module, not of the interpreter

    def test_in_parts_are_joined(self):
        grid = {"method": ["dmoc", "tangent"], "intervals": [16, 32, 64], "solver": "interior_point"}
        for part in ("1/2", "2/2"):
            db.run("objective", PendulumSwingUp(), out=self.out, part=part, **grid)
        joined = db.run("objective", PendulumSwingUp(), out=self.out, join=[self.out], **grid)
        whole = db.run("objective", PendulumSwingUp(), out=self.out, name="whole", **grid)
        self.assertEqual(without_times(joined), without_times(whole))

    def test_give_data_frames(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = db.run("solve", PendulumSwingUp(), out=self.out, method="dmoc", intervals=16).to_pandas()
        self.assertEqual(list(frame["problem"]), ["pendulum_swing_up"])
        self.assertEqual(len(db.solve(PendulumSwingUp(), intervals=16).to_pandas()), 17)

    def test_end_by_an_interrupt_and_leave_nothing_behind(self):
        timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            db.convergence(PendulumSwingUp(), out=self.out, intervals="16:32768", solver="ipopt")
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        self.assertEqual(len(db.run("solve", PendulumSwingUp(), out=self.out, method="dmoc", intervals=16)), 1)

    def command(self, *words, **variables):
        return self.python("-m", "dmocbench", *words, **variables)

    def python(self, *words, **variables):
        path = os.pathsep.join(filter(None, [os.environ.get("PYTHONPATH"), here]))
        return subprocess.run([sys.executable, *words], cwd=self.out, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": path, **variables})

    @unittest.skipIf(library is None, "no library is given")
    def test_take_libraries_however_they_are_named(self):
        grid = ["solve", "--problem", "pushed_in_a_band", "--method", "dmoc", "--intervals", "128"]
        of_class = ("import dmocbench as db; from pendulum import PendulumSwingUp\n"
                    "class Mine(PendulumSwingUp): 'by another name than in the library'\n"
                    "db.convergence(Mine(), intervals=[16, 32])")
        for way, done in {"an option of a command": self.command(*grid, "--library", library),
                          "the environment of a command": self.command(*grid, DMOCBENCH_LIBRARIES=library),
                          "the environment of a process": self.python("-c", of_class, DMOCBENCH_LIBRARIES=library)}.items():
            with self.subTest(way):
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_are_commands_too(self):
        done = self.command("convergence", os.path.join(here, "pendulum.py"), "--intervals", "16:64", "--method", "dmoc")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.exists(os.path.join(self.out, "results", "convergence_slopes.csv")))
        drawn = self.command("figures", "results", "convergence")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertTrue(os.path.exists(os.path.join(self.out, "results", "figures", "pendulum_swing_up_state_error.svg")))
        wrong = self.command("convergence", "missing.py")
        self.assertEqual((wrong.returncode, wrong.stderr), (2, "dmocbench: there is no file missing.py\n"))
        wrong = self.command("convergenze")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("there is no experiment", wrong.stderr)
        self.assertEqual(self.command("--help").returncode, 0)

    def test_of_commands_show_the_traceback_of_the_user(self):
        with open(os.path.join(self.out, "broken.py"), "w") as file:
            file.write("from pendulum import PendulumSwingUp\n\n\nclass Broken(PendulumSwingUp):\n"
                       "    def force(self, x):\n        return [1 / 0]\n")
        done = self.command("solve", "broken.py")
        self.assertIn("ZeroDivisionError", done.stderr)
        self.assertIn("in force", done.stderr)


if __name__ == "__main__":
    unittest.main()
