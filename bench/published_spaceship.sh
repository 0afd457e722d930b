#!/bin/sh
# The published spaceship experiment (scenes/spaceship-published.toml): five seeds per preset and time, median last.
#   bench/published_spaceship.sh TARGET.obj [seconds...]        TARGET: the target mesh of the published experiment
set -eu
cd "$(dirname "$0")/.."
target="$1"
shift
[ $# -gt 0 ] || set -- 2 10
out="$(mktemp -d)"
trap 'rm -rf "$out"' EXIT
for seconds in "$@"; do
  for preset in ga-2017 ga-local; do
    for seed in 1 2 3 4 5; do
      build/espalier run scenes/spaceship-published.toml --set "volume.mesh.0.file=$target" \
        --set "search.preset=\"$preset\"" --time "$seconds" --seed "$seed" --keep 0 --set "output.picture=[64,48]" \
        --out "$out/$preset-$seconds-$seed" 2>&1 | sed -n 's/^score \([0-9.]*\) .*/\1/p'
    done | sort -n | awk -v preset="$preset" -v seconds="$seconds" \
      '{ s = s " " $1; v[NR] = $1 } END { print preset, seconds " s:" s "  median " v[3] }'
  done
done
