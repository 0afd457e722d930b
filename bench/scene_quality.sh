#!/bin/sh
# What a scene reaches: five seeds of so many seconds each, a line per seed, then the median share of the optimum.
#   bench/scene_quality.sh SCENE SECONDS [options of espalier run...]
set -eu
cd "$(dirname "$0")/.."
scene="$1"
seconds="$2"
shift 2
out="$(mktemp -d)"
trap 'rm -rf "$out"' EXIT
for seed in ${SEEDS:-1 2 3 4 5}; do
  build/espalier run "$scene" --time "$seconds" --seed "$seed" --keep 0 --set "output.picture=[64,48]" \
    --set output.refresh_seconds=0 --out "$out/$seed" "$@" 2>&1 | sed -n "s/^score /seed $seed: /p"
done | tee "$out/lines"
sed -n 's/.*: .* (\([0-9.]*\) %.*/\1/p' "$out/lines" | sort -n |
  awk '{ v[NR] = $1 } END { print "median " v[int((NR + 1) / 2)] " % of the optimum" }'
