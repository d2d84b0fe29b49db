"""python3 -m dmocbench EXPERIMENT [FILE.py ...] OPTIONS: runs an experiment. The files may state further problems.
python3 -m dmocbench figures RESULTS: draws the tables in a results folder."""

import importlib.util
import inspect
import os
import sys
import traceback
from pathlib import Path

from . import _core
from .experiments import register
from .phases import Phases
from .problem import Problem


def problems_of(file):
    """The problems that a file states, in file order, except phases of another problem and classes that need arguments."""
    name = os.path.splitext(os.path.basename(file))[0]
    spec = importlib.util.spec_from_file_location(name, file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    sys.path.insert(0, os.path.dirname(os.path.abspath(file)))
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        at = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == spec.origin]
        line = at[-1] if at else getattr(error, "lineno", None)
        place = f"{file}, line {line}" if line else file
        raise _core.Error(f"{place}: {type(error).__name__}: {' '.join(str(error).split())}") from None
    found = [value for value in vars(module).values()
             if inspect.isclass(value) and issubclass(value, Problem) and value.__module__ == name
             and not any(argument.default is argument.empty and argument.kind is argument.POSITIONAL_OR_KEYWORD
                         for argument in inspect.signature(value).parameters.values())]
    parts = {type(phase) for cls in found if issubclass(cls, Phases) for phase in cls()._stated_phases().values()}
    found = [cls for cls in found if cls not in parts]
    if not found:
        raise _core.Error(f"{file} states no problem; derive a class from dmocbench.Problem")
    return found


_without_problems = {"claims", "misprints", "new", "report", "step_control"}
"""Experiments without an option --problem; problems of files are also registered for these experiments."""


def draw(words):
    """Replaces this process with dmocbench-figures from the wheel, the build folder, or an installation."""
    for place in ("plots/figures", "../../dmocbench-figures", "../../../../bin/dmocbench-figures"):
        script = Path(__file__).parent / place
        if script.exists():
            os.execv(script, [str(script), *words])
    raise _core.Error("dmocbench-figures is missing; install the program dmocbench, which includes it")


def main(words):
    if not words or words[0] in ("-h", "--help"):
        print(__doc__.strip() + "\n")
        for name, description in _core.programs():
            print(f"  {name:<20} {description}")
        return 0
    experiment, rest = words[0], words[1:]
    if experiment == "figures":
        draw(rest)
    if experiment not in [name for name, _ in _core.programs()]:
        raise _core.Error(f"there is no experiment \"{experiment}\"; python3 -m dmocbench --help lists the experiments")
    files = [word for word in rest if word.endswith(".py")]
    for file in files:
        if not os.path.isfile(file):
            raise _core.Error(f"there is no file {file}")
    names = [register(problem).name for file in files for problem in problems_of(file)]
    rest = [word for word in rest if word not in files]
    is_named = any(word == "--problem" or word.startswith("--problem=") for word in rest)
    if names and not is_named and experiment not in _without_problems:
        if experiment == "study" and len(names) > 1:
            raise _core.Error(f"study takes one problem; add --problem NAME, one of {', '.join(names)}")
        rest += ["--problem", ",".join(names)]
    return _core.run(experiment, rest, False)


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except _core.Error as error:
        print(f"dmocbench: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
