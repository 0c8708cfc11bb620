#!/usr/bin/env bash
# nolint.sh ROOT: fails, naming the lines, if a source turns clang-tidy off without naming the check.
set -u
cd "$1" || exit 1
if grep -rnE 'NOLINT(NEXTLINE|BEGIN|END)?([^(A-Z]|$)|NOLINT[A-Z]*\(\*?\)' --include='*.[hc]pp' --exclude-dir='build*' .; then
  echo "no check named in the lines above"
  exit 1
fi
