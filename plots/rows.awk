# Picks the rows of a result table that a figure may draw. Columns are found by name; text in double quotes is dropped first.
#   awk -f rows.awk [-v where=problem=a,method=b] [-v need=column] [-v without=column] TABLE
#       the header and the rows that were solved on the same branch, meet every condition of `where`, have a value above
#       zero in `need` and an empty field in `without`
#   awk -f rows.awk -v take=unsolved ... TABLE       (or take=all)
#       the same of the rows that were tried and not solved, or of both
#   awk -f rows.awk -v take=coarse ... TABLE         (or take=drawn)
#       the same of the rows whose answer is not a motion (too coarse, or violating constraints between stages), or of the
#       solved rows and these
#   awk -f rows.awk -v branches=any ... TABLE
#       the same whatever the branch, for tables without one
#   awk -f rows.awk -v distinct=problem,method ... TABLE
#       of those rows, the distinct values: words such as problem=a,method=b, which serve as `where` again
#   awk -f rows.awk -v fields=slope,standard_error ... TABLE
#       of the first of those rows, the fields of some columns with spaces between them
#   awk -f rows.awk -v missing=step,state_error TABLE
#       the first of these columns that the table lacks
# A table may hold rows of one problem with several settings or from several libraries. They are problems of their own
# here: the name of one with settings is followed by them, as in hovercraft_mass_2. The quantities of a sweep, which are the
# columns after `instance`, are no settings of this kind.
BEGIN {
  FS = OFS = ","
  conditions = split(where, condition, ",")
  keys = split(distinct, key, ",")
  chosen = split(fields, field, ",")
  table = ARGV[ARGC - 1]
  while ((getline < table) > 0) {
    clean()
    if (!("problem" in position)) note_columns()
    if (!("problem" in position && "settings" in position)) break
    if (!(($position["problem"], statement()) in stated)) ++statements[$position["problem"]]
    stated[$position["problem"], statement()] = 1
  }
  close(table)
}

# Words of a table become parts of commands that gnuplot gives to a shell: special characters are not part of a name.
# Answers without a determined control are solved for cost and state, which is all but the error of the control.
function clean() {
  sub(/"solved, control not determined"/, need == "control_error" ? "control not determined" : "solved")
  gsub(/"[^"]*"/, "")
  gsub(/[/`'$\\"();|&<>]/, "_")
}
function note_columns(i) { for (i = 1; i <= NF; ++i) position[$i] = i }
# The library and the settings of a row in words.
function statement(words, assignments, count, i, name, settings) {
  count = split($position["settings"], assignments, " ")
  for (i = 1; i <= count; ++i) {
    name = substr(assignments[i], 1, index(assignments[i], "=") - 1)
    if (!("instance" in position && name in position && position[name] > position["instance"])) settings = settings " " assignments[i]
  }
  words = $position["library"] settings
  sub(/^ /, "", words)
  gsub(/[= ]/, "_", words)
  return words
}

{ clean() }

NR == 1 {
  note_columns()
  count = split(missing, wanted, ",")
  for (i = 1; i <= count; ++i) {
    if (wanted[i] in position) continue
    print wanted[i]
    exit
  }
  if (missing != "") exit
  if (distinct fields == "") print
  next
}

"settings" in position && statements[$position["problem"]] > 1 && statement() != "" {
  $position["problem"] = $position["problem"] "_" statement()
}

{
  coarse = "status" in position && ($position["status"] == "too coarse" || $position["status"] == "violates between stages")
  solved = !("status" in position) || $position["status"] == "solved"
  same = branches == "any" || !("branch" in position) || $position["branch"] == "same" || $position["branch"] == ""
}
take == "" && !(solved && same) { next }
take == "drawn" && !((solved || coarse) && same) { next }
take == "coarse" && !(coarse && same) { next }
take == "unsolved" && (solved || $position["status"] == "not run") { next }
take == "all" && solved && !same { next }
need != "" && !(need in position && $position[need] + 0 > 0) { next }
without != "" && without in position && $position[without] != "" { next }

{
  for (i = 1; i <= conditions; ++i) {
    split(condition[i], side, "=")
    if (!(side[1] in position) || $position[side[1]] != side[2]) next
  }
  if (chosen > 0) {
    for (i = 1; i <= chosen; ++i) printf "%s%s", (field[i] in position ? $position[field[i]] : ""), i < chosen ? " " : "\n"
    exit
  }
  if (distinct == "") {
    print
    next
  }
  word = ""
  for (i = 1; i <= keys; ++i) word = word (i > 1 ? "," : "") key[i] "=" $position[key[i]]
  if (!(word in seen)) print word
  seen[word] = 1
}
