#!/bin/bash
# Opens a page of every kind in headless Chromium, at the widths of a desk and of a phone, and looks for what a reader
# would trip over: messages on the console, elements that are missing, pages wider than the window.
#   tests/browser/check_pages.sh [COMMAND [FOLDER]]
# COMMAND is the beltlife to try (build/release/beltlife), FOLDER takes pages, screenshots and logs
# (build/browser). Exit code 0: nothing found; 1: found, and said; 2: cannot be run here. CHROMIUM names the browser.
set -u
source=$(cd "$(dirname "$0")/../.." && pwd)
beltlife=$(realpath "${1:-$source/build/release/beltlife}")
out=${2:-$source/build/browser}
browser=${CHROMIUM:-chromium}
[ -x "$beltlife" ] || { echo "no command at $beltlife: build it, or name another" >&2; exit 2; }
command -v "$browser" >/dev/null || { echo "no $browser: apt-get install chromium, or set CHROMIUM" >&2; exit 2; }
mkdir -p "$out" && out=$(realpath "$out") && cd "$out" || exit 2
profile=$(mktemp -d) && trap 'rm -rf "$profile" 2>/dev/null' EXIT
failures=0
fail() { echo "FAILED $*"; failures=$((failures + 1)); }

# Pages. What is there from an earlier call is taken as it is.
scenes=$source/sim/scenes
make_result() { # NAME ARGUMENTS...: NAME.h5
  local name=$1
  shift
  [ -s "$name.h5" ] || "$beltlife" "$@" --quiet --out "$name.h5" >"$name.txt" 2>&1 || fail "$name: $(tail -n 1 "$name.txt")"
}
page() { # NAME FILE...: NAME.html
  local name=$1
  shift
  "$beltlife" report "$@" --quiet --out "$name.html" || fail "$name: no page"
}
short="--set profile.hold_s=1.5"
make_result two_pulley simulate "$scenes/two_pulley.toml" --each-range
make_result two_pulley_loose simulate "$scenes/two_pulley.toml" --each-range --set belt.friction_front=0.45
make_result accessory simulate "$scenes/accessory_drive.toml" --each-range
make_result ring simulate "$scenes/spinning_ring.toml"
make_result sweep simulate "$scenes/two_pulley.toml" --sweep 600:1200:24
make_result event simulate "$scenes/start_up.toml"
for kind in noise morris oat sobol uncertainty surrogate stability convergence; do
  make_result "study_$kind" study "$kind" "$source/studies/examples/$kind.toml"
done
make_result optimize optimize "$source/optimize/examples/small.toml"
for name in two_pulley accessory ring sweep event study_noise study_morris study_oat study_sobol study_uncertainty \
  study_surrogate study_stability study_convergence optimize; do
  page "$name" "$name.h5"
