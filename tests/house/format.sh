#!/usr/bin/env bash
# format.sh ROOT: the sources have the format that clang-format 14 gives them by .clang-format; others format otherwise.
set -u
cd "$1" || exit 1
format=$(command -v clang-format-14 || command -v clang-format) && $format --version | grep -q 'version 14\.' || {
  echo "there is no clang-format 14 (Debian: clang-format)"
  exit 1
}
find . -path './build*' -prune -o -name '*.[hc]pp' -print0 | xargs -0 -P "$(nproc)" -n 64 "$format" --dry-run --Werror
