"""The tables that bench/speed/page --csv writes. A row is a dictionary by column names."""
import contextlib
import csv
import datetime
import io
import json
import math
import operator
import os
import statistics
import zlib

from benchmark_run import Misuse

PHASES = ("tapes", "linear_systems", "line_search", "one_by_one", "exchange", "rest")  # of a batch
# Of each program, by the ending of the file: NAME TYPE [UNIT] MEANING. Rows may have further entries.
COLUMNS = {
    "speed": {"": """
way string way of evaluation
quantity string evaluated quantity
problem string name of the problem
links integer number of links of a chain
method string family of elements
tableau string family of Butcher tableaus
stages integer number of stages s
instruction_set string instruction set of the processor
intervals integer number of intervals N
repetitions integer number of repetitions
nanoseconds number [ns] median time per interval
smallest_nanoseconds number [ns] shortest time per interval
operations number operations per interval
bytes number bytes per interval, read and written
operations_per_byte number operations divided by bytes
operations_per_second number [1/s] operations divided by the median time
roof_nanoseconds number [ns] lower bound of the time on this machine
roof_limit string limit that sets this bound: arithmetic, or a level of memory
roof_share number roof_nanoseconds divided by nanoseconds""", "_machine": """
instruction_set string instruction set of the processor
limit string kind of limit: arithmetic, or a level of memory
rate number [1/s] operations or bytes per second
array_bytes integer size of the arrays, in bytes"""},
    "solves": {"": """
problem string name of the problem
method string family of elements
intervals integer number of intervals N
solver string name of the solver
threads integer number of threads of a solve
repetitions integer number of repetitions
seconds number [s] median time of a solve
smallest_seconds number [s] shortest time of a solve
iterations number major iterations
linear_systems number number of linear systems solved
solved integer 1 if every repetition is solved
objective number [cost] objective of the solution
ns_per_interval_iteration number [ns] time of a solve per interval and iteration
evaluation_share number share of the time spent on derivatives
bytes_per_interval number peak memory of a solve per interval
setup_seconds number [s] time to build the program""", "_ratios": """
problem string name of the problem
method string family of elements
intervals integer number of intervals N
quantity string difference between the two solves: solver or threads
ratio number ratio of the median times, with Ipopt or one thread in the numerator
ratio_of_smallest number ratio of the shortest times
verdict string same, other branch (the costs differ), or not both solved""", "_exponents": """
problem string name of the problem
method string family of elements
solver string name of the solver
threads integer number of threads of a solve
exponent number exponent of N in the time per iteration
standard_error number standard error of the exponent
grids integer number of grids used
coarsest integer smallest number of intervals used
finest integer largest number of intervals used"""},
    "batch": {"": """
problem string name of the problem
start string cold, warm or nearest
way string batch, fill (lanes are filled, not solved), or the solver of a loop
threads integer number of threads
instances integer number of instances
repetitions integer number of repetitions
seconds number [s] median time per instance
seconds_lower number [s] lower 99 % confidence limit of the median time
seconds_upper number [s] upper 99 % confidence limit of the median time
solves_per_second number [1/s] solves per second, computed from the median time
rate_lower number [1/s] lower 99 % confidence limit of solves_per_second
rate_upper number [1/s] upper 99 % confidence limit of solves_per_second
ratio number seconds divided by the seconds of the batch on all threads, from the same start
processor_seconds number [s] total time of all processors per instance
median_iterations number median number of iterations of a solve
solved number share of the instances that are solved
one_by_one number share of the instances that leave their lanes and are solved one by one
lanes_in_use number share of the lanes that hold an instance, over all rounds
""" + "\n".join(f"share_{phase} number share of this phase in the time of all threads" for phase in PHASES)},
}


def row_of(run):
    """The medians of the times and counters, and the words of the label."""
    numbers = {key for one in run.repetitions for key, value in one.items() if isinstance(value, (int, float))}
    return {**{key: run.number(key) for key in numbers}, **run.label, "repetitions": len(run.repetitions)}


