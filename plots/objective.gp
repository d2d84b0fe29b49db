# Optimal cost over the number of intervals: fig:twolink_obj a). A second panel shows its distance to the certified optimum
# where convergence_indirect_reference.csv has one, else objective_error of convergence.csv if that is there.
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

# The certified cost of a problem as text; empty if there is none.
certified_cost(where) = exists_table("convergence_indirect_reference") ?\
    system(rows_awk("-v where='".where."'", "convergence_indirect_reference").\
    " | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"cost\") c = i; next } { print $c }'") : ""
distance_to(cost) = abs(column("objective") - cost)

do for [where in problems_of("objective", "")] {
  problem = entry(where, "problem")
  curves = curves_of("objective", where, "")
  certified = certified_cost(where)
  is_certified = strlen(certified) > 0
  table_of_errors = is_certified ? "objective" : "convergence"
  error_curves = is_certified ? curves : errors ? curves_of("convergence", where, "objective_error") : ""
  panels = strlen(error_curves) > 0 ? 2 : 1
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_objective", 600)
    figure_title = title_text(problem_label(problem).": cost over the number of intervals",\
        of_paper(problem, "no figure", "fig:twolink\\_obj a)").conditions("objective").".",\
        panels == 1 ? "" : is_certified\
        ? "Right: J* is the certified cost of the continuous problem; dips are sign changes of the error."\
        : "Right: against the cost of ".reference_words("convergence", where)."; dips are sign changes of the error.")
    if (panels == 2) { eval panels(1, 2, 90, 15, 115, 100, 0) } else { set title figure_title }
    if (panels == 2) { eval key_below } else { set key top right }
    eval measure("objective", where, "intervals", "objective")
    eval intervals_axis
    eval set_range("x", x_low, x_high, 1.25)
    eval plain_axis("y", y_high)
    power = abs(y_high) > 0.01 && abs(y_high) < 1e5 ? 0 : int(floor(log10(abs(y_high))))
    set format y "%g"
    set ylabel axis_label("cost J".(power == 0 ? "" : sprintf(" · 10^{%d}", -power)), problem, "cost_unit") offset inwards
    plot for [curve in curves] rows("objective", curve, "")\
         using (column("intervals")):(column("objective") / 10.0**power)\
         with linespoints linetype method_style(entry(curve, "method")) title curve_label("objective", curve)
    if (panels == 2) {
      unset key
      if (is_certified) {
        J = number(certified)
        unset logscale; set autoscale
        stats drawn_rows("objective", where, "objective") using (distance_to(J)) name "S" nooutput
        y_low = S_min; y_high = S_max
      } else { eval measure("convergence", where, "intervals", "objective_error") }
      eval intervals_axis
      eval set_range("x", x_low, x_high, 1.25)
      eval power_axis("y")
      set ylabel axis_label(is_certified ? "|J − J*|" : "|J − J_{ref}|", problem, "cost_unit") offset inwards
      plot for [curve in error_curves] rows(table_of_errors, curve, is_certified ? "objective" : "objective_error")\
           using (column("intervals")):(is_certified ? distance_to(J) : column("objective_error"))\
           with linespoints linetype method_style(entry(curve, "method")) title curve_label(table_of_errors, curve)
      unset multiplot
    }
    eval end_figure(kind, problem."_objective")
  }
}
