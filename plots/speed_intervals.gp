# Times of exact derivatives per interval: by every way, over the size of the formulas, and against the peak of the machine.
#   gnuplot -e "results='results'" plots/speed_intervals.gp
# Reads speed.csv and speed_machine.csv (bench/speed/page speed.json --csv results/speed.csv); draws nothing if they are not
# there, or for cases left out of that run.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
if (!exists_table("speed")) { exit }
eval require("speed", "way,quantity,problem,links,method,stages,instruction_set,intervals,nanoseconds,operations_per_byte,\
operations_per_second,roof_share")
eval require("speed_machine", "instruction_set,limit,rate")

programs = distinct("speed", "instruction_set", "way=program", "nanoseconds")
# The set of the program's tapes, and otherwise the last of those that ran.
sets = strlen(programs) > 0 ? programs : distinct("speed", "instruction_set", "way=tape", "nanoseconds")
if (strlen(sets) == 0) { exit }
set_word = word(sets, words(sets))
instruction_set = entry(set_word, "instruction_set")
set_label = instruction_set eq "avx512" ? "AVX-512" : instruction_set eq "avx2" ? "AVX2" : "SSE2"
intervals = entry(word(distinct("speed", "intervals", "", ""), 1), "intervals")
midpoint = "method=dmoc,stages=1,"
here(where, need) = strlen(distinct("speed", "way", where, need)) > 0

# --- Every way, DMOC with the midpoint rule --------------------------------------------------------------------------
quantities = "residual jacobian hessian"
quantity_label(q) = word("residual Jacobian Hessian", q)
quantity_colour(q) = word(green." ".blue." ".vermilion, q)
quantity_marker(q) = int(word("9 7 5", q))
way_count = 6
way_label(w) = word("'by hand' 'tape' 'program' 'replay' 'ADOL-C,\n64 on\na tape' 'ADOL-C,\none by\none'", w)
way_where(w, quantity) = midpoint.(w == 1 ? "way=hand,".set_word : w == 2 ? "way=tape,".set_word\
    : w == 3 ? "way=program,".set_word : w == 4 ? "way=replay" : "way=adolc").\
    ",quantity=".(w == 5 ? quantity."_block" : quantity)
paper = "orbital_transfer two_link_manipulator"
drawn = ""
do for [problem in paper] { if (here("way=tape,problem=".problem, "nanoseconds")) { drawn = drawn." ".problem } }

if (words(drawn) > 0) {
  do for [kind in kinds] {
    eval begin_figure(kind, "speed_ways", 90 + 350 * words(drawn))
    figure_title = title_text("Time of exact derivatives per interval, for every way", "",\
        sprintf("DMOC with the midpoint rule, N = %s, %s, one core; smaller is better.", intervals, set_label))
    eval panels(words(drawn), 1, 90, 15, 100, 0, 45)
    do for [i = 1:words(drawn)] {
      problem = word(drawn, i)
      unset logscale; set autoscale
      eval power_axis("y")
      set format y "%g"
      set xrange [0.5:way_count + 0.5]
      set yrange [0.2:20000]
      unset mxtics
      set xtics () font ",13"
      do for [w = 1:way_count] { set xtics add (i == words(drawn) ? way_label(w) : "" w) }
      set title problem_label(problem) offset 0, -0.5
      set ylabel "time per interval [ns]" offset inwards
      if (i == 1) { set key top left } else { unset key }
      shown = ""
      do for [w = 1:way_count] { do for [q = 1:3] {
        if (here(way_where(w, word(quantities, q)).",problem=".problem, "nanoseconds")) {
          shown = shown.sprintf(" %d", 3 * w + q)
        }
      } }
      plot for [c in shown] rows("speed", way_where((int(c) - 1) / 3, word(quantities, (int(c) - 1) % 3 + 1)).\
               ",problem=".problem, "nanoseconds") using ((int(c) - 1) / 3 + 0.14 * ((int(c) - 1) % 3 - 1)):\
               (column("nanoseconds")) with impulses linecolor rgb quantity_colour((int(c) - 1) % 3 + 1) linewidth 2\
               dashtype 1,\
           for [c in shown] rows("speed", way_where((int(c) - 1) / 3, word(quantities, (int(c) - 1) % 3 + 1)).\
               ",problem=".problem, "nanoseconds") using ((int(c) - 1) / 3 + 0.14 * ((int(c) - 1) % 3 - 1)):\
               (column("nanoseconds")) with points linecolor rgb quantity_colour((int(c) - 1) % 3 + 1)\
               linewidth 1 pointtype quantity_marker((int(c) - 1) % 3 + 1) pointsize 0.9,\
           for [q = 1:3] keyentry with points linecolor rgb quantity_colour(q) pointtype quantity_marker(q)\
               pointsize 0.9 title quantity_label(q)
    }
    unset multiplot
    eval end_figure(kind, "speed_ways")
  }
}

# --- Over the number of links ----------------------------------------------------------------------------------------
chain = "way=program,problem=link_chain,".set_word
methods = distinct("speed", "method", chain, "nanoseconds")
stages = distinct("speed", "stages", chain, "nanoseconds")
colour(i) = method_colour(entry(word(methods, i), "method"))
marker(i) = method_points(entry(word(methods, i), "method"))
stage_dashes = "'1' '(6, 4)' '(2, 3)'"

