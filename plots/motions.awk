# Lists the figures of motions that the metadata of runs describe, one word each:
#   figure=NAME,problem=PROBLEM,status=STATUS,members=X+Y,methods=dmoc+tangent,intervals=64+64
# X is the motion in X_nodes.csv. Answers for one problem in one run are members of one figure; the last iterate of a solve that
# failed has a figure of its own. Metadata of version 0.1.0 have no status.
#   awk -f motions.awk FOLDER/*.json
function value(line) {
  sub(/^[^:]*: *"?/, "", line)
  sub(/"?,?$/, "", line)
  gsub(/[^A-Za-z0-9_.-]/, "_", line)
  return line
}
function exists(file,   line, found) {
  found = (getline line < file) >= 0
  close(file)
  return found
}
function is_answer(status) { return status == "" || status ~ /^(solved|solved__control_not_determined|too_coarse|violates_between_stages)$/ }
FNR == 1 {
  folder = run = FILENAME
  sub(/[^\/]*$/, "", folder)
  sub(/.*\//, "", run)
  sub(/\.json$/, "", run)
}
/^      "nodes": / { status = ""; name = value($0); sub(/_nodes\.csv$/, "", name) }
/^      "problem": / { problem = value($0) }
/^      "settings": / { settings = value($0) }
/^      "method": / { method = value($0) }
/^      "intervals": / { intervals = value($0) }
/^      "status": / { status = value($0) }
/^    \}/ && name != "" {
  group = is_answer(status) ? run "_" problem " " settings : name
  known = name in seen || name ~ /^library_motions/ || !exists(folder name "_picture.csv") || !exists(folder name "_stages.csv")
  if (!known) {
    seen[name] = 1
    if (!(group in members)) groups[++count] = group
    else several[group] = 1
    plus = group in several ? "+" : ""
    members[group] = members[group] plus name
    methods[group] = methods[group] plus method
    numbers[group] = numbers[group] plus intervals
    problems[group] = problem
    if (statuses[group] == "") statuses[group] = status
  }
  name = ""
}
END {
  for (i = 1; i <= count; ++i) {
    group = groups[i]
    figure = members[group]
    if (group in several) {
      figure = group
      gsub(/ +/, "_", figure)
      sub(/_$/, "", figure)
    }
    sub(/^motion_/, "", figure)
    printf "figure=%s,problem=%s,status=%s,members=%s,methods=%s,intervals=%s\n", figure, problems[group], statuses[group],
      members[group], methods[group], numbers[group]
  }
}
