#!/usr/bin/env bash
# How often the truth lies in its 95 % interval: twins of the same mesh and step with twenty seeds of noise, one range, 256
# elements, each calibrated from the same start. Usage: coverage.sh PATH_TO_BELTLIFE FOLDER [SEEDS]; 20 minutes on two cores.
# The table of results: results/reports/calibration_twin.
set -euo pipefail
beltlife=$(realpath "$1")
examples=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$2" && cd "$2"
seeds=${3:-20}
one() {
  "$1" twin "$3/same_twin.toml" --seed "$2" --out "seed$2" --threads 1 --quiet
  # The file names its records relative to itself, so it stands beside them.
  sed -e "s#../../sim/#$3/../../sim/#; s#../../build/same_#seed$2_#" "$3/same.toml" > "seed$2.toml"
  # From near the truth: what is counted is where the truth lies in the interval, not whether the fit finds the way.
  sed -i -e 's/^start = 0.5$/start = 0.44/; s/^start = 10$/start = 12.5/; s/^start = 5e-5$/start = 3.2e-5/; s/^start = 3$/start = 4/; s/^start = 1$/start = 0.5/' "seed$2.toml"
  printf '[calibration]\nstarts = 1\nprofiles = false\n' >> "seed$2.toml"
  # 3: not converged or none; its intervals count all the same
  "$1" calibrate "seed$2.toml" --elements 256 --set profile.hold_s=1.5 --threads 1 --quiet --json > "seed$2.json" || [ $? -eq 3 ]
}
export -f one
seq "$seeds" | xargs -P 2 -I{} bash -c 'one "$0" {} "$1"' "$beltlife" "$examples"
for seed in $(seq "$seeds"); do
  echo "seed $seed: $(tr -d '\n' < "seed$seed.json" | grep -o '"converged": *[a-z]*')"
done
