#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a build into an empty folder and uses what is there, and nothing else, from that folder.
#
#   install_test.sh CMAKE BUILD_DIR
set -euo pipefail
cmake=$1 build=$2

die() { printf 'install_test: %s\n' "$*" >&2; exit 1; }

work=$(mktemp -d)
server_pid=""
finish() {
  if [[ -n "$server_pid" ]]; then kill "$server_pid" 2>/dev/null || true; wait "$server_pid" || true; fi
  rm -rf "$work"
}
trap finish EXIT

"$cmake" --install "$build" --prefix "$work/usr" >"$work/install.log" || die "cmake --install failed"
cd "$work"
semview=usr/bin/semview share=usr/share/semview

for file in LICENSE maps/duplex_level1/{map.yaml,ATTRIBUTION.md} maps/duplex_building/semantic.glb \
  models/deeplab_ade20k32/{model.yaml,deeplabv3_mnv2_ade20k32_fp32.onnx,LICENSE.md,ATTRIBUTION.md} \
  weights/paper2017_ade20k150.csv vocabularies/ade20k150/{LICENSE,names.tsv} \
  python/semview/{client,v1/envelope_pb2}.py; do
  [[ -s "$share/$file" ]] || die "$share/$file is missing"
done

"$semview" map check "$share"/maps/*
# The vocabulary by its name, which is built in, and as the installed file: the same matrix.
"$semview" weights init "$share/maps/tutorial" --vocabulary ade20k150 -o named.csv >/dev/null
"$semview" weights init "$share/maps/tutorial" --vocabulary "$share/vocabularies/ade20k150/names.tsv" \
  -o from_file.csv >/dev/null
cmp <(grep -v '^#' named.csv) <(grep -v '^#' from_file.csv) || die "the two vocabularies differ"
"$semview" weights check "$share/maps/duplex_level1" "$share/maps/duplex_level1/weights.csv"
"$semview" view "$share/maps/tutorial" --pose 2,3,90 --labels ids.png >/dev/null
[[ -s ids.png ]] || die "semview view wrote no picture"
# The network is found by its name, beside the programs.
"$semview" view "$share/maps/tutorial" --pose 2,3,90 --pinhole 50,50,60,45,120,90 --photo photo.png >/dev/null
printf 'format: 1\ncameras: [{pinhole: {width: 120, height: 90, fx: 50, fy: 50, cx: 60, cy: 45}}]\n' >rig.yaml
"$semview" observe photo.png --camera rig.yaml -o obs --overlay overlay.png
"$semview" score "$share/maps/duplex_level1" --obs obs --weights "$share/maps/duplex_level1/weights.csv" \
  --pose 4.5,-13.2,0 >/dev/null

usr/bin/semview-server --map "$share/maps/tutorial" --bind 'tcp://127.0.0.1:*' >server.out 2>server.log &
server_pid=$!
for _ in $(seq 100); do
  if grep -q '^listening on ' server.out; then break; fi
  kill -0 "$server_pid" 2>/dev/null || { cat server.log; die "the server did not start"; }
  sleep 0.1
done
grep -q '^listening on ' server.out || { cat server.log; die "the server is not listening after 10 s"; }
kill -TERM "$server_pid"
wait "$server_pid" || die "the server did not end well"
server_pid=""
echo "passed"
