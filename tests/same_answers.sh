#!/usr/bin/env bash
# Compares two builds of beltlife: answers, logs and pages of every scene and every example have to be the same, to the
# last digit, but for times and for what a file says of the program. Studies, calibrations and searches are cut short
# (few samples, coarse meshes, short holds), so that the whole takes some ten minutes of processor time a build.
# Usage: tests/same_answers.sh OLD_BELTLIFE NEW_BELTLIFE [FOLDER]    (FOLDER: a new one for all files, else a temporary)
set -uo pipefail
old=$(realpath "$1") new=$(realpath "$2") tree=$(realpath "$(dirname "$0")/..")
work=${3:-$(mktemp -d)}
mkdir -p "$work"
work=$(realpath "$work")
different=0 compared=0

# Examples name each other by paths between the folders of the tree, so both builds run in a copy of these.
for build in old new; do
  mkdir -p "$work/$build/build"
  tar -C "$tree" -cf - sim/scenes studies/examples calibrate/examples optimize/examples results/reports | tar -C "$work/$build" -xf -
  find "$work/$build" -path '*/examples/*' -name '*.toml' -exec sed -i -E \
    -e 's/^(samples|budget) *= *[0-9]+/\1 = 16/' -e 's/^trajectories *= *[0-9]+/trajectories = 2/' \
    -e 's/^(phases|replicates) *= *[0-9]+/\1 = 2/' -e 's/^screen *= *[0-9]+/screen = 8/' -e 's/^starts *= *[0-9]+/starts = 1/' \
    -e 's/^elements *= *\[[^]]*\]/elements = [64, 128]/' -e 's/^step_budget *=.*/step_budget = 2e6/' {} +
done

# What differs from run to run, says which program ran, or is how a page looks. Points of a log stand in the order in
# which they were finished.
normal() {
  local order=cat
  [[ $1 == *.jsonl ]] && order=sort
  $order "$1" | sed -E -e '/<style>/,/<\/style>/d' -e 's/"(wall_s|processor_s|seconds|simulated_s_per_s)": *-?[0-9.e+-]+//g' -e 's/"(version|revision|compiler|command_line)": *"[^"]*"//g' \
    -e 's/[0-9.]+ (s|min|h) of processor time//g'
}

# same NAME ARGUMENTS...: runs both builds in their folders; compares exit code, standard output, and files named NAME.*
same() {
  local name=$1 build code_old code_new file
  shift
  for build in old new; do
    local program=$old
    [ $build = new ] && program=$new
    (cd "$work/$build" && mkdir -p out && "$program" "$@" >"out/$name.json" 2>"out/$name.err")
    local code=$?
    [ $build = old ] && code_old=$code || code_new=$code
  done
  compared=$((compared + 1))
  local verdict="same"
  [ $code_old -eq $code_new ] || verdict="exit codes $code_old and $code_new"
  for file in "$work"/old/out/"$name".{json,jsonl,html,csv}; do
    [ -e "$file" ] || continue
    cmp -s <(normal "$file") <(normal "${file/$work\/old/$work/new}") || verdict="$verdict; ${file##*/} differs"
  done
  [ $code_old -ne 2 ] || verdict="$verdict; refused, so that nothing is compared"
  [ "$verdict" = same ] || different=$((different + 1))
  printf '%-44s exit %d  %s\n' "$name" "$code_old" "$verdict"
}

for scene in "$tree"/sim/scenes/*.toml; do
  name=$(basename "$scene" .toml)
  same "check_$name" check "sim/scenes/$name.toml" --json
  same "modes_$name" modes "sim/scenes/$name.toml" --json
  same "simulate_$name" simulate "sim/scenes/$name.toml" --elements 128 --set profile.hold_s=0.5 --set profile.evaluate_s=0.25 --json --quiet
  same "life_$name" life "sim/scenes/$name.toml" --set profile.hold_s=0.5 --set profile.evaluate_s=0.25 --json --quiet
  for scheme in thesis symplectic_euler; do
    same "${scheme}_$name" simulate "sim/scenes/$name.toml" --each-range --scheme $scheme --elements 64 --set profile.settle_s=0.02 \
      --set profile.ramp_s=0.05 --set profile.hold_s=0.1 --set profile.evaluate_s=0.05 --json --quiet
  done
done

coarse=(--elements 128 --set profile.hold_s=0.4 --set profile.evaluate_s=0.2 --json --quiet)
# driver NAME ARGUMENTS...: the answer and the log; then the page, by both builds from the log of the old one
driver() {
  local name=$1
  shift
  same "$name" "$@" --out "out/$name.h5"
  same "page_$name" report "../old/out/$name.jsonl" --out "out/page_$name.html" --quiet
}
for kind in noise oat morris sobol uncertainty surrogate convergence stability; do
  for file in "$tree"/studies/examples/$kind*.toml; do
    name=$(basename "$file" .toml)
    driver "study_$name" study $kind "studies/examples/$name.toml" "${coarse[@]}"
  done
done
for name in thesis_table_4_1 thesis_ripple; do
  driver "study_$name" study oat "studies/examples/$name.toml" "${coarse[@]}"
done
for name in small same; do
  same "twin_$name" twin "calibrate/examples/${name}_twin.toml" --set profile.hold_s=0.7 --elements 128 --quiet --out "build/$name"
done
driver calibrate_small calibrate calibrate/examples/small.toml --set profile.hold_s=1 --set profile.evaluate_s=0.48 --json --quiet
for file in "$tree"/optimize/examples/*.toml; do
  name=$(basename "$file" .toml)
  driver "optimize_$name" optimize "optimize/examples/$name.toml" "${coarse[@]}"
done
for log in "$tree"/results/reports/*/log.jsonl.gz; do
  name=$(basename "$(dirname "$log")")
  same "report_$name" report "results/reports/$name/log.jsonl.gz" --out "out/report_$name.html" --quiet
done

echo
echo "$compared compared, $different different; files in $work"
[ $different -eq 0 ]
