# Orders of DMOC against the indirect solution (main_theorem, th:orderapp): what has the full order at the nodes, and the
# lower orders at the stages, for every tableau.
#   gnuplot -e "results='results'" plots/orders.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
name = "convergence_indirect"
eval require(name, "problem,method,tableau,stages,status,branch,intervals,state_error,control_error,stage_momentum_error")
eval require(name."_slopes", "problem,method,tableau,stages,quantity,slope,verdict")

panels = "state momentum costate control_from_costate control stage_momentum stage_costate_q stage_costate_p"
panel_title(quantity) = quantity eq "state" ? "configuration q_k at the nodes"\
    : quantity eq "momentum" ? "momentum p_k at the nodes" : quantity eq "costate" ? "costate ψ_k at the nodes"\
    : quantity eq "control_from_costate" ? "u(x_k, ψ_k) at the nodes" : quantity eq "control" ? "stage controls U_i"\
    : quantity eq "stage_momentum" ? "stage momenta P_i"\
    : quantity eq "stage_costate_q" ? "stage costates Ψ^q_i" : "stage costates Ψ^p_i"
unit_of(quantity) = quantity eq "state" ? "state_unit" : quantity eq "momentum" || quantity eq "stage_momentum"\
    ? "momentum_unit" : "control_unit"
has_unit(quantity) = strstrt(quantity, "costate") == 0 || quantity eq "control_from_costate"
error_label(problem, quantity) = has_unit(quantity) ? axis_label("largest error", problem, unit_of(quantity))\
    : "largest error"

is_gauss(where) = entry(where, "tableau") eq "gauss"
node_order(where) = 2 * int(entry(where, "stages")) - (is_gauss(where) ? 0 : 2)
points_of(where) = is_gauss(where) ? 7 : 6
dashes_of(where) = is_gauss(where) ? 1 : 2
colour(where) = int(entry(where, "stages")) == 1 ? blue : int(entry(where, "stages")) == 2 ? vermilion\
    : int(entry(where, "stages")) == 3 ? green : purple
# "slope 3.99", or the verdict where it is none.
measured(where, quantity) = system(rows_awk("-v where='".where.",quantity=".quantity."'", name."_slopes").\
    " | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i == \"slope\") s = i; if ($i == \"verdict\") v = i }; next }\
      { if ($v == \"slope\") printf \"%.2f\", $s; else printf \"%s\", $v }'")
curve_title(where, quantity) = sprintf("%s %s: %s", entry(where, "tableau"), entry(where, "stages"),\
    or_else(measured(where, quantity), "no slope"))
guide_dash(order) = order == 2 ? "8,5" : "2,4"

do for [problem_word in problems_of(name, "state_error")] {
  problem = entry(problem_word, "problem")
  curves = distinct(name, "problem,method,tableau,stages", problem_word.",method=dmoc", "state_error")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_orders", 1500, 1500)
    set multiplot layout 4, 2 title title_text(problem_label(problem)\
        .": the order of the tableau at the nodes, less at the stages", "",\
        "DMOC against the indirect solution; numbers are fitted slopes, grey fans are C N^{−1}, C N^{−2}, C N^{−4} and C N^{−6}.")\
        offset 0, -0.4 margins 0.07, 0.87, 0.05, 0.92 spacing 0.2, 0.065
    do for [quantity in panels] {
      error = quantity."_error"
      eval measure(name, problem_word.",method=dmoc", "intervals", error)
      eval power_axis("y")
      set logscale x 2
      set xtics (16, 32, 64, 128, 256, 512)
      set xrange [x_low / 1.1:x_high * 1.1]
      eval set_range("y", y_low, y_high, 5)
      set ytics 100
      set title panel_title(quantity) offset 0, -0.6
      set xlabel (quantity eq "stage_costate_q" || quantity eq "stage_costate_p" ? "number of intervals N" : "")
      set ylabel error_label(problem, quantity)
      set key at graph 1.03, graph 1 left top font ",12" samplen 2.5
      plot for [order in "1 2 4 6"] 2 * y_high * (x / x_low)**(-real(order)) with lines linetype 8 linewidth 0.8,\
           for [curve in curves] rows(name, curve, error) using (column("intervals")):(column(error))\
           with linespoints linewidth 1.8 linecolor rgb colour(curve) pointsize 0.7\
           pointtype points_of(curve) dashtype dashes_of(curve) title curve_title(curve, quantity)
    }
    unset multiplot
    eval end_figure(kind, problem."_orders")
  }
}
