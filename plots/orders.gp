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
unit_in_words(problem, quantity) = has_unit(quantity) ? axis_label("largest error", problem, unit_of(quantity))\
    : "largest error [cost per unit of ".(strstrt(quantity, "_p") > 0 ? "p]" : strstrt(quantity, "_q") > 0 ? "q]" : "q or p]")

is_gauss(where) = entry(where, "tableau") eq "gauss"
node_order(where) = 2 * int(entry(where, "stages")) - (is_gauss(where) ? 0 : 2)
points_of(where) = is_gauss(where) ? 7 : 6
dashes_of(where) = is_gauss(where) ? 1 : 2
colour(where) = int(entry(where, "stages")) == 1 ? blue : int(entry(where, "stages")) == 2 ? vermilion\
    : int(entry(where, "stages")) == 3 ? green : purple
# "3.99, N = 16 to 96", or the verdict where there is no slope.
measured(where, quantity) = measured_text(system(rows_awk("-v where='".where.",quantity=".quantity."'\
    -v fields=verdict,points,slope,coarsest,finest", name."_slopes")))
measured_text(fields) = words(fields) == 0 ? "" : word(fields, 1) ne "slope"\
    ? sprintf("%s (%s grids)", word(fields, 1), word(fields, 2))\
    : sprintf("%.2f, N = %s to %s", number(word(fields, 3)), word(fields, 4), word(fields, 5))
curve_title(where, quantity) = sprintf("%s %s: %s", entry(where, "tableau"), entry(where, "stages"),\
    or_else(measured(where, quantity), "no slope"))

do for [problem_word in problems_of(name, "state_error")] {
  problem = entry(problem_word, "problem")
  curves = distinct(name, "problem,method,tableau,stages", problem_word.",method=dmoc", "state_error")
  do for [kind in kinds] {
    do for [place in "nodes stages"] {
      panels_here = place eq "nodes" ? at_nodes : at_stages
      figure = problem.(place eq "nodes" ? "_orders" : "_stage_orders")
      eval begin_figure(kind, figure, 1080)
      figure_title = title_text(problem_label(problem).": errors of DMOC at the ".place.", every tableau",\
          paper_note(problem, "order 2s for Gauss, 2s − 2 for Lobatto"),\
          "Reference: indirect solution. No slope: too few grids above round-off"\
          ." (“floor”) or in agreement (“unsteady”). Grey: powers of N.")
      eval panels(4, 1, 65, 285, 84, 0, 36)
      do for [quantity in panels_here] {
        error = quantity."_error"
        eval measure(name, problem_word.",method=dmoc", "intervals", error)
        eval power_axis("y")
        set logscale x 2
        set xtics (16, 32, 64, 128, 256, 512)
        set xrange [x_low / 1.1:x_high * 1.1]
        eval set_range("y", y_low, y_high, 5)
        set ytics 100
        set title panel_title(quantity).": ".unit_in_words(problem, quantity) offset 0, -0.6
        set format x (quantity eq word(panels_here, 4) ? "%g" : "")
        set xlabel (quantity eq word(panels_here, 4) ? "number of intervals N" : "")
        set key at graph 1.1, graph 1 left top font ",12" samplen 2 spacing 1.15
        # Each guide has its order where it leaves the panel.
        top = 2 * y_high
        low = y_low / 5
        right = 1.1 * x_high
        do for [order in "1 2 4 6 8"] {
          k = real(order)
          x_end = top * (right / x_low)**(-k) > low ? right : x_low * (top / low)**(1 / k)
          set label "N^{−".order."}" at x_end, top * (x_end / x_low)**(-k) left offset 0.4, 0.3 front textcolor rgb grey
        }
        plot for [order in "1 2 4 6 8"] top * (x / x_low)**(-real(order)) with lines linetype 8 linewidth 0.8,\
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
