# Which local minima the methods end in from many perturbed guesses, and how often in the best: "Global Minima",
# section 4.1.
#   gnuplot -e "results='results'" plots/local_minima.gp
# Reads local_minima_minima.csv and local_minima_shares.csv.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
minima = "local_minima_minima"
shares = "local_minima_shares"
eval require(minima, "problem,tableau,stages,intervals,minimum,objective,is_best,is_motion")
eval require(shares,\
    "problem,method,tableau,stages,intervals,starts,solved,best,share,share_lower,share_upper")

most_minima = 8
colour(method) = word(blue." ".vermilion." ".green." ".purple, method_style(method))
share_field(where, column) = entry(distinct(shares, column, where, ""), column)
# "Hamiltonian collocation" in two lines, and how many of its starts were solved.
two_lines(label) = strstrt(label, " ") > 0\
    ? label[1:strstrt(label, " ") - 1]."\n".label[strstrt(label, " ") + 1:*] : label."\n"
method_tic(where, method) = sprintf("%s\n%s of %s", two_lines(method_label(method)),\
    share_field(where.",method=".method, "solved"), share_field(where.",method=".method, "starts"))
# An answer whose intervals do not join is no motion, or one that the grid is too coarse for.
minimum_tic(where, number, best) = system("printf %.4g ".entry(distinct(minima, "objective", where, ""), "objective"))\
    .(number == best ? "\n{/:Bold best}"\
      : entry(distinct(minima, "is_motion", where, ""), "is_motion") eq "no" ? "\nno motion" : "\n")

do for [group in distinct(minima, "problem,tableau,stages,intervals", "", "")] {
  problem = entry(group, "problem")
  grids = words(distinct(minima, "tableau,stages,intervals", "problem=".problem, ""))
  figure = problem."_local_minima".(grids == 1 ? "" : sprintf("_%s_%s_%s",\
      entry(group, "tableau"), entry(group, "stages"), entry(group, "intervals")))
  methods = ""
  do for [method_word in distinct(shares, "method", group, "")] { methods = methods." ".entry(method_word, "method") }
  count = words(methods)
  found = words(distinct(minima, "minimum", group, ""))
  drawn = found < most_minima ? found : most_minima
  best_word = distinct(minima, "minimum", group.",is_best=yes", "")
  best = strlen(best_word) > 0 ? int(entry(best_word, "minimum")) : 0
  highest = 0
  do for [method in methods] {
    unset logscale; set autoscale
    stats rows(minima, group, "") using (column("minimum") <= drawn ? column(method) : NaN) name 'S' nooutput
    if (S_max > highest) { highest = S_max }
  }
  bar = 0.8 / count
  x_of(minimum, i) = minimum <= drawn ? minimum + (i - 0.5 * (count + 1)) * bar : NaN
  do for [kind in kinds] {
    eval begin_figure(kind, figure, 1300, 600)
    set multiplot title title_text(problem_label(problem).": where the methods end from perturbed guesses", "",\
        sprintf("N = %s.%s", entry(group, "intervals"), found > drawn\
            ? sprintf(" The %d lowest of %d distinct minima.", drawn, found) : ""))\
        offset 0, -0.4

    set lmargin at screen 0.065; set rmargin at screen 0.64; set tmargin at screen 0.79; set bmargin at screen 0.19
    set xtics nomirror scale 0 () font ",13"
    do for [i = 1:drawn] {
      set xtics add (minimum_tic(group.",minimum=".i, i, best) i)
    }
    set ytics nomirror; set grid noxtics ytics
    set format y "%g"
    set xrange [0.5:drawn + 0.5]
    set yrange [0:1.1 * highest]
    set xlabel axis_label("cost J of the minimum", problem, "cost_unit") offset 0, -0.7
    set ylabel "starts that ended there"
    set key at graph 0.5, graph 1.02 center bottom vertical maxrows 2 width -2 font ",12"
    set style fill solid 1.0 noborder
    plot for [i = 1:count] rows(minima, group, "")\
           using (x_of(column("minimum"), i)):(column(word(methods, i))):(0.9 * bar)\
           with boxes linecolor rgb colour(word(methods, i)) title method_label(word(methods, i)),\
         for [i = 1:count] rows(minima, group, "")\
           using (x_of(column("minimum"), i)):(column(word(methods, i))):\
           (sprintf("%d", column(word(methods, i)))) with labels offset 0, 0.6 font ",11" notitle

    set lmargin at screen 0.725; set rmargin at screen 0.985
    set xtics nomirror scale 0 () font ",12"
    do for [i = 1:count] { set xtics add (method_tic(group, word(methods, i)) i) }
    set xrange [0.5:count + 0.5]
    set yrange [0:1]
    set ytics 0, 0.2, 1; set format y "%.1f"
    set xlabel "solved starts" offset 0, -1.3
    set ylabel "share of starts in the best (95 % interval)"
    unset key
    plot for [i = 1:count] rows(shares, group.",method=".word(methods, i), "")\
           using (i):(column("share")):(column("share_lower")):(column("share_upper")) with yerrorbars\
           linecolor rgb colour(word(methods, i)) linewidth 2 dashtype 1 pointtype int(word("7 6 9 5",\
           method_style(word(methods, i)))) pointsize 1.2
    unset multiplot
    set ytics autofreq
    eval end_figure(kind, figure)
  }
}
