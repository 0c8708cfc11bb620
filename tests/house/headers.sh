#!/usr/bin/env bash
# headers.sh ROOT COMPILER [FLAG...]: compiles every header below ROOT on its own that no source of its name includes
# first (includes.sh sees to those). What a header includes may stand before it in the same source, as it adds nothing
# that the header does not bring along itself: so a source includes a row of headers, each of which includes those before.
# Exit status: 0 all compile, with their number; 1 some do not, or there are none.
set -euo pipefail
cd "$1"
shift
roots=()
for root in scalars mechanics analyses studies reports commands include; do [ ! -e $root ] || roots+=($root); done

# A row a line: of the headers that are left the one that includes most, before it the one that includes most of those
# which it includes, and so on.
mapfile -t headers < <(find "${roots[@]}" -name '*.hpp')
[ ${#headers[@]} -gt 0 ] || { echo "there are no headers in $PWD"; exit 1; }
rows=$(awk '
  function gather(header, from,   n, i, names) {
    if ((header, from) in brings) return
    brings[header, from]; ++size[header]
    n = split(includes[from], names, " ")
    for (i = 1; i <= n; ++i) gather(header, names[i])
  }
  # The one of the headers left, among those that `of` brings along, which includes most; "" if there is none.
  function greatest(of,   header, best) {
    best = ""
    for (header in left)
      if ((of == "" || (of, header) in brings) && (best == "" || size[header] > size[best] ||
          size[header] == size[best] && header < best)) best = header
    return best
  }
  function isThere(path,   line, status) { status = (getline line < path); close(path); return status >= 0 }
  FNR == 1 {
    header = FILENAME; sub(/^include\//, "", header)
    source = FILENAME; sub(/\.hpp$/, ".cpp", source)
    if (!isThere(source)) left[header]
  }
  /^ *# *include/ && match($0, /[<"][^>"]+[>"]/) {
    includes[header] = includes[header] " " substr($0, RSTART + 1, RLENGTH - 2)
  }
  END {
    for (header in left) gather(header, header)
    while ((header = greatest("")) != "") {
      for (row = ""; header != ""; header = greatest(header)) { row = header " " row; delete left[header] }
      print row
    }
  }' "${headers[@]}")
# Its words: the compiler, its flags, and the row last.
one='printf "#include \"%s\"\n" ${!#} | "${@:1:$#-1}" -x c++ -fsyntax-only -I. -Iinclude -'
xargs -P "$(nproc)" -d '\n' -n 1 bash -c "$one" one "$@" <<<"$rows" || exit 1
echo "$(wc -w <<<"$rows") headers compile on their own"
