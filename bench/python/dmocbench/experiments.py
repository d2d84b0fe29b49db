"""Runs experiments of the program dmocbench in this process, including on problems stated in Python."""

from __future__ import annotations

import csv
import html
import inspect
import json
import os
import sys
import warnings
from typing import Any, Iterator, Sequence

from . import _core
from ._core import Error
from .names import Experiment
from .problem import Problem
from .solving import AnyProblem, handle_of
from .words import in_words_of_python


class Table:
    """The rows of a table. Iteration yields a dict per row, with numbers as float or int, and None for empty entries."""

    def __init__(self, columns: list[str], rows: list[dict[str, Any]]):
        self.columns = columns
        self.rows = rows

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def __getitem__(self, key: int | str) -> Any:
        """Returns a row by its number, or a column by its name."""
        if isinstance(key, str):
            if key not in self.columns:
                raise Error(f"there is no column {key}; choose one of {', '.join(self.columns)}")
            return [row[key] for row in self.rows]
        return self.rows[key]

    def to_pandas(self) -> Any:
        """The table as a pandas DataFrame."""
        import pandas

        return pandas.DataFrame(self.rows, columns=self.columns)

    _most_shown = 10

    def _shown(self):
        """The columns that have an entry (first the columns that differ between rows), and the texts of the first rows."""
        columns = [name for name in self.columns if any(row[name] is not None for row in self.rows)]
        columns.sort(key=lambda name: len({str(row[name]) for row in self.rows}) == 1)
        return columns, [[_text(row[name]) for name in columns] for row in self.rows[:self._most_shown]]

    def __repr__(self):
        columns, rows = self._shown()
        most = 8  # columns that a line has room for
        lines = [columns[:most], *(row[:most] for row in rows)]
        widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
        text = [f"<a table of {len(self)} rows and {len(self.columns)} columns>"]
        text += ["  ".join(entry.ljust(width) for entry, width in zip(line, widths)).rstrip() for line in lines]
        if len(self) > len(rows):
            text.append(f"... {len(self) - len(rows)} more rows")
        if len(columns) > most:
            text.append(f"further columns: {', '.join(columns[most:])}")
        return "\n".join(text) if self.rows else f"<a table of 0 rows: {', '.join(self.columns)}>"

    def _repr_html_(self) -> str:
        columns, rows = self._shown()
        lines = [f"<tr>{''.join(f'<{kind}>{html.escape(entry)}</{kind}>' for entry in line)}</tr>"
                 for kind, line in [("th", columns), *(("td", row) for row in rows)]]
        more = f"<p>{len(self) - len(rows)} more rows</p>" if len(self) > len(rows) else ""
        return f"<table>{''.join(lines)}</table>{more}"


def _text(value):
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)[:60]


class Results(Table):
    """The rows of an experiment. further: its other tables, by the ends of their names ("slopes");
    orders: the fitted orders, if there are any; files: the common beginning of the names of all files; is_complete:
    whether all solves succeeded. Experiments with several tables, such as invariants, have only further tables."""

    further: dict[str, Table]
    orders: Table | None
    files: str
    is_complete: bool

    def __init__(self, table: Table, further: dict[str, Table], files: str, is_complete: bool):
        super().__init__(table.columns, table.rows)
        self.further = further
        self.orders = further.get("slopes")
        self.files = files
        self.is_complete = is_complete


def _value(text):
    if text == "":
        return None
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def read_table(file: str | os.PathLike[str], problems: Sequence[str] | None = None) -> Table:
    """Reads a table that dmocbench wrote; with `problems`, only the rows of these problems."""
    with open(file, newline="") as stream:
        reader = csv.DictReader(stream)
        rows = [{name: _value(text) for name, text in row.items()} for row in reader]
        columns = list(reader.fieldnames or [])
    if problems is not None and "problem" in columns:
        rows = [row for row in rows if row["problem"] in problems]
    return Table(columns, rows)


def load_library(*files: str | os.PathLike[str]) -> None:
    """Loads libraries of problems that dmocbench_add_problems built in CMake; their problems can then be used by name.
    Warns about problems that cannot be used and leaves them out."""
    with in_words_of_python():
        reasons = _core.load_problem_libraries([os.fspath(file) for file in files])
    for reason in reasons:
        warnings.warn(reason, stacklevel=2)


