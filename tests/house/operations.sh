#!/usr/bin/env bash
# operations.sh ROOT: an elementary function of programs is known to the product by two files alone, one in
# scalars/operations and one in analyses/flow/series/operations. Fails, naming the files, where another names one.
set -euo pipefail
cd "$1"
# Known elsewhere: 1/x is arithmetic, atan2 is found again by its formula of sqrt and atan (scalars/program/angles.cpp),
# what bends or jumps is followed from side to side, and sines and cosines lie on circles (analyses/flow/circles.cpp).
known=" recip sqrt atan abs sign sin "
names=$(sed -nE 's/^ *each\(([a-z0-9]+)\).*/\1/p' scalars/operations/names.hpp)
[ -n "$names" ] || { echo "scalars/operations/names.hpp lists no functions"; exit 2; }
wrong=0 count=0
for name in $names; do
  files=$(grep -rlE "Op::$name\b" --include='*.[hc]pp' scalars mechanics analyses studies reports commands include | sort)
  own=$(grep -E '^(scalars|analyses/flow/series)/operations/' <<< "$files" || true)
  [ "$(wc -l <<< "$own")" = 2 ] || { echo "Op::$name is not in two files of functions:" $own; wrong=1; }
  count=$((count + 1))
  [[ "$known" != *" $name "* ]] || continue
  others=$(grep -vE '^(scalars|analyses/flow/series)/operations/' <<< "$files" || true)
  [ -z "$others" ] || { echo "Op::$name is named by" $others; wrong=1; }
done
[ $wrong = 0 ] && echo "$count functions are known by two files each"
exit $wrong