def machine(runs):
    """Rows for the limits of the machine, in operations or bytes per second."""
    rows = [row_of(run) for run in runs]
    rows = [{**row, "rate": row.get("operations_per_second", row.get("bytes_per_second"))} for row in rows]
    return [row for row in rows if row["rate"]]


def roof_of(row, limits):
    """The lower bound of the time on this machine in nanoseconds, and the limit that sets it: arithmetic, or the level of
    memory that holds the arrays of all intervals. None if bytes are not counted, or if a limit was not measured with this
    instruction set."""
    if not row.get("bytes"):
        return None
    size = row["bytes"] * row["intervals"]
    limits = [limit for limit in limits if limit["instruction_set"] == row.get("instruction_set")]
    computing = [(1e9 * row["operations"] / of["rate"], of["limit"]) for of in limits if of["limit"] == "arithmetic"]
    moving = [(1e9 * row["bytes"] / of["rate"], of["limit"]) for of in limits
              if of.get("more_than_bytes", size) < size <= of.get("up_to_bytes", 0)]
    return max(computing[0], moving[0], key=operator.itemgetter(0)) if computing and moving else None


def evaluations(runs):
    limits, rows = machine(runs), []
    for run in runs:
        if not run.values("ns_per_interval"):
            continue
        row = row_of(run)
        time, operations = row["ns_per_interval"], row["operations"]
        row |= {"nanoseconds": time, "smallest_nanoseconds": min(run.values("ns_per_interval")),
                "operations_per_second": 1e9 * operations / time}
        if row.get("bytes"):
            row["operations_per_byte"] = operations / row["bytes"]
        if roof := roof_of(row, limits):
            row |= {"roof_nanoseconds": roof[0], "roof_limit": roof[1], "roof_share": roof[0] / time}
        rows.append(row)
    return rows


def solves(runs):
    rows = [{**row_of(run), "seconds": run.seconds().middle, "smallest_seconds": 1e-9 * min(run.values("real_time")),
             "iterations": run.number("major_iterations"), "solved": int(run.is_solved())} for run in runs]
    return sorted(rows, key=operator.itemgetter("problem", "method", "intervals", "solver", "threads"))


# The slower solve of a pair in front.
PAIRS = {"solver": (("ipopt", 1), ("interior_point", 1)), "threads": (("interior_point", 1), ("interior_point", 2))}


def ratio_row(quantity, slower, faster):
    """Solves that failed or ended on different branches are not compared."""
    row = {key: faster[key] for key in ("problem", "method", "intervals")} | {"quantity": quantity}
    if not (slower["solved"] and faster["solved"]):
        return {**row, "verdict": "not both solved"}
    if abs(slower["objective"] - faster["objective"]) > 1e-9 * abs(faster["objective"]):
        return {**row, "verdict": "other branch"}
    return {**row, "verdict": "same", "ratio": slower["seconds"] / faster["seconds"],
            "ratio_of_smallest": slower["smallest_seconds"] / faster["smallest_seconds"]}


def ratios(runs):
    known = {(row["problem"], row["method"], row["intervals"], row["solver"], row["threads"]): row for row in solves(runs)}
    return [ratio_row(quantity, known[*program, *slower], known[*program, *faster])
            for program in dict.fromkeys(key[:3] for key in known) for quantity, (slower, faster) in PAIRS.items()
            if (*program, *slower) in known and (*program, *faster) in known]


def slope_of(points):
    """The least-squares slope of log y over log x, and its standard error. Needs at least three points."""
    points = [(math.log(x), math.log(y)) for x, y in points]
    slope, intercept = statistics.linear_regression(*zip(*points))
    mean = statistics.mean(x for x, _ in points)
    residuals = sum((y - intercept - slope * x) ** 2 for x, y in points)
    return slope, math.sqrt(residuals / (len(points) - 2) / sum((x - mean) ** 2 for x, _ in points))


