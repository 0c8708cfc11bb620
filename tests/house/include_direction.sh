#!/usr/bin/env bash
# include_direction.sh ROOT: fails, naming the lines, if a room or its tests include a room to the right of it.
set -u
cd "$1" || exit 1
rooms=(scalars mechanics analyses studies reports commands)
status=0
for i in "${!rooms[@]}"; do
  room=${rooms[$i]}
  folders=()
  for folder in "$room" "tests/$room"; do [ ! -d "$folder" ] || folders+=("$folder"); done
  for right in "${rooms[@]:$((i + 1))}"; do
    [ ${#folders[@]} -gt 0 ] || continue
    if grep -rnE "^ *# *include +[\"<](\.\./|gamut/)*$right/" --include='*.[hc]*' --include='*.ipp' "${folders[@]}"; then
      echo "$room includes $right, a room to its right"
      status=1
    fi
  done
done
exit $status
