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
# The value at an x of a curve, for its name.
value_at(table_name, c, x, at, y) = number(system(rows_awk("-v where=".ellipse.",".c.",".x."=".at." -v fields=".y, table_name)))
far = 199

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
  unset logscale x; set xrange [0:200]; set xtics 0, 50, 200; set format x "%g"; set yrange [1e-4:1]
  set xlabel "period"; set title "energy error [GM/a], ".steps." steps each" offset 0, -0.5 font ",13"
  do for [c in choices] {
    e = magnitude(value_at("step_control_energy", c, "period", far, "energy_smallest"), value_at("step_control_energy", c, "period", far, "energy_largest"))
    set label name_of(c) at first 197, first e * (entry(c, "rule") eq "from_left" ? 0.3 : 1.75) right font ",12" textcolor rgb colour(c)
  }
  plot for [c in choices] rows("step_control_energy", ellipse.",".c, "") using (column("period") + 1):(magnitude(column("energy_smallest"), column("energy_largest")))\
       with lines linecolor rgb colour(c) linewidth width(c) dashtype dashes(c)
  unset label
  # -- state
  eval place(350, 522, 75, top_of_panels(figure_title) - 10)
  set logscale x 2; set xtics (64, 128, 256, 512); set xrange [56:590]; set yrange [1e-3:20]
  set xlabel "steps per period"; set title "state error after a period" offset 0, -0.5 font ",13"
  set label "equal steps" at first 560, first 8 right font ",12" textcolor rgb colour("rule=uniform")
  set label "imposed,\nlast node" at first 62, first 0.75 left font ",12" textcolor rgb colour("rule=imposed")
  set label "varied" at first 62, first 0.02 left font ",12" textcolor rgb colour("rule=variational")
  plot for [c in choices] rows("step_control", ellipse.",".c, "state_error") using "steps_per_period":"state_error"\
       with linespoints linecolor rgb colour(c) linewidth width(c) dashtype dashes(c) pointtype points(c) pointsize 0.5
  unset label
  # -- cost
  eval place(582, 754, 75, top_of_panels(figure_title) - 10)
  set xtics (32, 64, 128, 256); set xrange [28:300]; set yrange [2e-5:5e4]; set ytics 1e-4, 100, 1e4
  set xlabel "intervals N"; set title "relative error of the cost" offset 0, -0.5 font ",13"
  set label "equal steps" at first 98, first 4e3 left font ",12" textcolor rgb colour("rule=uniform")
  set label "imposed" at first 105, first 0.6 left font ",12" textcolor rgb colour("rule=imposed")
  set label "varied" at first 31, first 0.006 left font ",12" textcolor rgb colour("rule=variational")
  plot for [c in transfers] rows("step_control_transfer", ellipse.",".c, "cost_error") using "intervals":"cost_error"\
       with linespoints linecolor rgb colour(c) linewidth width(c) dashtype dashes(c) pointtype points(c) pointsize 0.5
  unset label
  unset multiplot
  eval end_figure(kind, "step_control")
}
