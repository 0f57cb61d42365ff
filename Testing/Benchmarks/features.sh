#!/bin/sh
# Measures what properties of a surface cost, and the making of surfaces, and leaves a CSV that says on what machine it was made.
# Usage: sh Testing/Benchmarks/features.sh [FILE]      default: Testing/Benchmarks/results/features.csv
#        BUILD=DIR for a build folder other than build/
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${BUILD:-$root/build}
out=${1:-$here/results/features.csv}
. "$here/head.sh"
program=$build/bin/HapticsContactBenchmark
if [ ! -x "$program" ]; then
  echo "No $program: build first, for example with sh Testing/test.sh; it needs libbenchmark-dev." >&2
  exit 1
fi
mkdir -p "$(dirname "$out")"
write_whole "$out"

# The frog's 1.5 million triangles; without a registry in reach that one stroke is left out.
HAPTICS_SURFACES=${HAPTICS_SURFACES:-$build/surfaces}
export HAPTICS_SURFACES
/usr/bin/python3 "$root/Data/get_surfaces.py" --output "$HAPTICS_SURFACES" frog >&2 ||
  echo "The frog could not be had." >&2

make_scratch head rows table
print_head > "$head"
# Interleaved, so that a machine that is slower for some seconds is so for every row.
"$program" --benchmark_enable_random_interleaving=true --benchmark_out="$rows" --benchmark_out_format=csv >&2
{
  cat "$head"
  grep '^name' "$rows"
  grep _median "$rows" | sort
} > "$table"
write_whole "$out" "$table"
echo "$out"
