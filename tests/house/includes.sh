#!/usr/bin/env bash
# includes.sh ROOT TABLE: holds the includes of the sources below ROOT to the table (includes.txt says how it is read).
# Exit status: 0 all are as the table says, with their number; 1 some are not, each named by file and line with the
# reason; 2 the table cannot be read, or there are no sources.
set -euo pipefail
table=$(readlink -f "$2")
cd "$1"
roots=()
for root in scalars mechanics analyses studies reports commands python include benchmarks tests gamut.cpp; do
  [ ! -e $root ] || roots+=($root)
done
[ ${#roots[@]} -gt 0 ] || { echo "there are no sources in $1"; exit 2; }
# A line of the table for what is not there any more would allow it to whoever takes its name.
whole=$([ "${table#"$PWD"/}" = "$table" ] || echo yes)

grep -rHnE '^[[:space:]]*#[[:space:]]*include' --include='*.[hc]*' --include='*.ipp' "${roots[@]}" |
  awk -v table="$table" -v whole="$whole" '
    function folder(path) { return path ~ "/" ? substr(path, 1, match(path, "/[^/]*$") - 1) : "." }
    function fits(file, place,   name) {
      if (place ~ /\/\*$/) return index(file, substr(place, 1, length(place) - 1)) == 1
      name = file; sub(/\.[^.\/]*$/, "", name)
      return folder(file) == place || name == place || index(name, place "_") == 1
    }
    function placeOf(file,   place, best) {
      best = ""
      for (place in mayInclude) if (length(place) > length(best) && fits(file, place)) best = place
      return best
    }
    # Whether a place is among those listed, by itself or as a part of one.
    function listed(place, list,   n, i, names) {
      n = split(list, names, " ")
      for (i = 1; i <= n; ++i) if (names[i] == place || names[i] ~ /\/\*$/ && fits(place "/", names[i])) return 1
      return 0
    }
    function someFits(file, list,   n, i, names) {
      n = split(list, names, " ")
      for (i = 1; i <= n; ++i) if (fits(file, names[i])) return 1
      return 0
    }
    function begins(header, list,   n, i, names) {
      n = split(list, names, " ")
      for (i = 1; i <= n; ++i) if (index(header, names[i]) == 1) return 1
      return 0
    }
    function isThere(path,   line, status) { status = (getline line < path); close(path); return status >= 0 }
    function wrong(reason) { print at ": " reason; ++offences }
    function stop(reason) { print reason; broken = 1; exit 2 }

    BEGIN {
      while ((status = (getline line < table)) > 0) {
        ++row
        if (line ~ /^#/ || line ~ /^ *$/) continue
        if (line ~ /^\[/) { section = line; continue }
        n = split(line, cell, / *: */)
        if (section == "[directions]" && n == 2) {
          mayInclude[cell[1]] = cell[2]; rowOf[cell[1]] = row
          split(cell[1], part, "/"); ours[part[1]] = 1
        } else if (section == "[libraries]" && n == 3) {
          libraries[++libraryCount] = cell[1]; headers[cell[1]] = cell[2]; users[cell[1]] = cell[3]; rowOf[cell[1]] = row
        } else stop(table ":" row ": this is no line of the table")
      }
      if (status < 0 || row == 0) stop("the table " table " cannot be read")
    }
    {
      split($0, field, ":"); file = field[1]; at = field[1] ":" field[2]
      if (!match($0, /[<"][^>"]+[>"]/)) { wrong("names no header that can be followed"); next }
      quoted = substr($0, RSTART, 1) == "\""; header = substr($0, RSTART + 1, RLENGTH - 2)
      own = file
      if (!(file in seen) && sub(/\.cpp$/, ".hpp", own) && own != header && isThere(own))
        wrong("its own header comes first: no other source proves that this compiles alone")
      ++includes; seen[file]
      from = placeOf(file)
      if (from == "") {
        if (!told[folder(file)]++) wrong("no line of the table says what " folder(file) " may include")
        next
      }
      used[from]

      while (sub(/^(\.\.?\/)/, "", header));
      if (header ~ /^gamut\/[^\/]*$/) header = "include/" header
      sub(/^gamut\//, "", header)
      split(header, part, "/")
      if (part[1] in ours && header ~ "/") {
        to = placeOf(header)
        if (to == "") wrong("no line of the table says what " folder(header) " is")
        else if (to != from && !listed(to, mayInclude[from])) wrong(from " may not include " to)
      } else if (header ~ /^[a-z_0-9]+$/) {  # of the standard library
      } else if (quoted && header !~ "/" && isThere(folder(file) "/" header)) {
      } else if (from !~ /^(tests|benchmarks)/) {
        known = allowed = ""
        for (i = 1; i <= libraryCount; ++i) if (begins(header, headers[libraries[i]])) {
          known = known (known == "" ? "" : " or ") libraries[i]
          if (someFits(file, users[libraries[i]])) allowed = 1
        }
        if (known == "") wrong("no line of the table names the library of " header)
        else if (!allowed) wrong(from " may not include " header " of " known)
      }
    }
    END {
      if (broken) exit 2
      if (whole) {
        for (place in mayInclude) if (!(place in used)) { at = table ":" rowOf[place]; wrong("there is nothing at " place) }
        for (library in users) {
          n = split(users[library], names, " ")
          for (i = 1; i <= n; ++i) {
            there = 0
            for (file in seen) if (fits(file, names[i])) { there = 1; break }
            if (!there) { at = table ":" rowOf[library]; wrong("there is nothing at " names[i]) }
          }
        }
      }
      if (offences) exit 1
      if (!includes) { print "there are no includes"; exit 2 }
      print includes " includes are as the table says"
    }'
