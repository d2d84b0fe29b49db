# Momentum-force consistency over the number of intervals: fig:kepler_J and fig:twolink_obj b).
#   gnuplot -e "results='results'" plots/consistency.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("consistency", "problem,method,tableau,stages,solver,status,branch,intervals,momentum_defect_max")

set key top right

do for [where in problems_of("consistency", "momentum_defect_max")] {
  problem = entry(where, "problem")
  curves = curves_of("consistency", where, "momentum_defect_max")
  eval measure("consistency", where, "intervals", "momentum_defect_max")
  eval intervals_axis
  eval power_axis("y")
  eval set_range("x", x_low, x_high, 1.25)
  eval set_range("y", y_low, y_high, 10)
  set title title_text(problem_label(problem).": change of the momentum against the force, interval by interval",\
      of_paper(problem, "fig:kepler\\_J", "fig:twolink\\_obj b)").conditions("consistency").".",\
      "DMOC’s momenta are differences of positions over h: its curve shows their rounding and the residual of the solver."\
      .for_paper(problem, " Paper: equal to numerical accuracy for DMOC and Hamiltonian collocation",\
          " Paper: tangent-space collocation is less consistent than the other two"))
  set ylabel axis_label("largest momentum defect of an interval", problem, "momentum_unit")
  # A guide through the coarsest grid of tangent-space collocation.
  tangent = where.",method=tangent"
  has_tangent = strlen(distinct("consistency", "method", tangent, "momentum_defect_max")) > 0
  top = 0
  if (has_tangent) {
    stats rows("consistency", tangent, "momentum_defect_max")\
        using (column("intervals") == x_low ? column("momentum_defect_max") : NaN) name "G" nooutput
    top = 3 * G_max
  }
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_momentum", 600)
    set ytics 10
    plot for [curve in curves] rows("consistency", curve, "momentum_defect_max")\
         using (column("intervals")):(column("momentum_defect_max"))\
         with linespoints linetype method_style(entry(curve, "method")) title curve_label("consistency", curve),\
         has_tangent ? top * (x / x_low)**(-3) : NaN with lines linetype 8 title (has_tangent ? "C h³, guide" : "")
    eval end_figure(kind, problem."_momentum")
  }
}
