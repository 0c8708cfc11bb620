#!/usr/bin/env bash
# tidy.sh BUILD [SOURCE...]: holds the sources, by default all of the product that BUILD compiles, to .clang-tidy, with
# the headers that they include, and prints what it finds. What clang 14 does not know of C++20 is no finding.
set -u
build=$1
shift
tidy=$(command -v clang-tidy-14 || command -v clang-tidy) && "$tidy" --version | grep -q 'version 14\.' || {
  echo "there is no clang-tidy 14 (Debian: clang-tidy)"
  exit 1
}
sources=$(if [ $# -gt 0 ]; then printf '%s\n' "$@"; else
  sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$build/compile_commands.json" |
    grep -vE '/(tests|benchmarks)/|/embedded\.cpp$' | sort -u
fi)
[ -n "$sources" ] || { echo "$build compiles nothing"; exit 1; }
output=$(xargs -n 1 -P "$(nproc)" "$tidy" -p "$build" --quiet 2>&1 <<<"$sources")
if grep -E 'no such file or directory|unable to handle compilation|^Stack dump' <<<"$output"; then
  exit 1
fi
if findings=$(grep -E '(warning|error): .*\[[a-z]+-[a-z0-9,-]+\]$' <<<"$output" | grep -vE '\[clang-diagnostic-[a-z-]+\]$' | sort -u) && [ -n "$findings" ]; then
  echo "$findings"
  exit 1
fi
echo "$(wc -l <<<"$sources") sources are tidy"
