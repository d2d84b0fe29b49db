# For the checks of whole programs: `bin` (the folder of the binaries, first argument), `place` (an empty folder that goes at
# the end), `complain` (notes a failure and goes on), `verdict` (ends the check).
# shellcheck shell=bash
set -euo pipefail

bin=$(cd "$1" && pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place"

complaints=0
complain() {
  echo "FAILED: $*"
  complaints=$((complaints + 1))
}
verdict() { exit $((complaints > 0)); }

# Whether the suite was built with its extensions.
has_extensions() { [[ -x $bin/primitives ]]; }

# The values of a column of a CSV file; texts in quotes count as fields, but their content is dropped.
column() { # column FILE NAME
  sed 's/"[^"]*"//g' "$1" | awk -F, -v name="$2" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i; next } { print $c }'
}

# Fails unless every row of a CSV file is whole: as many fields as the header, the last line ended.
is_whole_table() {
  [[ -z $(tail -c 1 "$1") ]] && sed 's/"[^"]*"//g' "$1" | awk -F, 'NR == 1 { n = NF } NF != n { exit 1 }'
}
