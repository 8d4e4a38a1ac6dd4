#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a floor plan to two localized robots, in one command. Asks nothing; what it starts, it stops.
#
# Installs the packages that compiling needs, builds the programs (preset release), starts
# semview-server with the two levels of a real duplex house, precomputes the views of level 1,
# simulates two robots there, and runs two `semview localize` clients at once against the server.
# Prints how well they did and draws it into demo_out/. What an earlier run has done is not done again.
#
# Exits 0 only if both robots end within 0.3 m of the truth and nearer to it than their odometry.
set -uo pipefail
cd "$(dirname "$0")" || exit 1

out=demo_out
map=maps/duplex_level1
robots=(1 2)  # also the seeds of their worlds, drives and filters
drive_frames=60   # half a metre apart

say() { printf '\n== %s\n' "$*"; }
die() { printf 'demo.sh: %s\n' "$*" >&2; exit 1; }

server_pid=""
robot_pids=()
stop_all() {
  local pid
  for pid in "${robot_pids[@]}" $server_pid; do
    kill "$pid" 2>/dev/null
  done
  for pid in "${robot_pids[@]}" $server_pid; do
    wait "$pid" 2>/dev/null
  done
  robot_pids=() server_pid=""
}
trap stop_all EXIT
trap 'exit 130' INT TERM

say "Packages"
tools/install_deps.sh --build || die "the packages above are missing"

say "Building the programs (build/release, a few minutes the first time)"
mkdir -p build "$out"
cmake --preset release >build/release.configure.log 2>&1 ||
  { tail -n 30 build/release.configure.log; die "configuring failed, see above"; }
cmake --build --preset release || die "building failed, see above"
semview=build/release/bin/semview
server=build/release/bin/semview-server

say "The plan: checking it"
"$semview" map check "$map" || die "$map has the problems listed above"

say "Starting the server"
"$server" --map maps/duplex_level1 --map maps/duplex_level2 --cache "$out/cache" \
  --bind 'tcp://127.0.0.1:*' >"$out/server.out" 2>"$out/server.log" &
server_pid=$!
endpoint=""
for _ in $(seq 100); do
  endpoint=$(sed -n 's/^listening on //p' "$out/server.out")
  [[ -n "$endpoint" ]] && break
  kill -0 "$server_pid" 2>/dev/null || { cat "$out/server.log"; die "the server did not start, see above"; }
  sleep 0.1
done
[[ -n "$endpoint" ]] || { cat "$out/server.log"; die "the server is not listening after 10 s"; }
echo "semview-server (process $server_pid) serves both levels at $endpoint"

say "Precomputing every view of $map"
"$semview" precompute "$map" --cache "$out/cache" ||
  die "precompute failed; to begin anew: rm -r $out/cache"

say "Simulating ${#robots[@]} robots whose world differs from the plan"
for robot in "${robots[@]}"; do
  log=$out/robot$robot
  if [[ "$log.json" -nt "$semview" ]]; then
    echo "$log: there already"
    continue
  fi
  rm -rf "$log"
  "$semview" simulate "$map" --out "$log" --seed "$robot" --steps "$drive_frames" --json >"$log.json.part" ||
    die "simulating robot $robot failed, see above"
  mv "$log.json.part" "$log.json"
done

# start_of LOG: what the robot believes at first, "X,Y,YAW_DEG": 0.36 m and 5 degrees off the truth.
start_of() {
  awk '!/^#/ { yaw = 2 * atan2($7, $8) * 180 / 3.14159265358979
               printf "%.3f,%.3f,%.1f", $2 + 0.3, $3 - 0.2, yaw + 5; exit }' "$1/groundtruth.txt"
}

say "Localizing ${#robots[@]} robots at once, each a process that asks the server over TCP"
for robot in "${robots[@]}"; do
  log=$out/robot$robot
  "$semview" localize --log "$log" --server "$endpoint" --map duplex_level1 \
    --weights "$map/weights.csv" --init "$(start_of "$log"),0.3" --seed "$robot" \
    -o "$log.est.tum" >"$log.localize.txt" 2>&1 &
  robot_pids+=($!)
done
failed=false
for i in "${!robots[@]}"; do
  wait "${robot_pids[$i]}" || failed=true
  cat "$out/robot${robots[$i]}.localize.txt"
done
robot_pids=()
$failed && { cat "$out/server.log"; die "a localizer failed, see above"; }

say "Pictures"
log=$out/robot${robots[0]}
here=4.5,-13.2,-120  # the living room
"$semview" view "$map" --pose "$here" --image "$out/view_labels.png" \
  --range-image "$out/view_range.png" || die "drawing the views failed, see above"
"$semview" heatmap "$map" --obs "$log" --frame 10 --weights "$map/weights.csv" \
  --cache "$out/cache" -o "$out/heatmap.png" || die "drawing the heat map failed, see above"

say "Results"
# number FILE OBJECT QUANTITY KEY: one number of what `evaluate run --json` printed.
number() {
  awk -v object="\"$2\": {" -v quantity="\"$3\": {" -v key="\"$4\":" '
    index($0, object) { in_object = 1; next }
    in_object && quantity == "\"\": {" && index($0, key) { print; exit }
    in_object && index($0, quantity) { in_quantity = 1; next }
    in_quantity && index($0, key) { print; exit }' "$1" | sed 's/.*: //; s/,$//'
}
# total FILE COLUMN: the sum of a column of a frames report.
total() {
  awk -F, -v column="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == column) c = i; next }
                          { sum += $c } END { print sum + 0 }' "$1"
}
row='%-8s %16s %16s %18s %12s %12s\n'
# shellcheck disable=SC2059  # the format is the table's
printf "$row" robot "odometry error" "estimate error" "time to converge" "views cast" "cache hits"
good=true
for robot in "${robots[@]}"; do
  log=$out/robot$robot
  "$semview" evaluate run --log "$log" "$log.est.tum" --map "$map" --json --final-within 0.3 \
    --particles "$log.est.particles.csv" --svg "$out/robot$robot.svg" --png "$out/robot$robot.png" \
    >"$log.evaluation.json" 2>"$log.evaluation.txt" || good=false
  frames=$log.est.frames.csv
  hits=$(($(total "$frames" cells_memory) + $(total "$frames" cells_disk)))
  # shellcheck disable=SC2059
  printf "$row" "$robot" \
    "$(printf '%.3f m' "$(number "$log.evaluation.json" odometry position_m final)")" \
    "$(printf '%.3f m' "$(number "$log.evaluation.json" estimate position_m final)")" \
    "$(number "$log.evaluation.json" estimate "" converged_after_s) s" \
    "$(total "$frames" cells_cast)" "$hits"
done
stop_all
echo
echo "Errors are at the end of a drive of 30 m. Converged: within 0.5 m, and so from then on; the robots"
echo "start 0.36 m off and use a first frame at 0 s. Pictures and files are in $out/:"
echo "  robot*.svg, robot*.png   the plan with the true, odometry and estimated tracks, final particles"
echo "  view_labels.png, view_range.png, heatmap.png"
$good || { cat "$out"/robot*.evaluation.txt >&2; die "a robot ended too far from the truth"; }
echo "Both robots ended within 0.3 m of the truth and nearer to it than their odometry."
