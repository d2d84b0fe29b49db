# Orders of DMOC against the indirect solution (main_theorem, th:orderapp) for every tableau: at the nodes, and at the
# stages.
#   gnuplot -e "results='results'" plots/orders.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
name = "convergence_indirect"
eval require(name, "problem,method,tableau,stages,status,branch,intervals,state_error,control_error,stage_momentum_error")
eval require(name."_slopes", "problem,method,tableau,stages,quantity,slope,verdict")

# The figures, each with its panels.
at_nodes = "state momentum costate control_from_costate"
at_stages = "control stage_momentum stage_costate_q stage_costate_p"
panel_title(quantity) = quantity eq "state" ? "configuration q_k at the nodes"\
    : quantity eq "momentum" ? "momentum p_k at the nodes" : quantity eq "costate" ? "costate ψ_k at the nodes"\
    : quantity eq "control_from_costate" ? "u(x_k, ψ_k) at the nodes" : quantity eq "control" ? "stage controls U_i"\
    : quantity eq "stage_momentum" ? "stage momenta P_i"\
    : quantity eq "stage_costate_q" ? "stage costates Ψ^q_i" : "stage costates Ψ^p_i"
unit_of(quantity) = quantity eq "state" ? "state_unit" : quantity eq "momentum" || quantity eq "stage_momentum"\
    ? "momentum_unit" : "control_unit"
has_unit(quantity) = strstrt(quantity, "costate") == 0 || quantity eq "control_from_costate"
error_label(problem, quantity) = has_unit(quantity) ? axis_label("largest error", problem, unit_of(quantity))\
    : "largest error [cost per unit of ".(strstrt(quantity, "_p") > 0 ? "p]" : strstrt(quantity, "_q") > 0 ? "q]" : "q or p]")

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

do for [problem_word in problems_of(name, "state_error")] {
  problem = entry(problem_word, "problem")
  curves = distinct(name, "problem,method,tableau,stages", problem_word.",method=dmoc", "state_error")
  do for [kind in kinds] {
    do for [place in "nodes stages"] {
      panels = place eq "nodes" ? at_nodes : at_stages
      figure = problem.(place eq "nodes" ? "_orders" : "_stage_orders")
      eval begin_figure(kind, figure, 1200, 950)
      set multiplot layout 2, 2 title title_text(problem_label(problem).": errors of DMOC at the ".place.", every tableau",\
          "Against the indirect solution. ".conditions(name).", then Newton steps to rounding.",\
          "Numbers are fitted slopes, “floor” where rounding leaves too few grids; grey guides are C N^{−k}.")\
          offset 0, -0.4 margins 0.085, 0.86, 0.07, 0.86 spacing 0.25, 0.11
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
        set xlabel "number of intervals N"
        set ylabel error_label(problem, quantity) offset 1
        set key at graph 1.03, graph 1 left top font ",12" samplen 2.5
        # Each guide has its order at its end, or where it leaves the panel.
        top = 2 * y_high
        low = y_low / 4
        do for [order in "1 2 4 6"] {
          k = real(order)
          x_end = top * (x_high / x_low)**(-k) > low ? x_high : x_low * (top / low)**(1 / k)
          set label "N^{−".order."}" at x_end, top * (x_end / x_low)**(-k) right offset 0, 0.6 front font ",11"\
              textcolor rgb grey
        }
        plot for [order in "1 2 4 6"] top * (x / x_low)**(-real(order)) with lines linetype 8 linewidth 0.8,\
             for [curve in curves] rows(name, curve, error) using (column("intervals")):(column(error))\
             with linespoints linewidth 1.8 linecolor rgb colour(curve) pointsize 0.7\
             pointtype points_of(curve) dashtype dashes_of(curve) title curve_title(curve, quantity)
        unset label
      }
      unset multiplot
      eval end_figure(kind, figure)
    }
  }
}
