#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Lets compose read docker/compose.yaml; it starts nothing and needs no engine.
#
#   compose_test.sh SOURCE_DIR
#
# Exits 77 (skipped) where compose is missing.
set -euo pipefail

if docker compose version >/dev/null 2>&1; then
  compose=(docker compose)
elif command -v docker-compose >/dev/null; then
  compose=(docker-compose)
else
  echo "skipped: compose is not installed (apt-get install docker-compose)"
  exit 77
fi
"${compose[@]}" -f "$1/docker/compose.yaml" -p semview config
