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
    "problem,method,tableau,stages,intervals,starts,solved,unsolved,unconfirmed,best,share,share_lower,share_upper")

most_minima = 8
share_field(where, column) = entry(distinct(shares, column, where, ""), column)
# "Hamiltonian collocation" in two lines, and how many of its starts were solved.
two_lines(label) = strstrt(label, " ") > 0\
    ? label[1:strstrt(label, " ") - 1]."\n".label[strstrt(label, " ") + 1:*] : label."\n"
method_tic(where, method) = sprintf("%s\n%s of %s", two_lines(method_label(method)),\
    share_field(where.",method=".method, "solved"), share_field(where.",method=".method, "starts"))
minimum_tic(where, is_best) = system("printf %.4g ".entry(distinct(minima, "objective", where, ""), "objective"))\
    .(is_best ? "\n{/:Bold best}" : "\n")
values_of(found, column) = words(found) == 0 ? "" : system("echo '".found."' | sed 's/".column."=//g'")

do for [group in distinct(minima, "problem,tableau,stages,intervals", "", "")] {
  problem = entry(group, "problem")
  grids = words(distinct(minima, "tableau,stages,intervals", "problem=".problem, ""))
  figure = problem."_local_minima".(grids == 1 ? "" : sprintf("_%s_%s_%s",\
      entry(group, "tableau"), entry(group, "stages"), entry(group, "intervals")))
  methods = ""
  do for [method_word in distinct(shares, "method", group, "")] { methods = methods." ".entry(method_word, "method") }
  count = words(methods)
  # Confirmed minima by their cost, the best first; then the solutions that are too coarse, and the unsolved starts.
  numbers = values_of(distinct(minima, "minimum", group.",is_motion=yes", ""), "minimum")
  found = words(numbers)
  drawn = found < most_minima ? found : most_minima
  highest = 0
  do for [method in methods] {
    unset logscale; set autoscale
    if (drawn > 0) {
      stats rows(minima, group.",is_motion=yes", "") using (column("minimum") <= int(word(numbers, drawn))\
          ? column(method) : NaN) name 'S' nooutput
      if (S_max > highest) { highest = S_max }
    }
    do for [rest in "unconfirmed unsolved"] {
      count_of_rest = int(share_field(group.",method=".method, rest))
      if (count_of_rest > highest) { highest = count_of_rest }
    }
  }
  bar = 0.8 / count
  place_in(list, text) = sum [k = 1:words(list)] (word(list, k) eq text ? k : 0)
  x_of(minimum, i) = place_in(numbers, sprintf("%d", minimum)) > 0 && place_in(numbers, sprintf("%d", minimum)) <= drawn\
      ? place_in(numbers, sprintf("%d", minimum)) + (i - 0.5 * (count + 1)) * bar : NaN
  x_of_rest(rest, i) = drawn + (rest eq "unconfirmed" ? 1 : 2) + (i - 0.5 * (count + 1)) * bar
  do for [kind in kinds] {
    eval begin_figure(kind, figure, 860)
    figure_title = title_text(problem_label(problem).": minima reached from the guess and perturbed guesses",\
        paper_note(problem, "section 4.1").sprintf("Cold starts (the guess and perturbed guesses) by %s; tolerance %s; N = %s.%s",\
        solver_label(entry(word(distinct(shares, "solver", group, ""), 1), "solver")), told("local_minima", "tolerance"), entry(group, "intervals"), found > drawn\
            ? sprintf(" The %d lowest of %d confirmed minima.", drawn, found) : ""),\
        "Unconfirmed: too coarse (integrating each interval misses the next node).")
    eval title_above
    eval place(90, 755, 425, top_of_panels(figure_title) - 15)
    set xtics nomirror scale 0 () font ",13"
    do for [i = 1:drawn] {
      set xtics add (minimum_tic(group.",minimum=".word(numbers, i), i == 1) i)
    }
    set xtics add ("un-\nconfirmed" drawn + 1, "not solved,\nor too coarse" drawn + 2)
    set arrow 1 from first drawn + 0.5, graph 0 to first drawn + 0.5, graph 1 nohead linecolor rgb grey dashtype (4, 4)
    if (highest < 10) { set ytics nomirror 1 } else { set ytics nomirror autofreq }
    set grid noxtics ytics
    set format y "%g"
    set xrange [0.5:drawn + 2.5]
    set yrange [0:1.1 * highest]
    set xlabel axis_label("cost J of the confirmed minimum", problem, "cost_unit") offset 0, -0.7
    set ylabel "starts that ended there"
    set key at graph 0.5, graph 1.02 center bottom vertical maxrows 1 width -2 samplen 2 font ",12"
    set style fill solid 1.0 noborder
    plot for [i = 1:count] rows(minima, group, "")\
           using (x_of(column("minimum"), i)):(column(word(methods, i))):(0.9 * bar)\
           with boxes linecolor rgb method_colour(word(methods, i)) title method_label(word(methods, i)),\
         for [i = 1:count] rows(minima, group, "")\
           using (x_of(column("minimum"), i)):(column(word(methods, i))):\
           (sprintf("%d", column(word(methods, i)))) with labels offset 0, 0.6 font ",12" notitle,\
         for [i = 1:count] for [rest in "unconfirmed unsolved"] rows(shares, group.",method=".word(methods, i), "")\
           using (x_of_rest(rest, i)):(column(rest)):(0.9 * bar)\
           with boxes fillcolor rgb method_colour(word(methods, i)) dashtype 1\
           fillstyle pattern 5 border rgb method_colour(word(methods, i)) notitle,\
         for [i = 1:count] for [rest in "unconfirmed unsolved"] rows(shares, group.",method=".word(methods, i), "")\
           using (x_of_rest(rest, i)):(column(rest)):(sprintf("%d", column(rest))) with labels offset 0, 0.6 font ",12"\
           notitle
    unset arrow 1

    eval place(90, 755, 115, 300)
    set xtics nomirror scale 0 () font ",12"
    do for [i = 1:count] { set xtics add (method_tic(group, word(methods, i)) i) }
    set xrange [0.5:count + 0.5]
    set yrange [0:1]
    set ytics 0, 0.2, 1; set format y "%.1f"
    set xlabel "starts solved; bars: 95 % intervals" offset 0, -1.3
    set ylabel "share in the best"
    unset key
    plot for [i = 1:count] rows(shares, group.",method=".word(methods, i), "")\
           using (i):(column("share")):(column("share_lower")):(column("share_upper")) with yerrorbars\
           linecolor rgb method_colour(word(methods, i)) linewidth 2 dashtype 1\
           pointtype method_points(word(methods, i)) pointsize 1.2
    unset multiplot
    set ytics autofreq
    eval end_figure(kind, figure)
  }
}
