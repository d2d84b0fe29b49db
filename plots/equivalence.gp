# Equal solutions of DMOC and Hamiltonian collocation, other ones of tangent-space collocation (th:equi); residuals of solved
# multipliers in the adjoint Runge-Kutta scheme (th:orderapp); and the residuals of the two forms of the control
# Lagrangian at the solutions of all methods; over the number of intervals.
#   gnuplot -e "results='results'" plots/equivalence.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
name = "equivalence"
eval require(name, "problem,method,tableau,stages,status,branch,intervals,configuration_difference,".\
    "costate_difference,adjoint_residual,adjoint_residual_by_plain_coefficients,forced_form_residual,".\
    "acceleration_form_residual")

is_gauss(where) = entry(where, "tableau") eq "gauss"
points_of(where) = is_gauss(where) ? 7 : 6
dashes_of(where) = is_gauss(where) ? 1 : 2
colour(where) = number_in(entry(where, "stages")) == 1 ? blue : number_in(entry(where, "stages")) == 2 ? vermilion\
    : number_in(entry(where, "stages")) == 3 ? green : purple
tableau_label(where) = entry(where, "tableau")." ".entry(where, "stages")
# ": slope 3.99" of the differences in q; nothing where they are no more than rounding.
measured(where) = exists_table("equivalence_slopes") ? system(rows_awk("-v where='".where."'", "equivalence_slopes").\
    " | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"slope\") s = i; next }\
      $s != \"\" { printf \": slope %.2f\", $s }'") : ""
curves_with(method, column) = distinct(name, "problem,method,tableau,stages", problem_word.",method=".method, column)
# Ticks at the grids of the table.
grid_tics = ""
do for [grid in distinct(name, "intervals", "", "")] {
  grid_tics = grid_tics.(strlen(grid_tics) == 0 ? "" : ", ").entry(grid, "intervals")
}
interval_axis = "set logscale x 2; set xtics (".grid_tics."); set xlabel 'number of intervals N'"
pale = "#A0A0A0"

