"""The names that arguments accept, for editors and type checkers. A test compares these names with the names in C++."""

from __future__ import annotations

from typing import Literal, Union

Method = Union[Literal["dmoc", "hamiltonian", "tangent", "multiple_shooting_rk4_1", "multiple_shooting_midpoint_1",
                       "single_shooting_rk4_1", "single_shooting_midpoint_1", "galerkin_1_1", "second_order"], str]
"""A transcription: DMOC, collocation of Hamilton's or of the Euler-Lagrange equations, shooting with an explicit
integrator, Galerkin, second-order collocation. The numbers at the end, as in multiple_shooting_rk4_4, can be changed."""

Tableau = Literal["gauss", "lobatto", "lobatto_shared"]
"""A family of Butcher tableaus."""

Solver = Literal["auto", "interior_point", "ipopt", "sqp", "nlopt"]
"""A method for nonlinear programs."""

Derivatives = Literal["tape", "adolc", "adolc_whole", "finite_differences", "forward_differences", "dense_differences"]
"""A source of derivatives for solvers. "adolc" and "adolc_whole" need a build with ADOL-C."""

CostForm = Literal["bolza", "mayer"]
"""A form of the cost."""

Refinement = Literal["h", "hp"]
"""The kind of refinement for an accuracy: of the steps, or of the steps and stages."""

Experiment = Literal["adaptive", "certify", "claims", "closed_loop", "coercivity", "cold_start", "consistency",
                     "consistency_order", "convergence", "derivatives", "equivalence", "error_constants", "invariants",
                     "iterations", "list", "local_minima", "low_thrust", "misprints", "new", "objective", "primitives",
                     "profile", "read-sol", "report", "rigid_body_coordinates", "savings_by_solver", "sequence", "shooting",
                     "smoothness", "solve", "step_control", "study", "sweep", "write-nl"]
"""A program of the suite."""
