#!/usr/bin/env bash
# fuzz.sh study|results SECONDS: builds a fuzzer with clang and runs it on one core, from the shipped studies or the results
# of one. What crashes or hangs is kept in build/fuzz/found; the corpus grows in build/fuzz/corpus and is taken up again.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
target=$1 seconds=$2
corpus=build/fuzz/corpus/$target found=build/fuzz/found/$target
mkdir -p build/fuzz "$corpus" "$found"
cmake --preset fuzz >build/fuzz/configure.log
cmake --build --preset fuzz --target "${target}_fuzzer" gamut >build/fuzz/build.log
options=(-max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -artifact_prefix="$found/" -print_final_stats=1)
case $target in
  study)
    cp studies/*/study.toml tests/studies/corpus/*.toml "$corpus"
    options+=(-dict=tests/campaigns/study.dict -max_len=8192)
    ;;
  results)
    build/fuzz/gamut run tests/studies/corpus/small.toml --quiet --force -o "$corpus/small.h5" \
      --report build/fuzz/small.html
    options+=(-max_len=100000)
    ;;
esac
ASAN_OPTIONS=detect_leaks=0 exec "build/fuzz/tests/campaigns/${target}_fuzzer" "${options[@]}" "$corpus"
