#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds docker/Dockerfile with buildah on a Debian root made by debootstrap, asks the server in the
# image for a view, and lets the two robots of docker/compose.yaml localize against it. No engine is
# needed, so compose itself is not run: what it would start is. Slow: compiles the programs once more.
#
#   image_test.sh SOURCE_DIR WORK_DIR PYTHON PYTHONPATH
#
# The base image is kept in WORK_DIR for the next run. Exits 77 (skipped) where a tool is missing.
set -euo pipefail
source_dir=$1 work=$2 python=$3 python_path=$4

export BUILDAH_ISOLATION=chroot
base=localhost/semview-test-base
image=localhost/semview-test

say() { printf '== %s\n' "$*"; }
skip() { printf 'skipped: %s\n' "$*"; exit 77; }
die() { printf 'image_test: %s\n' "$*" >&2; exit 1; }

command -v buildah >/dev/null || skip "buildah is not installed (apt-get install buildah)"
command -v debootstrap >/dev/null || skip "debootstrap is not installed (apt-get install debootstrap)"
[[ $(id -u) -eq 0 ]] || skip "debootstrap needs root"
"$python" -c 'import zmq, google.protobuf, numpy' 2>/dev/null ||
  skip "$python has no zmq, protobuf and numpy to ask the server with"

mkdir -p "$work"
buildah=(buildah --storage-driver vfs --root "$work/storage" --runroot "$work/run")
build() { "${buildah[@]}" "$@"; }

container="" server_pid="" robot_pids=()
finish() {
  local pid
  for pid in "${robot_pids[@]}"; do wait "$pid" || true; done
  # The whole group: buildah passes no signal on to what it runs.
  if [[ -n "$server_pid" ]]; then kill -- "-$server_pid" 2>/dev/null || true; fi
  if [[ -n "$container" ]]; then build rm "$container" >/dev/null || true; fi
}
trap finish EXIT

if ! build inspect --type image "$base" >/dev/null 2>&1; then
  say "Making the base image $base"
  rm -rf "$work/root"
  debootstrap --variant=minbase bookworm "$work/root" http://deb.debian.org/debian \
    >"$work/debootstrap.log" 2>&1 || { tail -n 5 "$work/debootstrap.log"; die "debootstrap failed"; }
  container=$(build from scratch)
  build add -q "$container" "$work/root" / >/dev/null
  build commit -q "$container" "$base" >/dev/null
  build rm "$container" >/dev/null
  container=""
  rm -rf "$work/root"
fi

say "Building the image"
build bud --pull-never --build-arg "BASE=$base" -f "$source_dir/docker/Dockerfile" -t "$image" \
  "$source_dir" >"$work/build.log" 2>&1 || { tail -n 40 "$work/build.log"; die "the build failed"; }

say "What is in it"
container=$(build from --pull-never "$image")
user=$(build inspect --format '{{.OCIv1.Config.User}}' "$container")
[[ "$user" == semview ]] || die "the image runs as '$user', not as semview"
build run "$container" -- sh -c '! command -v g++ && ! command -v cmake' >/dev/null ||
  die "the image holds build tools"
build run "$container" -- semview map check /usr/local/share/semview/maps/duplex_level1

say "A view from the server in it"
setsid "${buildah[@]}" run "$container" -- semview-server \
  --map /usr/local/share/semview/maps/duplex_level1 --cache /var/cache/semview \
  --bind 'tcp://127.0.0.1:*' >"$work/server.out" 2>"$work/server.log" &
server_pid=$!
endpoint=""
for _ in $(seq 300); do
  endpoint=$(sed -n 's/^listening on //p' "$work/server.out")
  if [[ -n "$endpoint" ]]; then break; fi
  kill -0 "$server_pid" 2>/dev/null || { cat "$work/server.log"; die "the server did not start"; }
  sleep 0.1
done
[[ -n "$endpoint" ]] || { cat "$work/server.log"; die "the server is not listening after 30 s"; }
PYTHONPATH=$python_path "$python" -B "$source_dir/tests/docker/ask_for_a_view.py" "$endpoint"

say "The robots of docker/compose.yaml"
compose=$source_dir/docker/compose.yaml
# The script under `command`, as compose would pass it on, and the address that is ours.
robot=$(sed -n '/^    - |$/,/^$/s/^      //p' "$compose" | sed 's/\$\$/$/g')
[[ "$robot" == *tcp://server:5560* ]] || die "docker/compose.yaml: no robot's command was found"
robot=${robot/tcp:\/\/server:5560/$endpoint}
build run "$container" -- bash -c "exec 3<>/dev/tcp/127.0.0.1/${endpoint##*:}" ||
  die "the health check of docker/compose.yaml does not reach the server"
for seed in 11 12; do
  build run "$container" -- env "ROBOT=robot$seed" "SEED=$seed" sh -ec "$robot" \
    >"$work/robot$seed.log" 2>&1 &
  robot_pids+=($!)
done
for i in 0 1; do
  wait "${robot_pids[$i]}" || { cat "$work"/robot*.log; die "a robot failed"; }
done
robot_pids=()
cat "$work"/robot*.log

say "passed"
