#!/bin/sh
# Measures everything that the charts show, draws them, and fills in the tables of README.md.
set -eu

usage()
{
  cat <<'EOF'
Usage: sh Testing/Benchmarks/charts.sh [--full] [--draw] [--help]

Runs every method on every surface and every scene of the stability suite, and leaves tables
(CSV, with machine, compiler and versions) and charts in Testing/Benchmarks/results. Nothing else
should run on the machine; it takes some ten minutes and 4 GB.
BUILD=DIR for a build folder other than build/.

  --full   ten times longer strokes: an hour
  --draw   measure nothing: draw the charts again from the tables that are there
EOF
}

full=
draw=
for argument; do
  case $argument in
    --full) full=--full ;;
    --draw) draw=yes ;;
    --help|-h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
results=$here/results
. "$here/head.sh"
measure=$build/bin/HapticsMeasure

if [ -z "$draw" ]; then
  if [ ! -x "$measure" ] || [ ! -x "$build/bin/HapticsSceneTraces" ]; then
    echo "No $measure: build first, for example with sh Testing/test.sh." >&2
    exit 1
  fi
  surfaces=$build/surfaces
  /usr/bin/python3 "$root/Data/get_surfaces.py" --output "$surfaces" \
    t13 gearbox pial fault >/dev/null ||
    echo "Some real surfaces could not be had: the tables will be without them." >&2

  make_scratch head table
  {
    print_head
    echo "# libraries: $("$measure" --versions)"
    echo "# seed: 11, command: sh Testing/Benchmarks/charts.sh $full"
  } > "$head"
  mkdir -p "$results"
  for part in boundaries engines detail methods cost; do
    write_whole "$results/$part.csv"
    cp "$head" "$table"
    "$measure" "$part" $full --surfaces "$surfaces" >> "$table"
    write_whole "$results/$part.csv" "$table"
  done
  "$build/bin/HapticsSceneTraces" "$results"
  strokes=8
  [ -z "$full" ] || strokes=40
  for part in way noise; do
    cp "$head" "$table"
    if [ $part = way ]; then
      "$build/bin/HapticsWayBenchmark" --surfaces "$surfaces" --only pial,fault,t13,gearbox,sphere \
        --speeds 0.2,0.5 --depths 5 --strokes $strokes >> "$table"
    else
      "$build/bin/HapticsNoiseBenchmark" --surfaces "$surfaces" >> "$table"
    fi
    write_whole "$results/$part.csv" "$table"
  done
fi

display=
if [ -z "${DISPLAY:-}" ]; then
  display='xvfb-run -a -s "-noreset -screen 0 1280x1024x24"'
  command -v xvfb-run >/dev/null || { echo "No display, and no xvfb-run: install xvfb." >&2; exit 1; }
fi
# The Python that VTK's modules are made for.
eval "$display" /usr/bin/python3 '"$here/charts.py" "$results" "$results"' --readme '"$here/README.md"'
echo "$results"
