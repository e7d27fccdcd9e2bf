#!/usr/bin/env bash
# Installs what is missing, builds, runs every test on all cores, and prints the ten slowest.
set -euo pipefail
cd "$(dirname "$0")"
. .ci/install.sh
install_missing $build_packages $test_packages

cmake --preset release >/dev/null
cmake --build build/release
log=build/release/ctest.log
status=0
ctest --test-dir build/release --output-on-failure -j "$(nproc)" >"$log" 2>&1 || status=$?
[ $status -eq 0 ] || cat "$log"

total=$(grep -cE '^ *[0-9]+/[0-9]+ Test +#' "$log" || true)
passed=$(grep -cE '^ *[0-9]+/[0-9]+ Test +#.* Passed ' "$log" || true)
skipped=$(grep -cE '^ *[0-9]+/[0-9]+ Test +#.*\*\*\*Skipped ' "$log" || true)
echo
echo "Ten slowest tests (s):"
sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .* ([0-9.]+) sec.*/\2 \1/p' "$log" | sort -rn | awk 'NR <= 10 {printf "  %7.2f  %s\n", $1, $2}'
echo
echo "$passed passed, $((total - passed - skipped)) failed, $skipped skipped"
exit $status
