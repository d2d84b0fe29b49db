# For awk programs that read our tables: splits a line at commas outside of quotes; returns the number of cells.
function split_line(line, cells,   count, i, character, quoted) {
  count = 1; cells[1] = ""; quoted = 0
  for (i = 1; i <= length(line); ++i) {
    character = substr(line, i, 1)
    if (character == "\"") quoted = !quoted
    if (character == "," && !quoted) cells[++count] = ""
    else cells[count] = cells[count] character
  }
  return count
}
