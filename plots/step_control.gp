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
  eval begin_figure(kind, "step_control", 1500, 620)
  set multiplot layout 1, 3 title title_text(\
      "DMOC (one Gauss stage) with steps proportional to σ = |{/:Italic q}|^{3/2} along ellipses of eccentricity 0.8",\
      "All choices take equally many steps. Energies in units of GM/a, a the semi-major axis.",\
      "The transfer leads from an ellipse to one that is 1.2 times as large, with the least control effort.")\
      offset 0, -0.4 margins 0.06, 0.985, 0.2, 0.78 spacing 0.085
  eval key_below
  set autoscale
  unset logscale
  eval power_axis("xy")
  set xlabel "period"
  set ylabel "largest |E − E_0| of a period [GM/a]"
  set title "unforced motion, ".steps." steps per period"
  plot for [choice in choices] rows("step_control_energy", ellipse.",".choice, "")\
       using (column("period") + 1):(magnitude(column("energy_smallest"), column("energy_largest")))\
       with lines linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) title choice_label(choice)
  unset key
  unset logscale x
  set logscale x 2
  set xtics (32, 64, 128, 256, 512)
  set format x '%g'
  set xrange [56:580]
  set xlabel "steps per period"
  set ylabel "largest error of (q, v)"
  set title "the first period of the same motion"
  plot for [choice in choices] rows("step_control", ellipse.",".choice, "state_error")\
       using "steps_per_period":"state_error"\
       with linespoints linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) pointtype 7 pointsize 0.7
  set xrange [28:290]
  set xlabel "number of intervals N"
  set ylabel "|J − J*| / J*"
  set title "optimal transfer"
  plot for [choice in transfers] rows("step_control_transfer", ellipse.",".choice, "cost_error")\
       using "intervals":"cost_error"\
       with linespoints linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) pointtype 7 pointsize 0.7
  unset multiplot
  eval end_figure(kind, "step_control")
}
