#!/usr/bin/env bash
# machine_paths.sh ROOT: fails, naming the lines, if a source, script or page holds a path of somebody's machine.
set -u
cd "$1" || exit 1
if grep -rnIE '(^|[^[:alnum:]_./$}{-])/(work|tmp|home|root|Users)/' --exclude-dir=build --exclude-dir='build-*' \
  --exclude-dir=.git --exclude=.git --exclude-dir=node_modules .; then
  echo "paths of a machine in the lines above"
  exit 1
fi