def exponents(runs):
    """Fits time per iteration ~ N^exponent to three or more solved grids from N = 1024 on; below, fixed costs dominate."""
    curves, rows = {}, []
    for row in solves(runs):
        if row["solved"] and row["intervals"] >= 1024:
            curve = curves.setdefault((row["problem"], row["method"], row["solver"], row["threads"]), {})
            curve[row["intervals"]] = row["seconds"] / max(1, row["iterations"])
    for key, curve in sorted(curves.items()):
        if len(curve) >= 3:
            slope, error = slope_of(curve.items())
            rows.append({**dict(zip(("problem", "method", "solver", "threads"), key)), "exponent": slope, "standard_error": error,
                         "grids": len(curve), "coarsest": min(curve), "finest": max(curve)})
    return rows


def batch(runs):
    rows = []
    for run in runs:
        row, seconds = row_of(run), run.seconds()
        row |= zip(("seconds", "seconds_lower", "seconds_upper"), seconds.cells())
        if row["way"] != "fill":  # which solves nothing
            row |= zip(("solves_per_second", "rate_upper", "rate_lower"), (time and 1 / time for time in seconds.cells()))
        rows.append(row)
    for row in rows:
        own = [of["seconds"] for of in rows if (of["way"], of["problem"], of["start"]) == ("batch", row["problem"], row["start"])]
        row["ratio"] = row["seconds"] / min(own) if own else None
    return rows


ROWS = {"speed": {"": evaluations, "_machine": machine}, "solves": {"": solves, "_ratios": ratios, "_exponents": exponents},
        "batch": {"": batch}}


def declared(text):
    """Returns {column: (type, meaning)}."""
    return {name: (of, meaning) for name, of, meaning in (line.split(maxsplit=2) for line in text.strip().split("\n"))}


def csv_of(columns, rows):
    def field(value):
        return "" if value is None else f"{value:.17g}" if isinstance(value, float) else value

    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([columns, *([field(row.get(column)) for column in columns] for row in rows)])
    return text.getvalue()


def description(columns, rows, text):
    """Returns the entry of a table in the metadata."""
    properties = {name: {"description": meaning, "type": [of, "null"]} for name, (of, meaning) in columns.items()}
    return {"columns": list(columns), "rows": len(rows), "crc32": f"{zlib.crc32(text.encode()):08x}",
            "schema": {"$schema": "https://json-schema.org/draft/2020-12/schema", "type": "object", "properties": properties,
                       "required": list(columns), "additionalProperties": False}}


def write_whole(path, text):
    """Writes the whole file, or no file if writing fails."""
    part = f"{path}.{os.getpid()}"
    try:
        with open(part, "w", encoding="utf-8", newline="") as file:
            file.write(text)
        os.replace(part, path)
    except OSError as error:
        raise Misuse(f"cannot write {path}: {error.strerror}") from error
    finally:
        with contextlib.suppress(OSError):
            os.remove(part)


def write_tables(program, context, runs, path):
    """Writes FILE.csv, further tables FILE_*.csv, and their metadata as FILE_tables.json."""
    stem, ending = os.path.splitext(path)
    tables = {}
    for suffix, rows_of in ROWS[program].items():
        columns, rows = declared(COLUMNS[program][suffix]), rows_of(runs)
        text = csv_of(columns, rows)
        write_whole(stem + suffix + ending, text)
        tables[os.path.basename(stem) + suffix + ending] = description(columns, rows, text)
    begin = datetime.datetime.fromisoformat(context["date"]).astimezone(datetime.timezone.utc)
    keys = ("dmocbench", "commit", "compiler", "flags", "instruction_set", "processor")
    metadata = {"command_line": json.loads(context["command_line"]), "utc_time": f"{begin:%Y-%m-%dT%H:%M:%SZ}",
                **{key: context[key] for key in keys}, "cores": context["num_cpus"], "complete": True, "tables": tables}
    write_whole(f"{stem}_tables.json", json.dumps(metadata, indent=2) + "\n")
