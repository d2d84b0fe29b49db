"""Draws pictures of solutions with matplotlib, which is imported on first use."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from ._core import Error

if TYPE_CHECKING:
    from .solving import Solution


def pyplot() -> Any:
    """Returns matplotlib.pyplot. Raises Error with instructions if matplotlib is not installed."""
    try:
        from matplotlib import pyplot as plt
    except ImportError:
        raise Error("pictures need matplotlib; install it with apt install python3-matplotlib or "
                    "pip install matplotlib") from None
    return plt


def _curves(solution: Solution) -> list[Any]:
    """(name, unit, times, values, marked times, marked values) of all coordinates, first-order states and controls."""
    if solution.t is None or solution.q is None:
        raise Error(f"{solution.status}: the solution has no trajectory to plot")
    none: list[str] = []
    times = np.linspace(solution.t[0], solution.t[-1], 8 * len(solution.t))
    smooth = solution.at(times)
    found = []
    for names, units, curve, marked in ((solution.coordinates, solution.coordinate_units, smooth.q, solution.t),
                                        (solution.first_order_states, none, smooth.y, solution.t),
                                        (solution.controls, solution.control_units, smooth.u, solution.stages.t)):
        for i, name in enumerate(names):
            values = solution.column(name)
            found.append((name, units[i] if units else "", times, np.asarray(curve)[:, i], marked, values))
    return found


def plot(solution: Solution, *names: str) -> Any:
    """See `Solution.plot`."""
    curves = _curves(solution)
    known = [curve[0] for curve in curves]
    for name in names:
        if name not in known:
            raise Error(f"there is no {name} to plot; choose one of {', '.join(known)}")
    chosen = [curve for curve in curves if not names or curve[0] in names]
    panels: dict[tuple[bool, str], list[Any]] = {}
    for curve in chosen:
        panels.setdefault((curve[0] in solution.controls, curve[1]), []).append(curve)
    _figure, axes = pyplot().subplots(len(panels), 1, sharex=True, squeeze=False, figsize=(6.4, 1.2 + 2.0 * len(panels)),
                                      constrained_layout=True)
    for axis, ((_, unit), lines) in zip(axes[:, 0], panels.items()):
        for name, _, times, values, marked, marks in lines:
            line, = axis.plot(times, values, label=name)
            axis.plot(marked, marks, ".", color=line.get_color(), markersize=3)
        axis.set_ylabel(", ".join(line[0] for line in lines) + (f" [{unit}]" if unit else ""))
        if len(lines) > 1:
            axis.legend()
    axes[0, 0].set_title(f"{solution.problem} by {solution.method}, {solution.intervals} intervals")
    axes[-1, 0].set_xlabel("t" + (f" [{solution.time_unit}]" if solution.time_unit else ""))
    return axes[:, 0]


Shape = Callable[[Any], Any]


def _points_of_picture(solution: Solution) -> tuple[np.ndarray, np.ndarray]:
    """Times and points (times x points x 2) from the pairs x, y or tip_x, tip_y in the problem's picture."""
    columns, values = solution.picture
    names = [re.sub(r"_in_\w+$", "", column) for column in columns]  # without their units
    points = []
    for i, name in enumerate(names):
        if name == "x" or name.endswith("_x"):
            other = [name[:-1] + letter for letter in "yz" if name[:-1] + letter in names]
            points.append((values[:, i], values[:, names.index(other[0])] if other else np.zeros(len(values))))
    if not points:
        raise Error("the problem's picture has no points such as x, y or tip_x, tip_y; give animate() a function of a point "
                    "x that returns the points of a line, such as lambda x: [(0, 0), (np.sin(x.q[0]), -np.cos(x.q[0]))]")
    return values[:, 0], np.array(points).transpose(2, 0, 1)


def animate(solution: Solution, shape: Shape | None = None, *, frames: int = 100, seconds: float | None = None) -> Any:
    """See `Solution.animate`."""
    if solution.t is None:
        raise Error(f"{solution.status}: the solution has no trajectory to animate")
    times = np.linspace(solution.t[0], solution.t[-1], frames)
    if shape is None:
        nodes, points = _points_of_picture(solution)
        inside = np.linspace(nodes[0], nodes[-1], frames)
        places = np.array([[np.interp(inside, nodes, points[:, j, k]) for k in range(2)]
                           for j in range(points.shape[1])]).transpose(2, 0, 1)
    else:
        places = np.array([np.asarray(shape(solution.at(t)), dtype=float) for t in times])
        if places.ndim != 3 or places.shape[2] != 2:
            raise Error(f"the function of animate() returns an array of the shape {places.shape[1:]}, expected points (x, y), "
                        "one per row")
    plt = pyplot()
    from matplotlib.animation import FuncAnimation

    figure, axis = plt.subplots()
    low, high = places.min(axis=(0, 1)), places.max(axis=(0, 1))
    margin = 0.1 * max(*(high - low), 1e-12)
    axis.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), aspect="equal")
    axis.plot(places[:, -1, 0], places[:, -1, 1], color="0.8", linewidth=1)
    line, = axis.plot([], [], "o-")
    label = axis.set_title("")

    def show(frame: int) -> Any:
        line.set_data(places[frame, :, 0], places[frame, :, 1])
        label.set_text(f"{solution.problem}, t = {times[frame]:.3g} {solution.time_unit}".rstrip())
        return line, label

    duration = float(times[-1]) if seconds is None else seconds
    return FuncAnimation(figure, show, frames=frames, interval=1000.0 * duration / frames)
