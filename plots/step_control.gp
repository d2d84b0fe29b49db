# Step sizes tied to the motion along an eccentric Kepler ellipse: the energy over many periods, and errors of a period.
#   gnuplot -e "results='results'" plots/step_control.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("step_control_energy", "eccentricity,rule,sigma,stages,steps_per_period,period,energy_smallest,energy_largest")
eval require("step_control", "eccentricity,rule,sigma,stages,steps_per_period,state_error")

ellipse = "eccentricity=0.8,stages=1"
choices = distinct("step_control_energy", "rule,sigma", ellipse, "")
colour(choice) = entry(choice, "rule") eq "variational" ? blue : entry(choice, "rule") eq "imposed" ? vermilion\
    : entry(choice, "rule") eq "from_left" ? green : grey
dashes_of(choice) = entry(choice, "rule") eq "imposed" ? 2 : 1
choice_label(choice) = entry(choice, "rule") eq "uniform" ? "uniform steps"\
    : entry(choice, "rule") eq "variational" ? "h = Δτ σ inside the principle"\
    : entry(choice, "rule") eq "imposed" ? "h = Δτ σ outside of it" : "h = Δτ σ(q_k), known before the step"
magnitude(low, high) = abs(low) > abs(high) ? abs(low) : abs(high)

do for [kind in kinds] {
  eval begin_figure(kind, "step_control", 1200, 640)
  figure_title = title_text("DMOC with steps proportional to σ = |{/:Italic q}|^{3/2} along an ellipse of eccentricity 0.8",\
      "Simulated, nothing is optimised; all choices take equally many steps in a period.",\
      "Energies in units of GM/a, a the semi-major axis.")
  eval two_panels(0.075)
  eval key_below
  eval power_axis("xy")
  set xlabel "period"
  set ylabel "largest |E − E_0| of a period [GM/a]"
  set title entry(distinct("step_control_energy", "steps_per_period", ellipse, ""), "steps_per_period")." steps per period, energy"
  plot for [choice in choices] rows("step_control_energy", ellipse.",".choice, "")\
       using (column("period") + 1):(magnitude(column("energy_smallest"), column("energy_largest")))\
       with lines linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) title choice_label(choice)
  set logscale x 2
  set xtics (64, 128, 256, 512)
  set format x '%g'
  set xrange [56:580]
  set xlabel "steps per period"
  set ylabel "largest error of (q, v) in a period"
  set title "the first period"
  plot for [choice in choices] rows("step_control", ellipse.",".choice, "state_error")\
       using "steps_per_period":"state_error"\
       with linespoints linecolor rgb colour(choice) linewidth 2 dashtype dashes_of(choice) pointtype 7 pointsize 0.7\
       title choice_label(choice)
  unset multiplot
  eval end_figure(kind, "step_control")
}
