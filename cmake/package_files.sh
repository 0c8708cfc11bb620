#!/usr/bin/env bash
# package_files.sh GAMUT CHANGELOG MAINTAINER FOLDER: man pages, one of the program and one a command, completions of shells
# and changelogs, all in the folder.
set -euo pipefail
gamut=$1 changelog=$2 maintainer=$3 folder=$4
page() {  # page NAME MEANING PROGRAM
  help2man --no-info --section=1 --version-string="$("$gamut" --version | sed 's/gamut //')" --name "$2" "$3" |
    sed '/^.SH NAME/{n;s/^gamut \([a-z]*\) /gamut-\1 /}' | gzip -9n >"$folder/$1.1.gz"
}
rm -f "$folder"/*.1.gz
page gamut "motion of uncertain mechanisms: guaranteed, probable, possible" "$gamut"
"$gamut" completion bash >"$folder/gamut.bash"
"$gamut" completion zsh >"$folder/_gamut"
"$gamut" completion fish >"$folder/gamut.fish"
sed -n "s/^    '\([a-z]*\):\(.*\)'\$/\1 \2/p" "$folder/_gamut" | while read -r command meaning; do
  page "gamut-$command" "$(sed 's/\\//g' <<<"$meaning" | tr -d "'")" "$gamut $command"
done
version=$(sed -n 's/^## \([0-9.]*\).*/\1/p' "$changelog" | head -n 1)
printf 'gamut (%s-1) unstable; urgency=low\n\n  * What changed stands in changelog.gz.\n\n -- %s  %s\n' \
  "$version" "$maintainer" "$(date -R -r "$changelog")" | gzip -9n >"$folder/changelog.Debian.gz"
gzip -9nc "$changelog" >"$folder/changelog.gz"
