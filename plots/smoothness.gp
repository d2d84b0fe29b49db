# Fitted orders of the state error of DMOC with one and two stages, with and without active bounds: (main_theorem) and its
# remark on control constraints. A mark is the number of stages, so that no legend is needed.
#   gnuplot -e "results='results'" plots/smoothness.gp
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
eval require("smoothness", "situation,active,end,method,stages,reference,intervals,h,state_error")
eval require("smoothness_slopes", "situation,method,stages,quantity,slope,standard_error")

# Situations in groups, the line of each from above; a group begins with a line for its name.
groups = "nothing control state"
group_name(g) = g eq "nothing" ? "no bound is active" : "a bound on the ".g." is active"
total = 0
do for [g in groups] { total = total + 1 + words(distinct("smoothness", "situation,end", "method=dmoc,active=".g, "state_error")) }

field(name, where, column) = system(rows_awk(sprintf("-v where='%s' -v fields=%s", where, column), name))
at(situation, stages) = sprintf("situation=%s,method=dmoc,stages=%d", entry(situation, "situation"), stages)
fit(situation, stages) = field("smoothness_slopes", at(situation, stages).",quantity=state", "slope,standard_error")
# The error on the finest grid, below 1e-9 as round-off.
finest(situation, stages) = system("awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next } \
    $at[\"situation\"] == \"".entry(situation, "situation")."\" && $at[\"method\"] == \"dmoc\" && $at[\"stages\"] == ".stages." && $at[\"status\"] == \"solved\" \
    { if ($at[\"intervals\"] + 0 > n) { n = $at[\"intervals\"] + 0; e = $at[\"state_error\"] } } END { print e < 1e-9 ? \"round-off\" : e }' '".table("smoothness")."'")
shown(e) = e eq "round-off" ? e : sprintf("%.0f·10⁻%s", number(e) / 10**floor(log10(number(e))), exponent(-floor(log10(number(e)))))
name_of(situation) = system("echo '".entry(situation, "situation")."' | sed 's/_bounded//; s/_free_end//; s/two_link/two-link/; s/_/ /g'")\
    .(entry(situation, "end") eq "free" ? ", end free" : "")

stats rows("smoothness", "method=dmoc", "state_error") using "intervals" name "N" nooutput
do for [kind in kinds] {
  eval begin_figure(kind, "smoothness", 500)
  unset key; unset grid; unset border
  unset label
  set title title_text("Order of the state error of DMOC with 1 and 2 Gauss stages",\
      "Paper: section 3.6, order 2s where the optimum is smooth. Marks show the number of stages s.", "") offset 0, 1.2
  set lmargin at screen 0.30; set rmargin at screen 0.72; set tmargin at screen 0.80; set bmargin at screen 0.13
  set xrange [1:5]; set yrange [total + 0.6:0.4]
  set xtics 1, 1, 5; set format x "%g"; unset ytics
  set xlabel "fitted order" offset 0, 0.3
  set arrow 1 from 2, 0.4 to 2, total + 0.6 nohead linecolor rgb "#B8BEC5" linewidth 1.2
  set arrow 2 from 4, 0.4 to 4, total + 0.6 nohead linecolor rgb "#B8BEC5" linewidth 1.2
  set label 900 sprintf("state error at N = %d", N_max) at screen 0.865, graph 1.09 center font ",13" textcolor rgb grey
  set label 902 "1 stage" at screen 0.80, graph 1.03 center font ",13" textcolor rgb grey
  set label 903 "2 stages" at screen 0.93, graph 1.03 center font ",13" textcolor rgb grey
  y = 0; points = "slope,error,line,stages\n"
  do for [g in groups] {
    y = y + 1
    set label group_name(g) at screen 0.02, first y left font ",13" textcolor rgb grey
    do for [s in distinct("smoothness", "situation,active,end", "method=dmoc,active=".g, "state_error")] {
      y = y + 1
      set label name_of(s) at screen 0.285, first y right font ",14"
      do for [stages = 1:2] {
        set label shown(finest(s, stages)) at screen (stages == 1 ? 0.80 : 0.93), first y center font ",13"
        f = fit(s, stages)
        if (words(f) == 2) { points = points.sprintf("%s,%s,%g,%d\n", word(f, 1), word(f, 2), y + (stages == 1 ? -0.21 : 0.21), stages) }
        if (words(f) < 2 && finest(s, stages) ne "round-off") { set label sprintf("%d: no fit", stages) at first 4.1, first y left font ",12" textcolor rgb grey }
      }
    }
  }
  set print $Points; print points; unset print
  plot $Points using 1:3:(2 * $2) with xerrorbars linecolor rgb blue linewidth 1.6 pointtype -1,\
       $Points using 1:3 with points pointtype 7 pointsize 1.5 linecolor rgb "#FFFFFF",\
       $Points using 1:3 with points pointtype 7 pointsize 1.35 linecolor rgb blue,\
       $Points using 1:3:(sprintf("%d", $4)) with labels font "sans-serif:Bold,12" textcolor rgb "#FFFFFF"
  eval end_figure(kind, "smoothness")
}
