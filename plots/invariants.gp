# Energy of an eccentric Kepler orbit over many periods, unforced ("Conservation of a Modified Energy"): DMOC against
# Runge-Kutta methods that are not symplectic, and DMOC's oscillation over the step.
#   gnuplot -e "results='results'" plots/invariants.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("invariants_energy", "problem,method,stages,order,period,energy_smallest,energy_largest")
eval require("invariants_energy_behaviour", "problem,method,stages,order,steps_per_period,oscillation,periods")
eval require("invariants_energy_slopes", "problem,method,tableau,stages,quantity,slope,standard_error")

integrator_label(where) = (entry(where, "method") eq "dmoc" ? "DMOC"\
    : entry(where, "method") eq "radau" ? "Radau IIA (implicit)"\
    : entry(where, "method") eq "explicit_midpoint" ? "explicit midpoint" : "classical Runge-Kutta")\
    .", order ".entry(where, "order")
colour(where) = int(entry(where, "order")) == 2 ? blue : int(entry(where, "order")) == 4 ? vermilion : green
is_dmoc(where) = entry(where, "method") eq "dmoc"
dashes_of(where) = is_dmoc(where) ? 1 : 2
magnitude(low, high) = abs(low) > abs(high) ? abs(low) : abs(high)
few = 20  # periods of the sweep over the step

do for [where in problems_of("invariants_energy", "energy_largest")] {
  problem = entry(where, "problem")
  methods = distinct("invariants_energy", "problem,method,stages,order", where, "")
  dmoc = distinct("invariants_energy_behaviour", "problem,method,stages,order", where.",method=dmoc", "")
  stats rows("invariants_energy", where, "") using (column("period") + 1) name 'P' nooutput
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_energy", 600)
    figure_title = title_text(\
        "Unforced Kepler orbit, eccentricity 0.3: error of the energy", "Paper: section 3.3. Simulated, not optimised.",\
        "Energies in units of GM/a with the semi-major axis a; the Runge-Kutta methods are not symplectic.")
    eval title_above
    eval place(95, 460, 200, top_of_panels(figure_title))
    eval power_axis("xy")
    set xrange [1:P_max]
    set yrange [1e-9:*]
    set xlabel "period"
    set ylabel "largest |E − E_0| of a period [GM/a]" offset inwards
    set key at screen 0.02, screen upwards(120) left top font ",12" samplen 2.5
    set title entry(distinct("invariants_energy", "steps_per_period", where, ""), "steps_per_period")." steps per period"
    plot for [method in methods] rows("invariants_energy", method, "")\
         using (column("period") + 1):(magnitude(column("energy_smallest"), column("energy_largest")))\
         with lines linecolor rgb colour(method) linewidth (is_dmoc(method) ? 2.5 : 1.5) dashtype dashes_of(method)\
         title integrator_label(method)
    eval place(600, 735, 200, top_of_panels(figure_title))
    set title "DMOC, first ten periods"
    set xlabel "step {/:Italic h}"
    set ylabel "max E − min E [GM/a]" offset inwards
    set autoscale
    eval power_axis("xy")
    set xtics ("2π/512" 2 * pi / 512, "" 2 * pi / 256, "2π/128" 2 * pi / 128)
    set xrange [2 * pi / 580:2 * pi / 113]
    set yrange [*:*]
    set key at screen 0.98, screen upwards(120) right top font ",12" samplen 2.5
    plot for [method in dmoc] rows("invariants_energy_behaviour", method, "")\
         using (column("periods") == few ? 2 * pi / column("steps_per_period") : NaN):(column("oscillation"))\
         with linespoints linecolor rgb colour(method) linewidth 2 dashtype 1 pointtype 7 pointsize 0.7\
         title with_slope("order ".entry(method, "order"),\
                          slope("invariants_energy_slopes", method.",tableau=gauss", "oscillation"))
    unset multiplot
    eval end_figure(kind, problem."_energy")
  }
}
