# The motion found by DMOC, one figure per problem: a picture of the motion and its controls over time.
#   gnuplot -e "results='results'" plots/motion.gp
# Reads motion_PROBLEM_{picture,nodes,stages}.csv of every problem, and the same of `solve --name NAME`, whose figure is
# NAME_motion; pictures/PROBLEM.gp draws, or else pictures/any.gp. The motions of the report's gallery are the report's.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
motions = system("cd '".results."' 2>/dev/null &&\
    for nodes in *_nodes.csv; do name=${nodes%_nodes.csv}; case $name in library_motions*|*[!A-Za-z0-9_]*) ;; *)\
    if [ -e ${name}_picture.csv ] && [ -e ${name}_stages.csv ]; then echo $name; fi ;; esac; done")
if (strlen(motions) == 0) { print results."/motion_PROBLEM_nodes.csv is missing"; exit status 1 }

# Colours over time: light at the start, dark at the end.
set palette defined (0 "#9ADBE8", 0.35 "#3FA0CC", 0.7 "#2A5CA8", 1 "#2B1B5E")
# Every how many of `intervals` something is drawn that is to appear about `count` times; the second prefers a divisor,
# so that the last instant is drawn too.
spacing(intervals, count) = intervals > count ? intervals / count : 1
divisor(intervals, n, limit) = n > limit ? 0 : intervals % n == 0 ? n : divisor(intervals, n + 1, limit)
first_of(n, otherwise) = n > 0 ? n : otherwise
even_spacing(intervals, count) = first_of(divisor(intervals, spacing(intervals, count), 2 * spacing(intervals, count)),\
    spacing(intervals, count))

# To be evaluated: axes as they were, a title over two panels, the square panel on the left, a panel on the right.
plain_axes = "unset logscale; set autoscale; set xtics autofreq; set ytics autofreq; set format '%g'; unset colorbox;\
    unset key; set size noratio; unset title; unset lmargin; unset rmargin; unset tmargin; unset bmargin"
begin_panels(title) = "set multiplot title '".title_text(title, "", "")."' offset 0, -0.4"
left_square = "set lmargin at screen 0.125; set rmargin at screen 0.525; set bmargin at screen 0.13;\
    set tmargin at screen 0.9; set size ratio -1"
right_panel(low, high) = sprintf("set size noratio; set lmargin at screen 0.66; set rmargin at screen 0.98;\
    set bmargin at screen %g; set tmargin at screen %g; set xtics autofreq; set ytics autofreq", low, high)

do for [motion in motions] {
  problem = motion[1:7] eq "motion_" ? motion[8:] : motion
  nodes = motion."_nodes"
  stages = motion."_stages"
  picture = motion."_picture"
  # " by DMOC, N = 128", from the row of the solve.
  solve = exists_table(motion) ? word(system(rows_awk("-v take=drawn -v branches=any -v distinct=method,intervals",\
      motion)), 1) : ""
  by_whom = strlen(solve) == 0 ? "" : " by ".method_label(entry(solve, "method")).", N = ".entry(solve, "intervals")
  # Why the solve failed, whose last iterate is drawn with open symbols; empty if it did not.
  status = system(sprintf("awk '/\"nodes\": \"%s_nodes.csv\"/ { found = 1 } found && /\"status\"/ {\
      gsub(/.*: \"|\".*/, \"\"); gsub(/[^A-Za-z ]/, \"\"); print; exit }' '%s/%s.json' 2>/dev/null", motion, results,\
      run_of(motion)))
  failure = status eq "solved" || status eq "solved control not determined" || status eq "too coarse"\
      || status eq "violates between stages" ? "" : strlen(status) == 0 ? "" : "not solved: ".status
  drawing = plots."/pictures/".problem.".gp"
  if (strlen(failure) > 0 || system("test -f '".drawing."' && echo 1") eq "") { drawing = plots."/pictures/any.gp" }
  incomplete = incomplete_run(motion)
  do for [kind in kinds] { load drawing }
}
