# Momentum-force consistency over the number of intervals: fig:kepler_J and fig:twolink_obj b), and the same summed over all
# intervals.
#   gnuplot -e "results='results'" plots/consistency.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("consistency",\
    "problem,method,tableau,stages,solver,status,branch,intervals,momentum_defect_max,momentum_defect_total")

# The quantities, each with the order of its guide through the coarsest grid of tangent-space collocation.
quantities = "momentum_defect_max momentum_defect_total"
panel_title(quantity) = quantity eq "momentum_defect_max" ? "largest of an interval" : "sum over all intervals"
order_of(quantity) = quantity eq "momentum_defect_max" ? 3 : 2

do for [where in problems_of("consistency", "momentum_defect_max")] {
  problem = entry(where, "problem")
  curves = curves_of("consistency", where, "momentum_defect_max")
  tangent = where.",method=tangent"
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_momentum", 620)
    figure_title = title_text(problem_label(problem).": change of momentum compared with the force",\
        of_paper(problem, "fig:kepler\\_J", "fig:twolink\\_obj b)").conditions("consistency").".",\
        "DMOC’s momenta are position differences divided by h: its curve shows their round-off and the solver’s residual.")
    eval panels(1, 2, 95, 20, 135, 80, 0)
    do for [quantity in quantities] {
      eval measure("consistency", where, "intervals", quantity)
      eval intervals_axis
      eval power_axis("y")
      eval set_range("x", x_low, x_high, 1.25)
      eval set_range("y", y_low, y_high, 10)
      set ytics 1e2
      set title panel_title(quantity) offset 0, -0.5
      set ylabel (quantity eq word(quantities, 1) ? axis_label("momentum defect", problem, "momentum_unit") : "")\
          offset inwards
      top = 0
      if (strlen(distinct("consistency", "method", tangent, quantity)) > 0) {
        stats rows("consistency", tangent, quantity)\
            using (column("intervals") == x_low ? column(quantity) : NaN) name "G" nooutput
        top = 3 * G_max
      }
      set key at screen 0.5, screen 0.01 center bottom vertical maxrows 2 width -2 samplen 2.5 font ",12"
      if (quantity ne word(quantities, 1)) { unset key }
      plot for [curve in curves] rows("consistency", curve, quantity)\
           using (column("intervals")):(column(quantity))\
           with linespoints linetype method_style(entry(curve, "method")) title curve_label("consistency", curve),\
           top > 0 ? top * (x / x_low)**(-order_of(quantity)) : NaN with lines linetype 8\
           title (top > 0 ? "guides: C h³ left, C h² right" : "")
    }
    unset multiplot
    eval end_figure(kind, problem."_momentum")
  }
}
