# Motions, one figure per problem and run: a picture of the motion, or its coordinates, controls and path constraints over time.
#   gnuplot -e "results='results'" plots/motion.gp
# Reads motion_PROBLEM_{picture,nodes,stages}.csv of every problem, and the same of `solve --name NAME`, whose figure is
# NAME_motion; motions of one problem by several methods share a figure. pictures/PROBLEM.gp draws a single motion, or else
# pictures/any.gp. The motions of the report's gallery are the report's.
plots = system("dirname '".ARG0."'")
load plots."/style.gp"
motions = system("ls '".results."'/*.json >/dev/null 2>&1 && awk -f '".plots."/motions.awk' '".results."'/*.json")
if (strlen(motions) == 0) { print results."/motion_PROBLEM_nodes.csv is missing"; exit status 1 }
split_plus(text) = system("echo '".text."' | tr '+' ' '")

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

do for [described in motions] {
  members = split_plus(entry(described, "members"))
  methods = split_plus(entry(described, "methods"))
  counts = split_plus(entry(described, "intervals"))
  motion = word(members, 1)
  problem = entry(described, "figure")
  nodes = motion."_nodes"
  stages = motion."_stages"
  picture = motion."_picture"
  # " by DMOC, N = 128"; several methods are named below the title.
  by_whom = words(members) > 1 ? "" : " by ".method_label(methods).", N = ".counts
  # Why the solve failed, whose last iterate is drawn with open symbols; empty if it did not.
  status = entry(described, "status")
  failure = status eq "" || status eq "solved" || status eq "solved__control_not_determined" || status eq "too_coarse"\
      || status eq "violates_between_stages" ? "" : "not solved: ".system("echo '".status."' | tr '_' ' '")
  drawing = plots."/pictures/".problem.".gp"
  if (words(members) > 1 || strlen(failure) > 0 || system("test -f '".drawing."' && echo 1") eq "") {
    drawing = plots."/pictures/any.gp"
  }
  incomplete = incomplete_run(motion)
  do for [kind in kinds] { load drawing }
}
