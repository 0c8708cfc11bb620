#!/usr/bin/env bash
# fuzz.sh study|results SECONDS: builds a fuzzer with clang and runs it on one core, from the shipped studies or from
# results with something in every field. What crashes or hangs is kept in build/fuzz/found; the corpus grows in
# build/fuzz/corpus and is taken up again. The kinds of complaints that the study reader came to are ordinary tests, in
# tests/studies/corpus/fuzzed.txt. A found oom-… after which the fuzzer went on is the end of a child that read results:
# gamut limits its memory, under the sanitizer libFuzzer does.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
target=$1 seconds=$2
corpus=build/fuzz/corpus/$target found=build/fuzz/found/$target
mkdir -p build/fuzz "$corpus" "$found"
cmake --preset fuzz >build/fuzz/configure.log
cmake --build --preset fuzz --target "${target}_fuzzer" >build/fuzz/build.log
options=(-max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -artifact_prefix="$found/" -print_final_stats=1)
case $target in
  study)
    cp tests/studies/corpus/*.toml "$corpus"
    for study in studies/examples/*/study.toml; do cp "$study" "$corpus/$(basename "$(dirname "$study")").toml"; done
    options+=(-dict=tests/campaigns/study.dict -max_len=8192)
    ;;
  results) options+=(-max_len=100000) ;;
esac
ASAN_OPTIONS=detect_leaks=0:quarantine_size_mb=4 exec "build/fuzz/tests/campaigns/${target}_fuzzer" "${options[@]}" "$corpus"