do for [problem_word in problems_of(name, "")] {
  problem = entry(problem_word, "problem")
  if (strlen(distinct(name, "method", problem_word, "configuration_difference")) == 0\
      || strlen(distinct(name, "method", problem_word, "costate_difference")) == 0) { continue }
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_equivalence", 800)
    figure_title = title_text(problem_label(problem).": differences of collocation from DMOC with the same tableau",\
        paper_note(problem, "section 3.4, th:equi").conditions(name)\
        .", then Newton steps.",\
        "Largest difference over nodes and components, relative to DMOC’s largest value of the quantity.")
    eval panels(2, 1, 95, 250, 80, 0, 45)
    do for [column in "configuration_difference costate_difference"] {
      eval measure(name, problem_word, "intervals", column)
      eval power_axis("y")
      eval interval_axis
      set xrange [x_low / 1.1:x_high * 1.1]
      set yrange [1e-17:(y_high > 1e-8 ? 10 * y_high : 1e-7)]
      set ytics 1e3
      set title (column eq "configuration_difference" ? "configurations" : "costates") offset 0, -0.5
      if (column eq "configuration_difference") { set xlabel ""; set format x "" } else { set format x "%g" }
      set ylabel "relative difference" offset inwards
      set key at graph 1.02, graph 1 left top maxrows auto font ",12" samplen 2.5 width 0
      plot for [curve in curves_with("tangent", column)] rows(name, curve, column)\
           using (column("intervals")):(column(column))\
           with linespoints linewidth 1.8 linecolor rgb colour(curve) pointsize 0.7\
           pointtype points_of(curve) dashtype dashes_of(curve)\
           title "tangent, ".tableau_label(curve).(column eq "configuration_difference" ? measured(curve) : ""),\
           for [curve in curves_with("hamiltonian", column)] rows(name, curve, column)\
           using (column("intervals")):(column(column))\
           with linespoints linewidth 1 linecolor rgb pale pointsize 0.7 pointtype 4 dashtype 3 notitle,\
           keyentry with linespoints linewidth 1 linecolor rgb pale pointsize 0.7 pointtype 4 dashtype 3\
           title "Hamiltonian, all tableaus"
    }
    unset multiplot
    eval end_figure(kind, problem."_equivalence")

    if (words(curves_with("dmoc", "adjoint_residual")) == 0) { continue }
    has_plain = words(curves_with("dmoc,tableau=lobatto", "adjoint_residual_by_plain_coefficients")) > 0
    eval begin_figure(kind, problem."_adjoint", 620)
    figure_title = title_text(problem_label(problem).": residual of the multipliers in the adjoint Runge-Kutta scheme",\
        paper_note(problem, "section 3.5, th:orderapp").conditions(name).", then Newton steps.",\
        has_plain ? "Triangles: without exchanging the coefficients of both costates (equal for Gauss)." : "")
    eval panels(1, 1, 95, 265, 80, 0, 0)
    unset title
    eval measure(name, problem_word.",method=dmoc".(has_plain ? ",tableau=lobatto" : ""), "intervals",\
        "adjoint_residual".(has_plain ? "_by_plain_coefficients" : ""))
    eval power_axis("y")
    eval interval_axis
    set xrange [x_low / 1.1:x_high * 1.1]
    set yrange [1e-17:10 * y_high]
    set ytics 1e3
    set ylabel "largest relative residual of a step or stage"
    set key at graph 1.02, graph 1 left top maxrows auto font ",12" samplen 2.5
    plot for [curve in curves_with("dmoc,tableau=lobatto", "adjoint_residual")]\
         rows(name, curve, "adjoint_residual_by_plain_coefficients")\
         using (column("intervals")):(column("adjoint_residual_by_plain_coefficients"))\
         with linespoints linewidth 1.8 linecolor rgb colour(curve) pointsize 0.9 pointtype 8 dashtype 3\
         title "DMOC, ".tableau_label(curve).", not exchanged",\
         for [curve in curves_with("dmoc", "adjoint_residual")] rows(name, curve, "adjoint_residual")\
         using (column("intervals")):(column("adjoint_residual"))\
         with linespoints linewidth 1.8 linecolor rgb colour(curve) pointsize 0.7\
         pointtype points_of(curve) dashtype dashes_of(curve) title "DMOC, ".tableau_label(curve),\
         for [curve in curves_with("hamiltonian", "adjoint_residual")] rows(name, curve, "adjoint_residual")\
         using (column("intervals")):(column("adjoint_residual"))\
         with linespoints linewidth 1 linecolor rgb pale pointsize 0.7 pointtype 4 dashtype 3 notitle,\
         keyentry with linespoints linewidth 1 linecolor rgb pale pointsize 0.7 pointtype 4 dashtype 3\
         title "Hamiltonian, all tableaus"
    unset multiplot
    eval end_figure(kind, problem."_adjoint")

    # Both forms of the control Lagrangian, where the table has their residuals.
    forms = curves_with("dmoc", "forced_form_residual")
    if (words(forms) == 0) { continue }
    eval begin_figure(kind, problem."_control_lagrangian", 600)
    figure_title = title_text(problem_label(problem).": residuals of both forms of the control Lagrangian",\
        "Midpoint rule: Euler-Lagrange equations in q and the multiplier ξ, at the solution of each method.",\
        conditions(name).", then Newton steps.")
    eval panels(1, 2, 90, 15, 115, 20, 0)
    unset title
    eval measure(name, problem_word.",method=dmoc", "intervals", "forced_form_residual")
    lowest = y_low; highest = y_high
    do for [method in paper_families] {
      do for [column in "forced_form_residual acceleration_form_residual"] {
        if (strlen(distinct(name, "method", problem_word.",method=".method, column)) == 0) { continue }
        eval measure(name, problem_word.",method=".method, "intervals", column)
        if (y_low < lowest) { lowest = y_low }
        if (y_high > highest) { highest = y_high }
      }
    }
    eval key_below
    do for [column in "forced_form_residual acceleration_form_residual"] {
      eval measure(name, problem_word.",method=dmoc", "intervals", column)
      eval power_axis("y")
      eval interval_axis
      set format x "%g"
      set xrange [x_low / 1.1:x_high * 1.1]
      eval set_range("y", lowest, highest, 5)
      set ytics 1e2
      forced = column eq "forced_form_residual"
      set title (forced ? "form with forces, F = L_q + f" : "form with accelerations, F = q̈(q, q̇, u)") offset 0, -0.5
      set ylabel (forced ? "largest residual" : "") offset inwards
      if (!forced) { set format y ""; unset key }
      plot for [method in paper_families] rows(name, problem_word.",method=".method, column)\
           using (column("intervals")):(column(column)) with linespoints linetype method_style(method)\
           title method_label(method)
    }
    unset multiplot
    eval end_figure(kind, problem."_control_lagrangian")
  }
}
