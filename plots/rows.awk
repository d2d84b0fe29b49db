# Picks from a result table what a figure may draw. Columns are known by name; text in double quotes is dropped first.
#   awk -f rows.awk [-v where=problem=a,method=b] [-v need=column] [-v without=column] TABLE
#       the header and the rows that were solved on the same branch, meet every condition of `where`, have a value above
#       zero in `need` and an empty field in `without`
#   awk -f rows.awk -v take=unsolved ... TABLE       (or take=all)
#       the same of the rows that were tried and not solved, or of both
#   awk -f rows.awk -v take=coarse ... TABLE         (or take=drawn)
#       the same of the rows whose answer is too coarse to be a motion, or of the solved rows and these
#   awk -f rows.awk -v branches=any ... TABLE
#       the same whatever the branch, for tables that tell none
#   awk -f rows.awk -v distinct=problem,method ... TABLE
#       of those rows, the distinct values: words such as problem=a,method=b, which serve as `where` again
#   awk -f rows.awk -v missing=step,state_error TABLE
#       the first of these columns that the table lacks
BEGIN {
  FS = ","
  conditions = split(where, condition, ",")
  keys = split(distinct, key, ",")
}

# Words of a table become parts of commands that gnuplot gives to a shell: what means something there is no part of a name.
{ gsub(/"[^"]*"/, ""); gsub(/[/`'$\\"();|&<>]/, "_") }

NR == 1 {
  for (i = 1; i <= NF; ++i) position[$i] = i
  count = split(missing, wanted, ",")
  for (i = 1; i <= count; ++i) {
    if (wanted[i] in position) continue
    print wanted[i]
    exit
  }
  if (missing != "") exit
  if (distinct == "") print
  next
}

{
  coarse = "status" in position && $position["status"] == "too coarse"
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
  if (distinct == "") {
    print
    next
  }
  word = ""
  for (i = 1; i <= keys; ++i) word = word (i > 1 ? "," : "") key[i] "=" $position[key[i]]
  if (!(word in seen)) print word
  seen[word] = 1
}
