# Orders of all methods for problems with first-order states, for every tableau.
#   gnuplot -e "results='results'" plots/first_order.gp
# Reads convergence_first_order.csv, which bench/reproduce --all writes, and its slopes; draws nothing if they are not there.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
name = "convergence_first_order"
if (!exists_table(name)) { exit }
eval require(name, "problem,method,tableau,stages,status,branch,intervals,first_order_error,control_error")
eval require(name."_slopes", "problem,method,tableau,stages,quantity,slope,verdict")

quantities = "first_order first_order_costate control_from_costate control"
panel_title(quantity) = quantity eq "first_order" ? "first-order states y_k at the nodes"\
    : quantity eq "first_order_costate" ? "their costate ψ^y_k at the nodes"\
    : quantity eq "control_from_costate" ? "u(x_k, ψ_k) at the nodes" : "stage controls U_i"

is_gauss(where) = entry(where, "tableau") eq "gauss"
colour(where) = is_gauss(where) ? (int(entry(where, "stages")) == 1 ? blue : int(entry(where, "stages")) == 2 ? vermilion : green)\
    : int(entry(where, "stages")) == 2 ? purple : grey
points_of(where) = entry(where, "method") eq "dmoc" ? 7 : entry(where, "method") eq "hamiltonian" ? 4 : 3
measured(where, quantity) = measured_text(system(rows_awk("-v where='".where.",quantity=".quantity."'\
    -v fields=verdict,points,slope", name."_slopes")))
measured_text(fields) = words(fields) == 0 ? "" : word(fields, 1) ne "slope" ? word(fields, 1)\
    : sprintf("%.2f", number(word(fields, 3)))
is_named(where) = entry(where, "method") eq "dmoc"
curve_title(where, quantity) = is_named(where) ? sprintf("%s %s: %s", entry(where, "tableau"), entry(where, "stages"),\
    or_else(measured(where, quantity), "no slope")) : ""

do for [problem_word in problems_of(name, "first_order_error")] {
  problem = entry(problem_word, "problem")
  curves = distinct(name, "problem,method,tableau,stages", problem_word, "first_order_error")
  do for [kind in kinds] {
    figure = problem."_first_order"
    eval begin_figure(kind, figure, 1080)
    figure_title = title_text(problem_label(problem).": errors with first-order states",\
        "Ours. Dots: DMOC, with fitted orders; squares: Hamiltonian; stars: tangent-space. Grey: powers of N.",\
        "Reference: finest grid of each curve. ".conditions(name).", polished.")
    eval panels(4, 1, 65, 285, 84, 0, 36)
    do for [quantity in quantities] {
      error = quantity."_error"
      eval measure(name, problem_word, "intervals", error)
      eval power_axis("y")
      set logscale x 2
      set xtics (16, 32, 64, 128, 256, 512)
      set xrange [x_low / 1.1:x_high * 1.1]
      eval set_range("y", y_low, y_high, 5)
      set ytics 100
      set title panel_title(quantity).": largest error" offset 0, -0.6
      set format x (quantity eq word(quantities, 4) ? "%g" : "")
      set xlabel (quantity eq word(quantities, 4) ? "number of intervals N" : "")
      set key at graph 1.1, graph 1 left top font ",12" samplen 2 spacing 1.15
      # Each guide has its order where it leaves the panel.
      top = 2 * y_high
      low = y_low / 5
      right = 1.1 * x_high
      do for [order in "1 2 4 6"] {
        k = real(order)
        x_end = top * (right / x_low)**(-k) > low ? right : x_low * (top / low)**(1 / k)
        set label "N^{−".order."}" at x_end, top * (x_end / x_low)**(-k) left offset 0.4, 0.3 front textcolor rgb grey
      }
      plot for [order in "1 2 4 6"] top * (x / x_low)**(-real(order)) with lines linetype 8 linewidth 0.8,\
           for [curve in curves] rows(name, curve, error) using (column("intervals")):(column(error))\
           with linespoints linewidth (is_named(curve) ? 1.8 : 0.8) linecolor rgb colour(curve)\
           pointsize (is_named(curve) ? 0.6 : 1.1) pointtype points_of(curve) title curve_title(curve, quantity)
      unset label
    }
    unset multiplot
    eval end_figure(kind, figure)
  }
}
