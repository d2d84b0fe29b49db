# Step sizes tied to the motion along ellipses of eccentricity 0.8: the energy over many periods, errors of a period, and
# the error of the optimal cost of a transfer.
#   gnuplot -e "results='results'" plots/step_control.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("step_control_energy", "eccentricity,rule,stages,steps_per_period,period,energy_smallest,energy_largest")
eval require("step_control_transfer", "eccentricity,rule,stages,intervals,status,cost_error")
eval require("step_control", "eccentricity,rule,sigma,stages,steps_per_period,status,state_error")

ellipse = "eccentricity=0.8,stages=1"
choices = distinct("step_control_energy", "rule,sigma", ellipse, "")
transfers = distinct("step_control_transfer", "rule,sigma", ellipse, "cost_error")
colour(choice) = entry(choice, "rule") eq "variational" ? blue : entry(choice, "rule") eq "imposed" ? vermilion\
    : entry(choice, "rule") eq "from_left" ? green : grey
dashes_of(choice) = entry(choice, "rule") eq "from_left" ? 2 : 1
choice_label(choice) = entry(choice, "rule") eq "uniform" ? "uniform steps"\
    : entry(choice, "rule") eq "variational" ? "h = Δτ σ inside the principle"\
    : entry(choice, "rule") eq "imposed" ? "h = Δτ σ outside of it" : "h = Δτ σ(q_k), known before the step"
magnitude(low, high) = abs(low) > abs(high) ? abs(low) : abs(high)
steps = entry(distinct("step_control_energy", "steps_per_period", ellipse, ""), "steps_per_period")

do for [kind in kinds] {
  eval begin_figure(kind, "step_control", 940)
  figure_title = title_text("DMOC (one Gauss stage) with steps proportional to σ along ellipses of eccentricity 0.8",\
      "Paper: section 5, “Adaptive Time Steps”. σ is the power 3/2 of the distance |q|. All choices take equally many steps. Energies in units of GM/a, a the semi-major axis.",\
      "The transfer leads from an ellipse to one that is 1.2 times as large, with the least control effort.")
  eval title_above
  eval place(100, 745, 505, top_of_panels(figure_title))
  set key at screen 0.02, screen upwards(370) left bottom vertical maxrows 2 width -3 samplen 2 font ",15"
  set autoscale
  unset logscale
  set xrange [*:*]
  eval power_axis("xy")
  set xlabel "period"
  set ylabel "largest |E − E_0| of a period [GM/a]" offset inwards
  set title "unforced motion, ".steps." steps per period"
  plot for [choice in choices] rows("step_control_energy", ellipse.",".choice, "")\
       using (column("period") + 1):(magnitude(column("energy_smallest"), column("energy_largest")))\
       with lines linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) title choice_label(choice)
  unset key
  eval place(100, 415, 80, 330)
  unset logscale x
  set logscale x 2
  set xtics (32, 64, 128, 256, 512)
  set format x '%g'
  set xrange [56:580]
  set xlabel "steps per period"
  set ylabel "largest error of (q, v)" offset inwards
  set title "the first period of the same motion"
  plot for [choice in choices] rows("step_control", ellipse.",".choice, "state_error")\
       using "steps_per_period":"state_error"\
       with linespoints linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) pointtype 7 pointsize 0.7
  eval place(505, 745, 80, 330)
  set xrange [28:290]
  set xlabel "number of intervals N"
  set ylabel "|J − J*| / J*" offset inwards
  set title "optimal transfer"
  plot for [choice in transfers] rows("step_control_transfer", ellipse.",".choice, "cost_error")\
       using "intervals":"cost_error"\
       with linespoints linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) pointtype 7 pointsize 0.7
  unset multiplot
  eval end_figure(kind, "step_control")
}
