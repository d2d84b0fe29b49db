# Errors of the state over the step where bounds are active and the optimal control has kinks, and of smooth optima:
# (main_theorem) and its remark on control constraints.
#   gnuplot -e "results='results'" plots/smoothness.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("smoothness", "situation,active,end,method,stages,reference,h,state_error")
eval require("smoothness_slopes", "situation,method,stages,quantity,slope,standard_error")

situations = distinct("smoothness", "situation,active,end", "method=dmoc", "state_error")
colour(where) = entry(where, "active") eq "nothing" ? blue : entry(where, "active") eq "control" ? vermilion : green
dashes_of(where) = entry(where, "end") eq "free" ? 2 : 1
# Points by the problem, open where a bound is touched only.
points_of(where) = (strstrt(where, "two_link") ? 13 : strstrt(where, "quad") ? 5 : strstrt(where, "beam") ? 9 : 7)\
    - (strstrt(entry(where, "situation"), "touching") > 0 ? 1 : 0)
field(where, column, name) = sprintf("awk -F, -v where='%s' -v column='%s' ' \
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; n = split(where, w, \",\"); next } \
    { for (i = 1; i <= n; ++i) { split(w[i], kv, \"=\"); if ($at[kv[1]] != kv[2]) next } print $at[column] }' '%s'",\
    where, column, table(name))
fitted(where, stages) = sprintf("situation=%s,method=dmoc,stages=%d,quantity=state", entry(where, "situation"), stages)
slope_of_state(where, stages) = system(field(fitted(where, stages), "slope", "smoothness_slopes"))
label(where, stages) = with_slope(system("echo '".entry(where, "situation")."' | tr '_' ' '"),\
    slope_of_state(where, stages) eq "" ? "rounding" : sprintf("slope %.2f", number(slope_of_state(where, stages))))
at(where, stages) = sprintf("situation=%s,method=dmoc,stages=%d", entry(where, "situation"), stages)

do for [kind in kinds] {
  eval begin_figure(kind, "smoothness", 960)
  figure_title = title_text(\
      "State error of DMOC over the step, with and without active bounds",\
      "Paper: section 3.6, main\\_theorem and its remark on control constraints. Blue: no bound is active; orange: one on"\
      ." the control is; green: one on the state is; broken lines: the final state is free.",\
      "Against the closed form where there is one, otherwise against DMOC with s = 2 on 1280 intervals.")
  eval panels(2, 1, 100, 315, 80, 0, 45)
  do for [stages = 1:2] {
    eval power_axis("xy")
    set xtics add (0.003, 0.01, 0.03)
    set format x '%g'
    set yrange [1e-8:1]
    if (stages == 2) { set xlabel "step {/:Italic h}" } else { set xlabel ""; set format x "" }
    set ylabel "max_k |({/:Italic q}, {/:Italic p})_k − ({/:Italic q}*, {/:Italic p}*)(t_k)|" offset inwards
    set key at graph 1.02, graph 1 left top font ",12" samplen 3
    set title sprintf("Gauss, s = %d (order %d where the optimum is smooth)", stages, 2 * stages)
    plot for [where in situations] rows("smoothness", at(where, stages), "state_error") using "h":"state_error"\
           with linespoints linecolor rgb colour(where) linewidth 1.8 dashtype dashes_of(where)\
           pointtype points_of(where)\
           pointsize 0.8 title label(where, stages)
  }
  unset multiplot
  eval end_figure(kind, "smoothness")
}
