#!/usr/bin/env bash
# The order of the four layouts' lives under each reading of what the thesis does not publish: six ranges, hours.
# Usage: lives.sh PATH_TO_BELTLIFE; 5 minutes on two cores. Only the baseline's pretension is in doubt: that of the
# alternatives follows from what is printed.
set -euo pipefail
beltlife=$1
scenes=$(cd "$(dirname "$0")/../../../sim/scenes" && pwd)
lives() {
  local name=$1 baseline=$2
  shift 2
  echo "== $name"
  "$beltlife" life "$scenes/$baseline.toml" "$scenes"/alternative_{1,2,3}.toml --set profile.hold_s=1.5 --quiet "$@" | tail -5
}
for baseline in baseline baseline_448n baseline_322n; do
  for ripple in 1 2; do
    lives "$baseline, ripple x $ripple" "$baseline" --set driver.ripple_scale=$ripple
  done
done
lives "baseline, contact x 0.3" baseline --set contact.stiffness_n_per_m3=3e9 --set contact.friction_stiffness_n_per_m3=1.5e9
lives "baseline, contact x 3" baseline --set contact.stiffness_n_per_m3=3e10 --set contact.friction_stiffness_n_per_m3=1.5e10
