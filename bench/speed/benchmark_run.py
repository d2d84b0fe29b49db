"""Runs of Google Benchmark, read from files of --benchmark_out."""
import json
import math
import re
import statistics

NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}


class Misuse(Exception):
    """A sentence for the user of a script."""


class Median:
    """The median of a sample and its 99 % interval: the two values between which the median of any distribution lies with this
    probability. The interval is None for fewer than 8 values."""

    def __init__(self, middle, lower=None, upper=None):
        self.middle, self.lower, self.upper = middle, lower, upper

    @staticmethod
    def of(values):
        values, n = sorted(values), len(values)
        outside, k = 0.0, 0  # the median lies below values[k - 1] with the probability `outside`
        while (more := outside + math.comb(n, k) / 2**n) <= 0.005:
            outside, k = more, k + 1
        bounds = (values[k - 1], values[n - k]) if k else (None, None)
        return Median(statistics.median(values), *bounds)

    def __truediv__(self, other):
        bounds = (self.lower / other.upper, self.upper / other.lower) if self.lower and other.lower else (None, None)
        return Median(self.middle / other.middle, *bounds)

    def __add__(self, other):
        bounds = (self.lower + other.lower, self.upper + other.upper) if self.lower and other.lower else (None, None)
        return Median(self.middle + other.middle, *bounds)

    def __mul__(self, factor):
        return Median(self.middle * factor, *(bound and bound * factor for bound in (self.lower, self.upper)))

    def cells(self):
        return self.middle, self.lower, self.upper


class Run:
    """All repetitions of a benchmark, with the KEY=VALUE words of its label, times in nanoseconds and counters."""

    def __init__(self, name, label):
        self.name = name
        words = (word.split("=", 1) for word in label.split() if "=" in word)
        self.label = {key: int(text) if text.isdigit() else text for key, text in words}
        self.repetitions = []

    def values(self, key):
        """The finite values of all repetitions."""
        return [one[key] for one in self.repetitions if isinstance(one.get(key), (int, float))]

    def median(self, key):
        return Median.of(self.values(key))

    def number(self, key):
        return statistics.median(self.values(key)) if self.values(key) else None

    def seconds(self):
        return self.median("real_time") * 1e-9

    def is_solved(self):
        return all(one["solved"] == 1 for one in self.repetitions)


def read(path):
    """The context, and the benchmarks in alphabetical order, without aggregates and failed benchmarks."""
    try:
        with open(path, encoding="utf-8") as file:  # JSON has no NaN and no Infinity
            content = json.loads(re.sub(r'": -?(NaN|Infinity)', '": null', file.read()))
    except OSError as error:
        raise Misuse(f"cannot read {path}: {error.strerror}") from error
    except ValueError as error:
        raise Misuse(f"{path} is not JSON; write it with --benchmark_out=FILE") from error
    runs = {}
    try:
        for one in content["benchmarks"]:
            if one["run_type"] == "iteration" and not one.get("error_occurred"):
                for time in ("real_time", "cpu_time"):
                    one[time] *= NANOSECONDS[one["time_unit"]]
                runs.setdefault(one["run_name"], Run(one["run_name"], one.get("label", ""))).repetitions.append(one)
        return content.get("context", {}), [runs[name] for name in sorted(runs)]
    except (AttributeError, KeyError, TypeError) as error:
        raise Misuse(f"{path} is JSON, but not a report of Google Benchmark; write it with --benchmark_out=FILE") from error
