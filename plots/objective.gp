# Optimal cost over the number of intervals: fig:twolink_obj a). If convergence.csv is there, a second panel shows its
# objective_error, the distance to the cost of the reference.
#   gnuplot -e "results='results'" plots/objective.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("objective", "problem,method,tableau,stages,solver,status,branch,intervals,objective")
errors = exists_table("convergence")
if (errors) {
  of_costs = incomplete
  eval require("convergence", "problem,method,tableau,stages,solver,status,branch,intervals,objective_error")
  incomplete = joined(of_costs, incomplete)
}

reference_words = strlen(told("convergence", "reference")) > 0 ? told("convergence", "reference")\
    : "the finest grid of the same method"

do for [where in problems_of("objective", "")] {
  problem = entry(where, "problem")
  curves = curves_of("objective", where, "")
  error_curves = errors ? curves_of("convergence", where, "objective_error") : ""
  panels = strlen(error_curves) > 0 ? 2 : 1
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_objective", panels == 2 ? 1100 : 900, 600)
    figure_title = title_text(problem_label(problem).": cost over the number of intervals",\
        of_paper(problem, "", "twolink\\_obj a)").conditions("objective").".",\
        panels == 2 ? "Right: J_{ref} is that of ".reference_words."; an error that changes its sign dips." : "")
    if (panels == 2) { eval two_panels(0.135) } else { set title figure_title }
    if (panels == 2) { eval key_below } else { set key top right }
    eval measure("objective", where, "intervals", "objective")
    eval intervals_axis
    eval set_range("x", x_low, x_high, 1.25)
    eval plain_axis("y", y_high)
    power = abs(y_high) > 0.01 && abs(y_high) < 1e5 ? 0 : int(floor(log10(abs(y_high))))
    set format y "%g"
    set ylabel axis_label("cost J".(power == 0 ? "" : sprintf(" · 10^{%d}", -power)), problem, "cost_unit")
    plot for [curve in curves] rows("objective", curve, "")\
         using (column("intervals")):(column("objective") / 10.0**power)\
         with linespoints linetype method_style(entry(curve, "method")) title curve_label("objective", curve)
    if (panels == 2) {
      unset key
      eval measure("convergence", where, "intervals", "objective_error")
      eval intervals_axis
      eval set_range("x", x_low, x_high, 1.25)
      eval power_axis("y")
      set ylabel axis_label("|J − J_{ref}|", problem, "cost_unit")
      plot for [curve in error_curves] rows("convergence", curve, "objective_error")\
           using (column("intervals")):(column("objective_error"))\
           with linespoints linetype method_style(entry(curve, "method")) title curve_label("convergence", curve)
      unset multiplot
    }
    eval end_figure(kind, problem."_objective")
  }
}
