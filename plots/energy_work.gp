# Energy and modified energy of the midpoint rule ("Conservation of a Modified Energy"): the truncated modified energies
# along free motions, and both energies against the work of the forces along optimal trajectories.
#   gnuplot -e "results='results'" plots/energy_work.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
# Runs about problems of a user have no free motions.
has_free_motions = exists_table("invariants_modified_energy")
if (has_free_motions) {
  eval require("invariants_modified_energy", "problem,method,tableau,stages,h,truncation,drift")
  eval require("invariants_modified_energy_slopes", "problem,method,tableau,stages,quantity,truncation,slope,standard_error")
}
eval require("invariants_energy_work", "problem,method,tableau,stages,h,largest_gap")
eval require("invariants_modified_work", "problem,method,tableau,stages,h,truncation,gap_to_modified_work")
eval require("invariants_energy_work_slopes", "problem,method,tableau,stages,quantity,truncation,slope,standard_error")

truncations = "2 4 6"
colour(truncation) = truncation == 2 ? blue : truncation == 4 ? vermilion : purple
# Curves of tangent-space collocation nearly coincide, so that each has a point of its own.
triangle(truncation) = truncation == 2 ? 8 : truncation == 4 ? 10 : 12
energy_label(truncation) = truncation == 2 ? "H"\
    : truncation == 4 ? "H + h²H₂" : "H + h²H₂ + h⁴H₄"
scheme(problem, method) = "problem=".problem.",method=".method.",tableau=gauss,stages=1"
of_truncation(problem, method, truncation) = scheme(problem, method).",truncation=".truncation
step_tics = "set xtics autofreq; set format x '%g'; set xtics add (0.003, 0.01, 0.03, 0.1, 0.3)"

# One panel of truncated energies: filled discs of DMOC, open triangles of tangent-space collocation.
do for [where in has_free_motions ? problems_of("invariants_modified_energy", "drift") : ""] {
  problem = entry(where, "problem")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_modified_energy", 740)
    set title title_text(problem_label(problem).", no force: range of the modified energy",\
        paper_note(problem, "section 3.3")."Midpoint rule; the series after one, two and three terms.",\
        "One trajectory, simulated in long double; range over its nodes.")
    eval power_axis("xy")
    eval step_tics
    set xlabel "step {/:Italic h}, in the problem's unit of time"
    set ylabel axis_label("max − min over the trajectory", problem, "energy_unit")
    set bmargin at screen 0.33
    set key at screen 0.17, 0.22 left top Left reverse maxrows auto
    plot for [i in truncations] rows("invariants_modified_energy", of_truncation(problem, "dmoc", i), "drift")\
           using "h":"drift" with linespoints linecolor rgb colour(int(i)) linewidth 2.5 dashtype 1 pointtype 7\
           pointsize 0.7 title with_slope("DMOC, ".energy_label(int(i)),\
             slope("invariants_modified_energy_slopes", of_truncation(problem, "dmoc", i), "drift")),\
         for [i in truncations] rows("invariants_modified_energy", of_truncation(problem, "tangent", i), "drift")\
           using "h":"drift" with linespoints linecolor rgb colour(int(i)) linewidth 1.2 dashtype (8, 5)\
           pointtype triangle(int(i)) pointsize 1.2 title with_slope("Tangent-space, ".energy_label(int(i)),\
             slope("invariants_modified_energy_slopes", of_truncation(problem, "tangent", i), "drift"))
    eval end_figure(kind, problem."_modified_energy")
  }
}
unset title
unset bmargin

do for [where in problems_of("invariants_energy_work", "largest_gap")] {
  problem = entry(where, "problem")
  do for [kind in kinds] {
    eval begin_figure(kind, problem."_energy_work", 760)
    figure_title = title_text(problem_label(problem).": energy and the work of the forces along optimal trajectories",\
        paper_note(problem, "section 3.3")."Midpoint rule, each method on its own optimal trajectory; largest difference over the nodes.", "")
    eval panels(1, 2, 85, 15, 265, 85, 0)
    eval power_axis("xy")
    eval step_tics
    set xlabel "step {/:Italic h}, in the problem's unit of time"
    set ylabel axis_label("max_k |change of energy − work|", problem, "energy_unit") offset inwards
    set key at screen 0.02, screen upwards(185) left top maxrows auto font ",12" samplen 2.5
    set title "energy and virtual work"
    plot for [method in paper_families] rows("invariants_energy_work", scheme(problem, method), "largest_gap")\
           using "h":"largest_gap" with linespoints linestyle method_style(method)\
           title with_slope(method_label(method),\
             slope("invariants_energy_work_slopes", scheme(problem, method), "gap"))
    unset ylabel
    set key at screen 0.53, screen upwards(185) left top maxrows auto font ",12" samplen 2.5
    set title "modified energy and modified work"
    plot for [i in truncations] rows("invariants_modified_work", of_truncation(problem, "dmoc", i), "gap_to_modified_work")\
           using "h":"gap_to_modified_work" with linespoints linecolor rgb colour(int(i)) linewidth 2.5 dashtype 1\
           pointtype 7 pointsize 0.7 title with_slope("DMOC, ".energy_label(int(i)),\
             slope("invariants_energy_work_slopes", of_truncation(problem, "dmoc", i), "gap_to_modified_work")),\
         for [i in truncations] rows("invariants_modified_work", of_truncation(problem, "tangent", i),\
           "gap_to_modified_work") using "h":"gap_to_modified_work" with linespoints linecolor rgb colour(int(i))\
           linewidth 1.2 dashtype (8, 5) pointtype triangle(int(i)) pointsize 1.2 title with_slope("Tangent, ".energy_label(int(i)),\
             slope("invariants_energy_work_slopes", of_truncation(problem, "tangent", i), "gap_to_modified_work"))
    unset multiplot
    eval end_figure(kind, problem."_energy_work")
  }
}
