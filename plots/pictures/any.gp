# For problems without a picture of their own: coordinates and controls over time, in the units of the problem as
# solved. Loaded by motion.gp.
eval require(nodes, "t")
eval require(stages, "t")
eval plain_axes
header(name, stop) = system("head -n 1 '".table(name)."' | awk -F, '\
    { gsub(/[\\140\"$()\\;|&<>]/, \"_\"); for (i = 2; i <= NF && $i !~ /^".stop."/; ++i) print $i }'")
coordinates = header(nodes, "v_")
controls = header(stages, " ")
readable(name) = system("echo '".name."' | sed 's/_/ /g'")
stats table(nodes) using (column("t")) name "T" nooutput

eval begin_figure(kind, problem."_motion", 560)
figure_title = title_text(problem_label(problem).": the optimal motion and its controls".by_whom, "", "")
eval panels(1, 2, 75, 12, 60, 75, 0)
set key at graph 0.5, graph 1.05 center horizontal
set xrange [T_min:T_max]
set xlabel "time t"
set ylabel "coordinates"
plot for [i = 1:words(coordinates)] table(nodes) using (column("t")):(column(word(coordinates, i)))\
     with lines linetype i title readable(word(coordinates, i))
set ylabel "controls"
plot for [i = 1:words(controls)] table(stages) using (column("t")):(column(word(controls, i)))\
     with lines linetype i title readable(word(controls, i))
unset multiplot
eval end_figure(kind, problem."_motion")