done
page comparison two_pulley.h5 two_pulley_loose.h5
page comparison_unlike two_pulley.h5 accessory.h5 ring.h5
for log in "$source"/results/reports/*/log.jsonl.gz; do
  page "report_$(basename "$(dirname "$log")")" "$log"
done

# Ids that a kind's page cannot do without, beside #summary.
needed() {
  case $1 in
    two_pulley | accessory) echo key-numbers layout-drawing animation animation-play life statics modes losses ranges warnings provenance ;;
    ring) echo key-numbers ranges warnings provenance ;;
    sweep) echo layout-drawing sweep provenance ;;
    event) echo layout-drawing event provenance ;;
    comparison*) echo key-numbers layout scenes ranges warnings provenance ;;
    optimize) echo layouts parameters history finalists lives active provenance ;;
    study_noise) echo noise provenance ;;
    study_morris) echo effects points provenance ;;
    study_oat) echo changes-0 provenance ;;
    study_sobol) echo shares points provenance ;;
    study_uncertainty) echo scatter points provenance ;;
    study_surrogate) echo surrogate shares points provenance ;;
    study_stability) echo steps provenance ;;
    study_convergence) echo errors provenance ;;
    *) echo provenance ;;
  esac
}

open_page() { # ARGUMENTS...: what the browser prints; its messages go to log
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync --hide-scrollbars \
    --allow-file-access-from-files --user-data-dir="$profile" --enable-logging=stderr --virtual-time-budget=4000 \
    "$@" 2>>"$log"
}

# A page around the page: opens every fold, measures it at both widths, and writes findings where --dump-dom shows them.
measure() { # NAME IDS...
  local name=$1
  shift
  cat >"$name.measure.html" <<HTML
<!doctype html><meta charset="utf-8"><title>measuring</title>
<iframe id="desk" style="width:1280px;height:900px;border:0"></iframe>
<iframe id="phone" style="width:390px;height:844px;border:0"></iframe>
<script>
const wanted = '$*'.split(' '), found = [];
let left = 2;
for (const id of ['desk', 'phone']) {
  const frame = document.getElementById(id);
  frame.onload = () => {
    const d = frame.contentDocument, width = d.documentElement.clientWidth;
    for (const w of wanted) if (!d.getElementById(w)) found.push('no #' + w);
    const closed = d.documentElement.scrollHeight;
    for (const fold of d.querySelectorAll('details')) fold.open = true;
    if (d.documentElement.scrollWidth > width) {
      found.push(id + ' scrolls sideways to ' + d.documentElement.scrollWidth + ' px');
      for (const e of d.querySelectorAll('body *'))
        if (!e.closest('.scroll') && !e.closest('svg *') && !e.closest('pre *') && e.getBoundingClientRect().right > width + 1)
          found.push(id + ': ' + e.tagName.toLowerCase() + (e.id ? '#' + e.id : '') + ' reaches out');
    }
    const seen = {};
    for (const e of d.querySelectorAll('[id]')) if (seen[e.id]) found.push('twice #' + e.id); else seen[e.id] = 1;
    document.documentElement.setAttribute('data-' + id, closed);
    if (--left === 0) document.documentElement.setAttribute('data-found', [...new Set(found)].slice(0, 8).join('; ') || 'nothing');
  };
  frame.src = '$name.html';
}
</script>
HTML
}

height_of() { grep -o "data-$2=\"[0-9]*\"" "$1.dom" | grep -o '[0-9]*'; }
count=0
for file in *.html; do
  name=${file%.html}
  case $name in *.measure) continue ;; esac
  log=$name.log
  : >"$log"
  ids="summary $(needed "$name")"
  measure "$name" $ids
  open_page --window-size=1720,950 --dump-dom "file://$out/$name.measure.html" >"$name.dom"
  found=$(grep -o 'data-found="[^"]*"' "$name.dom" | sed 's/data-found="//; s/"$//')
  case $found in
    nothing) ;;
    "") fail "$name: was not measured; see $out/$log" ;;
    *) fail "$name: $found" ;;
  esac
  desk=$(height_of "$name" desk) phone=$(height_of "$name" phone)
  open_page --window-size=1280,"$((${desk:-900} > 12000 ? 12000 : ${desk:-900}))" --screenshot="$out/$name.desk.png" \
    "file://$out/$name.html"
  # The browser's own window may not become as narrow as a phone's; a frame may.
  printf '<!doctype html><body style="margin:0"><iframe src="%s.html" style="width:390px;height:%spx;border:0"></iframe>' \
    "$name" "$((${phone:-844} > 12000 ? 12000 : ${phone:-844}))" >"$name.measure.html"
  open_page --window-size=500,"$((${phone:-844} > 12000 ? 12000 : ${phone:-844}))" --screenshot="$out/$name.phone.png" \
    "file://$out/$name.measure.html"
  open_page --print-to-pdf="$out/$name.pdf" --no-pdf-header-footer "file://$out/$name.html"
  grep -q CONSOLE "$log" && fail "$name: $(grep -m 3 -o 'CONSOLE.*' "$log" | tr '\n' ' ')"
  for picture in "$name.desk.png" "$name.phone.png" "$name.pdf"; do
    [ -s "$picture" ] || fail "$name: no $picture; see $out/$log"
  done
  rm -f "$name.measure.html" "$name.dom"
  count=$((count + 1))
done
echo "$count pages, $failures findings; screenshots and prints in $out"
[ "$failures" -eq 0 ]
