# Errors of the state over the step where bounds are active and the optimal control has kinks, compared with smooth optima:
# (main_theorem) and its remark on control constraints.
#   gnuplot -e "results='results'" plots/smoothness.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("smoothness", "situation,active,end,method,stages,reference,h,state_error")
eval require("smoothness_slopes", "situation,method,stages,quantity,slope,standard_error")

situations = distinct("smoothness", "situation,active,end", "method=dmoc", "state_error")
colour(where) = entry(where, "active") eq "nothing" ? blue : entry(where, "active") eq "control" ? vermilion : green
dashes_of(where) = entry(where, "end") eq "free" ? 2 : 1
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
  eval begin_figure(kind, "smoothness", 1200, 840)
  set multiplot layout 1, 2 title title_text(\
      "State error of DMOC over the step, with and without active bounds",\
      "Blue: no bound is active; red: one on the control is, green: one on the state; broken lines: the final state is free.",\
      "Against the closed form where there is one, otherwise against DMOC with s = 2 on 1280 intervals.")\
      offset 0, -0.4 margins 0.075, 0.985, 0.42, 0.84 spacing 0.1
  do for [stages = 1:2] {
    eval power_axis("xy")
    set xtics add (0.003, 0.01, 0.03)
    set format x '%g'
    set yrange [1e-8:1]
    set xlabel "step {/:Italic h}"
    set ylabel "max_k |({/:Italic q}, {/:Italic p})_k − ({/:Italic q}*, {/:Italic p}*)(t_k)|"
    set key at screen (stages == 1 ? 0.05 : 0.54), 0.31 left top Left reverse
    set title sprintf("Gauss, s = %d (order %d where the optimum is smooth)", stages, 2 * stages)
    plot for [where in situations] rows("smoothness", at(where, stages), "state_error") using "h":"state_error"\
           with linespoints linecolor rgb colour(where) linewidth 1.8 dashtype dashes_of(where)\
           pointtype (strstrt(where, "two_link") ? 6 : strstrt(where, "quad") ? 4 : strstrt(where, "beam") ? 9 : 7)\
           pointsize 0.8 title label(where, stages)
  }
  unset multiplot
  eval end_figure(kind, "smoothness")
}
