"""Restates messages from C++ in the words of Python: name= instead of --name."""

from __future__ import annotations

import contextlib
import re
from typing import Iterator, Mapping, get_args

from . import names
from ._core import Error

_values = {value for kind in (names.Tableau, names.Solver, names.Derivatives, names.CostForm, names.Refinement)
           for value in get_args(kind)} | {"dmoc", "hamiltonian", "tangent", "galerkin", "common", "guess"}

arguments_of_solve = {"seconds": "most_seconds", "iterations": "most_iterations", "refine": "refinement", "option": "options",
             "problem": "problem"}
"""Arguments of `solve` whose names differ from the options of programs."""


def spelt(sentence: str, renamed: Mapping[str, str] = {}) -> str:
    """Restates a sentence about options of a program with arguments. renamed: the options with different names."""

    def argument(match: re.Match[str]) -> str:
        name, value = match["name"].replace("-", "_"), match["value"]
        if name == "library":
            return "load_library(FILE)" if value in (None, "FILE") else f"load_library({value})"
        if name.startswith("no_") and value is None:
            return name[3:] + "=False"
        name = renamed.get(name, name)
        if value is None:
            return name + "="
        if re.fullmatch(r"[0-9.e-]+", value):
            return f"{name}={value}"
        return f'{name}="{value}"' if value in _values else f"{name}= {value}"

    text = re.sub(r"; --help lists the options", "", sentence)
    text = re.sub(r"(?<![\w-])--(?P<name>[a-z][a-z-]*)(?:[ =](?P<value>[A-Za-z_]+|\d[0-9.e-]*\b))?", argument, text)
    text = re.sub(r'(=(?:"\w+"|[\d.e-]*\d)) (?=[a-z_]+=)', r"\1, ", text)
    text = re.sub(r"=(?=: )", "", text)
    if "not expected" in text:
        text = f"there is no option {', '.join(re.findall(r'[a-z_]+=', text))}"
    if text.startswith("there is no problem") and "load_library" not in text:
        text += "; problems of a library need load_library(FILE) first"
    return text


@contextlib.contextmanager
def in_words_of_python(renamed: Mapping[str, str] = {}) -> Iterator[None]:
    """Errors within are raised with their sentences `spelt`."""
    try:
        yield
    except Error as error:
        sentence = spelt(str(error), renamed)
        if sentence == str(error):
            raise
        raise Error(sentence) from None