def register(problem: AnyProblem) -> _core.ProblemHandle:
    """Registers a problem under its name for all experiments of this process. Returns the C++ handle of the problem."""
    handle = handle_of(problem)
    if not isinstance(handle.original, Problem):
        return handle
    cls = type(handle.original)
    try:
        file, source = inspect.getsourcefile(cls) or "python", inspect.getsource(cls)
    except (OSError, TypeError):
        file, source = "python", repr(sorted(vars(cls)))
    _core.register_problem(handle, file, source)
    return handle


_repeated = {"over", "set", "option", "library", "join"}
"""Options that take one value each time. Other options take several values, separated by commas."""


_without_folder = {"list", "new"}
_folder_of = {"report": "--from"}
"""Options of programs that replace --out."""


def _word(value):
    return str(int(value)) if isinstance(value, float) and value.is_integer() and abs(value) < 2**53 else str(value)


def _arguments(options):
    arguments = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None:
            continue
        if isinstance(value, bool):
            arguments.append(option if value else "--no-" + option[2:])
        elif isinstance(value, (list, tuple, range)):
            words = [_word(entry) for entry in value]
            for word in words if name in _repeated else [",".join(words)]:
                arguments += [option, word]
        else:
            arguments += [option, _word(value)]
    return arguments


def run(experiment: Experiment, problem: AnyProblem | Sequence[AnyProblem] | None = None, *,
        out: str | os.PathLike[str] = "results", name: str | None = None, arguments: Sequence[Any] = (),
        **options: Any) -> Results | None:
    """Runs an experiment as the program does and returns its `Results`. problem: a problem, a name, or a list of these.

    experiment: a name; help(dmocbench.names.Experiment) and `python3 -m dmocbench --help` list the names. out: the folder
    of the written files; name: the beginning of their names.
    options: as on the command line, without dashes: intervals=[16, 32], method=["dmoc", "tangent"], stages=2, polish=False,
    over=["length=0.9:1.1:3", "mass=1:2:2"]; run("solve", arguments=["--help"]) prints all options of solve. arguments:
    further arguments of the command line. Raises Error where the program would print an error, and KeyboardInterrupt
    on Ctrl-C.
    """
    known = [program for program, _ in _core.programs()]
    if experiment not in known:
        raise Error(f"there is no experiment {experiment}; choose one of {', '.join(known)}")
    words = [] if experiment in _without_folder else [_folder_of.get(experiment, "--out"), os.fspath(out)]
    words += [] if name is None else ["--name", name]
    problems = None
    if problem is not None:
        handles = [register(one) for one in (problem if isinstance(problem, (list, tuple)) else [problem])]
        problems = [handle.name for handle in handles]
        words += ["--problem", ",".join(problems)]
        settings = {setting for handle in handles if not isinstance(handle.original, Problem)
                    for setting in handle.settings.split()}
        for setting in sorted(settings):
            words += ["--set", setting]
    sys.stdout.flush()
    with in_words_of_python():
        code = _core.run(experiment, words + _arguments(options) + [str(word) for word in arguments], True)
    return _results(os.fspath(out), name or experiment, problems, code == 0)


def _results(out, name, problems, is_complete):
    """The files of a run, as listed in its metadata; None if the run writes no tables."""
    metadata = os.path.join(out, name + ".json")
    if not os.path.exists(metadata):
        return None
    with open(metadata) as file:
        files = list(json.load(file).get("tables", {}))
    tables = {file: read_table(os.path.join(out, file), problems) for file in files}
    main = tables.pop(name + ".csv", Table([], []))
    further = {file.removeprefix(name + "_").removesuffix(".csv"): table for file, table in tables.items()}
    return Results(main, further, os.path.join(out, name), is_complete)


def convergence(problem: AnyProblem | Sequence[AnyProblem], **options: Any) -> Results | None:
    """Computes errors over the step size and fits orders: run("convergence", problem, ...)."""
    return run("convergence", problem, **options)
