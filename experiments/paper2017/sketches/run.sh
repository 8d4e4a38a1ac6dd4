#!/bin/sh
# Shipped plans, redrawn by tools/redraw_plan.py, and the sketch drawn by hand: robots in the true
# plan, localized on the sketch, without and with a distortion of the map in the state.
#   usage: run.sh SEMVIEW OUT [SEED...]
# Prints a line or more an estimate; README.md beside the folder has the table.
set -eu
semview=$1
out=$2
shift 2
[ $# -gt 0 ] || set -- 1 2
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../..
mkdir -p "$out"

# localize_on SKETCH ROOMS TRUE_ROOMS LOG NAME OPTIONS...: what a line is called, and how
localize_on() {
  sketch=$1; rooms=$2; true_rooms=$3; log=$4; name=$5
  shift 5
  "$semview" localize --log "$log" --map "$sketch" --weights "$sketch/weights.csv" --seed 1 \
    --heading combined --motion paper --sigma 0.15 --heading-sigma 2 \
    -o "$log/$name.tum" "$@" > /dev/null
  "$semview" evaluate rooms --log "$log" --true-rooms "$true_rooms" --rooms "$rooms" "$log/$name.tum"
}

# compare SKETCH ROOMS TRUE_ROOMS LOG: each method from the known start
compare() {
  start=$("$semview" evaluate rooms --log "$4" --true-rooms "$3" --rooms "$2" --start)
  localize_on "$@" none --particles 1000 --init "$start,0.3"
  localize_on "$@" global --particles 1000 --init "$start,0.3" --estimate-map-affine --affine-exact 0
  localize_on "$@" local --particles 1000 --init "$start,0.3" --estimate-map-affine --affine-exact 0 \
    --affine-drift 0.05
}

for map in duplex_level1 duplex_level2 largebuilding_level1; do
  for seed; do
    sketch=$out/${map}_sketch_$seed
    log=$out/${map}_drive_$seed
    python3 "$root/tools/redraw_plan.py" "$root/maps/$map" "$here/${map}_true_rooms.csv" "$seed" "$sketch"
    [ -d "$log" ] || "$semview" simulate "$root/maps/$map" --out "$log" --seed "$seed" > /dev/null
    compare "$sketch" "$sketch/rooms.csv" "$here/${map}_true_rooms.csv" "$log"
  done
done

hand=$out/by_hand
[ -d "$hand" ] || "$semview" map import plan "$here/duplex_level1.yaml" -o "$hand" > /dev/null
cp "$root/maps/duplex_level1/weights.csv" "$hand/"
for seed; do
  log=$out/by_hand_drive_$seed
  [ -d "$log" ] || "$semview" simulate "$root/maps/duplex_level1" --out "$log" --seed "$seed" > /dev/null
  compare "$hand" "$here/duplex_level1_rooms.csv" "$here/duplex_level1_true_rooms.csv" "$log"
done