if (words(methods) > 0) {
  # A line style from text cannot stand in a plot with iteration.
  do for [i = 1:words(methods)] { do for [s = 1:words(stages)] {
    eval sprintf("set linetype %d linecolor rgb '%s' linewidth 1.6 dashtype %s pointtype %d pointsize 0.7",\
        20 + 4 * i + s, colour(i), word(stage_dashes, (s - 1) % 3 + 1), marker(i))
  } }
  do for [kind in kinds] {
    eval begin_figure(kind, "speed_size", 640)
    figure_title = title_text("Time per interval over the size of the problem, by method and stages", "",\
        sprintf("Chain of n links, assembled program, N = %s, %s, one core.", intervals, set_label))
    eval panels(1, 3, 85, 15, 95 + 20 * words(stages), 50, 0)
    do for [q = 1:3] {
      where = chain.",quantity=".word(quantities, q)
      unset logscale; set autoscale
      eval power_axis("y")
      set format y "%g"
      set logscale x 2
      set xrange [1.9:8.4]
      unset mxtics
      set xtics (2, 3, 4, 5, 6, 7, 8) font ",15"
      set format x "%g"
      set title quantity_label(q)
      set xlabel "number of links n"
      set ylabel (q == 1 ? "time per interval [ns]" : "") offset inwards
      unset key
      if (q == 1) { set key at screen 0.01, screen 0.015 left bottom vertical maxrows words(stages) width -6 samplen 2 font ",12" }
      plot for [i = 1:words(methods)] for [s = 1:words(stages)]\
               rows("speed", where.",".word(methods, i).",".word(stages, s), "nanoseconds")\
               using (column("links")):(column("nanoseconds")) with linespoints linetype 20 + 4 * i + s\
               title method_label(entry(word(methods, i), "method")).", s = ".entry(word(stages, s), "stages")
    }
    unset multiplot
    eval end_figure(kind, "speed_size")
  }
}

# --- Roofline --------------------------------------------------------------------------------------------------------
rate_of(limit) = system(rows_awk("-v where=".set_word.",limit=".limit, "speed_machine")." | awk -F, '\
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == \"rate\") c = i } NR == 2 { print $c }'")
levels = ""
do for [level in "l1 l2 l3 memory"] { if (strlen(rate_of(level)) > 0) { levels = levels." ".level } }
if (words(drawn) == 0 || words(levels) == 0 || strlen(rate_of("arithmetic")) == 0) { exit }
peak = number(rate_of("arithmetic"))
array bandwidth[words(levels)]
do for [i = 1:words(levels)] { bandwidth[i] = number(rate_of(word(levels, i))) }
level_label(i) = word(levels, i) eq "memory" ? "memory" : "L".word(levels, i)[2:2]
roof(i, x) = bandwidth[i] * x < peak ? bandwidth[i] * x : peak
roofed = "hand tape program"
roofed_label(w) = word("'by hand' 'tape' 'program'", w)
roofed_marker(w, p) = int(word(p == 1 ? "7 5 9" : "6 4 8", w))  # filled: the first problem
roofed_where(w, p) = midpoint."way=".word(roofed, w).",".set_word.",problem=".word(drawn, p)

do for [kind in kinds] {
  eval begin_figure(kind, "speed_roofline", 680)
  unset logscale; set autoscale; unset title
  eval power_axis("xy")
  set format x "%g"
  set format y "%g"
  set xtics (0.1, 0.2, 0.5, 1, 2, 5)
  set xrange [0.1:5]
  set yrange [1:1.6e-9 * peak]
  set xlabel "operations per byte of inputs and outputs"
  set ylabel "operations per second [10^9/s]"
  set key default inside bottom right vertical maxrows 9 reverse Left samplen 1 noautotitle font ",13"
  set title title_text("Evaluations of an interval below the roofs of the machine", "",\
      sprintf("DMOC with the midpoint rule, N = %s (arrays fit L2), %s, one core; a sine counts as one operation.",\
      intervals, set_label))
  do for [i = 1:words(levels)] {
    above = word(levels, i) eq "memory" ? 1.45e-9 : 1.22e-9  # a long word on a rising line
    set label i level_label(i) at 0.105, above * roof(i, 0.105) left font ",13" textcolor rgb grey front
  }
  set label 10 "multiply-add on registers" at 4.8, 1.18e-9 * peak right font ",13" textcolor rgb grey front
  plot for [i = 1:words(levels)] 1e-9 * roof(i, x) with lines linecolor rgb grey dashtype 1\
           linewidth (word(levels, i) eq "l2" ? 2.5 : 1.2),\
       for [w = 1:3] for [p = 1:words(drawn)] for [q = 1:3]\
           rows("speed", roofed_where(w, p).",quantity=".word(quantities, q), "roof_share")\
           using (column("operations_per_byte")):(1e-9 * column("operations_per_second"))\
           with points linecolor rgb quantity_colour(q) linewidth 1.5 pointtype roofed_marker(w, p) pointsize 1.1,\
       for [w = 1:3] for [p = 1:words(drawn)] keyentry with points linecolor rgb "#202020" linewidth 1.5\
           pointtype roofed_marker(w, p) pointsize 1.1 title roofed_label(w).", ".problem_label(word(drawn, p)),\
       for [q = 1:3] keyentry with points linecolor rgb quantity_colour(q) pointtype 7 pointsize 1.1 title quantity_label(q)
  eval end_figure(kind, "speed_roofline")
}
