#!/usr/bin/env bash
# functions.sh ROOT: functions of the product have 60 lines at most, as clang-format lays them out: from the line on which
# one begins to the brace in that column that ends it. Fails, naming those that are longer.
set -euo pipefail
cd "$1"
# Longer, since each is one table: of an expression's kinds, of a joint's passes, of a tape's operations.
known=" Expression::dimension Expression::evaluate articulatedAccelerations runBlock "
rooms=$(ls -d scalars mechanics analyses studies reports commands python 2>/dev/null || true)
found=$(find $rooms -name '*.[ch]pp' | sort | xargs awk '
  FNR == 1 { began = 0; head = "" }
  began && index($0, indent "}") == 1 {
    if (FNR - began + 1 > 60) print FILENAME ":" began ": " name " has " FNR - began + 1 " lines"
    began = 0
  }
  !began && /^ ? ?[A-Za-z~\[]/ { head = $0; start = FNR; match($0, /^ */); column = RLENGTH }
  !began && head != "" && /\{$/ {
    if (head ~ /\(/ && head !~ /^ *(namespace|class|struct|enum|union) / || $0 ~ /\) (const |noexcept |override |final )*\{$/) {
      began = start; indent = substr("  ", 1, column)
      name = head; sub(/\(.*/, "", name); sub(/^.*[ *&]/, "", name); gsub(/<[^>]*>/, "", name)
    }
    head = ""
  }')
wrong=0
while read -r place name rest; do
  [ -n "$place" ] || continue
  [[ "$known" != *" $name "* ]] || continue
  echo "$place $name $rest"
  wrong=1
done <<<"$found"
[ $wrong = 0 ] || { echo "functions have 60 lines at most"; exit 1; }
