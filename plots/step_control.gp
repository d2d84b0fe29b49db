# Steps tied to the trajectory along ellipses of eccentricity 0.8: the energy over many periods, the error of a period, and the
# error of the optimal cost of a transfer. Names stand at the curves.
#   gnuplot -e "results='results'" plots/step_control.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("step_control_energy", "eccentricity,rule,stages,steps_per_period,period,energy_smallest,energy_largest")
eval require("step_control_transfer", "eccentricity,rule,stages,intervals,status,cost_error")
eval require("step_control", "eccentricity,rule,sigma,stages,steps_per_period,status,state_error")

ellipse = "eccentricity=0.8,stages=1"
choices = distinct("step_control_energy", "rule,sigma", ellipse, "")
transfers = distinct("step_control_transfer", "rule,sigma", ellipse, "cost_error")
# One colour for what is compared, DMOC's; the others recede.
colour(c) = entry(c, "rule") eq "variational" ? blue : entry(c, "rule") eq "uniform" ? "#77818C" : "#4A5560"
width(c) = entry(c, "rule") eq "variational" ? 3 : 1.8
dashes(c) = entry(c, "rule") eq "from_left" ? 2 : 1
points(c) = entry(c, "rule") eq "variational" ? 7 : entry(c, "rule") eq "uniform" ? 5 : entry(c, "rule") eq "imposed" ? 11 : 10
name_of(c) = entry(c, "rule") eq "uniform" ? "equal steps" : entry(c, "rule") eq "variational" ? "varied with the action"\
    : entry(c, "rule") eq "imposed" ? "imposed" : "from the last node"
magnitude(low, high) = abs(low) > abs(high) ? abs(low) : abs(high)
steps = entry(distinct("step_control_energy", "steps_per_period", ellipse, ""), "steps_per_period")
# The value of a curve at an x, as text; empty if there is none.
value_at(table_name, c, x, at, y) = system(rows_awk("-v where=".ellipse.",".c.",".x."=".at." -v need=".(y[1:6] eq "energy" ? "''" : y)\
    ." -v fields=".y, table_name))
larger(low, high) = strlen(low) * strlen(high) == 0 ? "" : sprintf("%g", magnitude(number(low), number(high)))
energy_at(c, period) = larger(value_at("step_control_energy", c, "period", period, "energy_smallest"),\
    value_at("step_control_energy", c, "period", period, "energy_largest"))
# To be evaluated: the name of a curve above or below a place of it, by a factor.
name_at(text, x, y, factor, side, colour) = strlen(y) == 0 ? "" : sprintf(\
    "set label \"%s\" at first %g, first %g %s font ',12' textcolor rgb '%s'", text, x, abs(number(y)) * factor, side, colour)
stats rows("step_control_energy", ellipse, "") using "period" name "P" nooutput
stats rows("step_control", ellipse, "state_error") using "steps_per_period" name "S" nooutput
stats rows("step_control_transfer", ellipse, "cost_error") using "intervals" name "N" nooutput
far = sprintf("%d", P_max)
# Powers of two between the first and the last, as ticks.
twos(first, last) = first > last ? "" : sprintf("%d", first).(2 * first > last ? "" : ", ").twos(2 * first, last)

do for [kind in kinds] {
  eval begin_figure(kind, "step_control", 400)
  figure_title = title_text("DMOC with steps that follow the trajectory, on ellipses of eccentricity 0.8",\
      "Paper: section 5. Steps are equal or proportional to the power 3/2 of |q|:", "varied with the action, imposed, or taken"\
      ." from the last node.")
  eval title_above
  unset key; unset label
  eval power_axis("y"); unset mytics; set ylabel ""
  # -- energy
  eval place(62, 292, 75, top_of_panels(figure_title) - 10)
  unset logscale x; set xrange [0:P_max + 1]; set xtics few_ticks(P_max); set format x "%g"; set yrange [*:*]
  set xlabel "period"; set title "energy error [GM/a], ".steps." steps each" offset 0, -0.5 font ",13"
  do for [c in choices] {
    eval name_at(name_of(c), 0.985 * (P_max + 1), energy_at(c, far),\
        entry(c, "rule") eq "from_left" || entry(c, "rule") eq "variational" ? 0.45 : 1.75, "right", colour(c))
  }
  plot for [c in choices] rows("step_control_energy", ellipse.",".c, "") using (column("period") + 1):(magnitude(column("energy_smallest"), column("energy_largest")))\
       with lines linecolor rgb colour(c) linewidth width(c) dashtype dashes(c)
  unset label
  # -- state
  eval place(350, 522, 75, top_of_panels(figure_title) - 10)
  set logscale x 2; eval "set xtics (".twos(S_min, S_max).")"; set xrange [S_min / 1.15:S_max * 1.15]
  set xlabel "steps per period"; set title "state error after a period" offset 0, -0.5 font ",13"
  first = sprintf("%d", S_min); last = sprintf("%d", S_max)
  eval name_at("equal steps", S_max, value_at("step_control", "rule=uniform", "steps_per_period", last, "state_error"), 2.5, "right", colour("rule=uniform"))
  eval name_at("imposed,\\nlast node", S_min, value_at("step_control", "rule=imposed", "steps_per_period", first, "state_error"), 0.27, "left", colour("rule=imposed"))
  eval name_at("varied", S_min, value_at("step_control", "rule=variational", "steps_per_period", first, "state_error"), 0.25, "left", colour("rule=variational"))
  plot for [c in choices] rows("step_control", ellipse.",".c, "state_error") using "steps_per_period":"state_error"\
       with linespoints linecolor rgb colour(c) linewidth width(c) dashtype dashes(c) pointtype points(c) pointsize 0.5
  unset label
  # -- cost
  eval place(582, 754, 75, top_of_panels(figure_title) - 10)
  eval "set xtics (".twos(N_min, N_max).")"; set xrange [N_min / 1.15:N_max * 1.15]; set ytics 100
  set xlabel "intervals N"; set title "relative error of the cost" offset 0, -0.5 font ",13"
  first = sprintf("%d", N_min); last = sprintf("%d", N_max)
  eval name_at("equal steps", N_max, value_at("step_control_transfer", "rule=uniform", "intervals", last, "cost_error"), 90, "right", colour("rule=uniform"))
  eval name_at("imposed", N_max, value_at("step_control_transfer", "rule=imposed", "intervals", last, "cost_error"), 14, "right", colour("rule=imposed"))
  eval name_at("varied", N_min, value_at("step_control_transfer", "rule=variational", "intervals", first, "cost_error"), 0.05, "left", colour("rule=variational"))
  plot for [c in transfers] rows("step_control_transfer", ellipse.",".c, "cost_error") using "intervals":"cost_error"\
       with linespoints linecolor rgb colour(c) linewidth width(c) dashtype dashes(c) pointtype points(c) pointsize 0.5
  unset label
  unset multiplot
  eval end_figure(kind, "step_control")
}
