# What collocation costs in multiples of DMOC, solver by solver: rem:savings, and how much of it belongs to the solver.
#   gnuplot -e "results='results'" plots/savings_by_solver.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
name = "savings_by_solver_ratios"
eval require(name, "problem,method,tableau,stages,solver,factorisation,intervals,quantity,ratio_at_equal_intervals")

# Solvers in the order of the legend. Ipopt reports no time of its linear systems: it is drawn by its time per
# iteration without evaluations.
ways = "ipopt sparse intervals"
way_labels = "'Ipopt (MUMPS), per iteration' 'interior point, MUMPS' 'interior point, by intervals'"
# No colour of a method: all curves are ratios of the same two.
colour(w) = w == 1 ? black : w == 2 ? orange : purple
point(w) = word("4 11 5", w) + 0
way_of(w) = w == 1 ? "solver=ipopt" : "solver=interior_point,factorisation=".word(ways, w)

panels = "'time of a linear system' 'time of a solve'"
quantity_of(panel, w) = panel == 2 ? "seconds" : w == 1 ? "linear_algebra_per_iteration" : "seconds_per_linear_system"

ratio = "ratio_at_equal_intervals"
do for [where in problems_of(name, ratio)] {
  problem = entry(where, "problem")
  conditions = where.",method=hamiltonian,tableau=gauss,stages=1"
  measured_ways = ""
  do for [panel = 1:2] {
    do for [w = 1:words(ways)] {
      measured_ways = measured_ways.distinct(name, "quantity", conditions.",".way_of(w).",quantity=".quantity_of(panel, w), ratio)
    }
  }
  if (strlen(measured_ways) == 0) { continue }
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_savings_by_solver", 660)
    figure_title = title_text(problem_label(problem)\
        .": time with Hamiltonian collocation divided by the time with DMOC",\
        paper_note(problem, "section 3.4, rem:savings").timed_conditions("savings_by_solver").". Above 1, DMOC costs less.",\
        "Bars: 99 % intervals over the rounds. Ipopt: time of an iteration without evaluations.")
    eval panels(1, 2, 80, 15, 165, 95, 0)
    # Both panels have one range, which holds all that is drawn.
    low = 1; high = 1
    do for [panel = 1:2] {
      do for [w = 1:words(ways)] {
        selected = conditions.",".way_of(w).",quantity=".quantity_of(panel, w)
        do for [bound in ratio." ratio_lower ratio_upper"] {
          if (strlen(distinct(name, "quantity", selected, bound)) > 0) {
            eval measure(name, selected, "intervals", bound)
            if (y_low < low) { low = y_low }
            if (y_high > high) { high = y_high }
          }
        }
      }
    }
    do for [panel = 1:2] {
      eval measure(name, conditions, "intervals", ratio)
      eval intervals_axis
      eval set_range("x", x_low, x_high, 1.25)
      set logscale y 2
      set ytics (0.1, 0.15, 0.2, 0.3, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 4, 6, 8); set format y '%g'; unset mytics
      drawn = ""; with_bars = ""
      do for [w = 1:words(ways)] {
        selected = conditions.",".way_of(w).",quantity=".quantity_of(panel, w)
        if (strlen(distinct(name, "quantity", selected, ratio)) > 0) { drawn = drawn." ".w }
        if (strlen(distinct(name, "quantity", selected, "ratio_lower")) > 0) { with_bars = with_bars." ".w }
      }
      set yrange [low / 1.1:high * 1.1]
      set ylabel "Hamiltonian / DMOC, ".word(panels, panel) offset inwards
      if (panel == 1) { set key at screen 0.5, screen 0.015 center bottom vertical maxrows 3 width 2 } else { unset key }
      plot 1 with lines linecolor rgb grey linewidth 1 notitle,\
           for [w in "1 2 3"] keyentry with linespoints linecolor rgb colour(number_in(w)) linewidth 1.8 dashtype 1\
             pointtype point(number_in(w)) pointsize 0.8 title word(way_labels, number_in(w)),\
           for [w in drawn] rows(name, conditions.",".way_of(number_in(w)).",quantity=".quantity_of(panel, number_in(w)), ratio)\
             using (column("intervals")):(column(ratio)) with linespoints linecolor rgb colour(number_in(w)) linewidth 1.8\
             dashtype 1 pointtype point(number_in(w)) pointsize 0.8 notitle,\
           for [k = 1:words(with_bars)] rows(name, conditions.",".way_of(number_in(word(with_bars, k))).",quantity=".quantity_of(panel, number_in(word(with_bars, k))), "ratio_lower")\
             using (column("intervals")):(column(ratio)):(column("ratio_lower")):(column("ratio_upper")) with yerrorbars\
             linecolor rgb colour(number_in(word(with_bars, k))) linewidth 1.4 dashtype 1 pointtype point(number_in(word(with_bars, k))) pointsize 0.8 notitle
    }
    unset multiplot
    eval end_figure(kind, problem."_savings_by_solver")
  }
}
