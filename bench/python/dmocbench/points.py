"""Points at which formulas are stated or solutions are evaluated: x.q.theta, x.q[0], x.v, x.u, x.t."""

from __future__ import annotations

import numpy as np


class Named(np.ndarray):
    """A vector whose entries have names: q.theta is q[0], or the column if q is a table with a row per time. Entries are
    traced numbers in formulas and floats in a solution. Results of computations have no names."""

    def __array_finalize__(self, _source):
        self._names = ()
        self._kind = "this vector"

    def __array_wrap__(self, array, context=None):
        return array[()] if array.ndim == 0 else super().__array_wrap__(array, context)  # x.v @ x.v is one number

    def __getitem__(self, key):
        return getattr(self, key) if isinstance(key, str) else super().__getitem__(key)

    def __getattr__(self, name):
        names = self.__dict__.get("_names", ())
        if name in names:
            return self[names.index(name)] if self.ndim == 1 else np.asarray(self)[..., names.index(name)]
        if name.startswith("_") or not names:
            raise AttributeError(f"{self.__dict__.get('_kind', 'this vector')} has no attribute {name}")
        raise AttributeError(f"{self._kind} has no entry {name}; it has {', '.join(names)}")


def named(entries, names, kind):
    """The entries as a vector with these names."""
    vector = np.empty(len(entries), dtype=object)
    for i, entry in enumerate(entries):
        vector[i] = entry
    return with_names(vector, names, kind)


def with_names(array, names, kind):
    """The array with these names for the entries of its last axis."""
    view = array.view(Named)
    view._names = tuple(names)
    view._kind = kind
    return view


class Point:
    """A state at which a formula is stated, and the control that acts there.

    q: coordinates; v: their rates, with the same names; u: controls (not at the ends and not in a Lagrangian); y:
    first-order states; t: time.
    """

    __slots__ = ("q", "v", "u", "t", "y")

    def __init__(self, q, v, u, t, y):
        self.q = q
        self.v = v
        if u is not None:
            self.u = u
        self.t = t
        self.y = y

    def __getattr__(self, name):
        if name == "u":
            raise AttributeError("there is no x.u here; the Lagrangian and formulas of ends depend only on q, v, y and t")
        for part in ("q", "u", "y"):
            if name in getattr(getattr(self, part, None), "_names", ()):
                raise AttributeError(f"x has no {name}; write x.{part}.{name}" +
                                     (f" (x.v.{name} for its rate)" if part == "q" else ""))
        raise AttributeError(f"x has no {name}; it has q, v (the rates of q), u, y and t")
