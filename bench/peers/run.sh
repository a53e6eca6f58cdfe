#!/usr/bin/env bash
# Tessera against Mesa's llvmpipe on the same deferred-shading pass: bench/peers/README.md says what is compared.
#   bench/peers/run.sh
# Environment:
#   ROUNDS=5             how often the two run, one after the other
#   SECONDS_PER=1        of measuring, per row and round
#   VARIANTS=L1,L4,L16   numbers of lights
#   THREADS=2            of both
#   ISA=                 Tessera's instruction set (`tessera isa` lists them); empty: the best that this CPU has
#   UNDER=               a command that every measured program runs under: "taskset -c 0,1"
#   DATA=                a folder with inputs of your own; empty: build/peers/data, made as bench/peers/scene.cpp says
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

build=build/release out=build/peers
data=${DATA:-$out/data} variants=${VARIANTS:-L1,L4,L16} threads=${THREADS:-2}
fail() { printf 'peers: error: %s\n' "$*" >&2; exit 1; }

packages=(libegl-dev libopengl-dev libegl-mesa0 libgl1-mesa-dri python3)
if command -v dpkg-query >/dev/null; then
  missing=()
  for package in "${packages[@]}"; do
    [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" == installed ]] || missing+=("$package")
  done
  [[ ${#missing[@]} == 0 ]] || fail "packages are missing. Install them with:
  sudo apt-get install --no-install-recommends ${missing[*]}"
else
  echo "This is not a Debian system. Needed are, by their Debian names: ${packages[*]}"
fi

echo "== Building (minutes the first time; its words are in $out/build.log)"
mkdir -p "$out"
targets=(tessera_workload tessera_peer_inputs tessera_peer_gl tessera_peer_compare)
cmake --preset release >"$out/cmake.log" 2>&1 || fail "cmake could not configure the build: see $out/cmake.log"
cmake --build "$build" -j "${TESSERA_JOBS:-$(nproc)}" --target "${targets[@]}" >"$out/build.log" 2>&1 || fail "the build failed: see $out/build.log"

if [[ -z "${DATA:-}" && ! "$data/dfg.rg16f" -nt "$build/tessera_peer_inputs" ]]; then  # the file that is written last
  echo "== Making inputs in $data (105 MB)"
  "$build/tessera_peer_inputs" "$data"
fi

# llvmpipe, whatever else is installed; and no cache on disk, which would outlive a change of these settings.
export EGL_PLATFORM=surfaceless LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe LP_NUM_THREADS=$threads
export MESA_SHADER_CACHE_DISABLE=true MESA_GLSL_CACHE_DISABLE=true
log=$out/log.jsonl agreement=$out/agreement.txt
: >"$log"
: >"$agreement"
common=(--data "$data" --variant "$variants" --seconds "${SECONDS_PER:-1}")
for ((round = 1; round <= ${ROUNDS:-5}; ++round)); do
  echo "== Round $round of ${ROUNDS:-5}"
  ${UNDER:-} "$build/tessera_peer_gl" "${common[@]}" --shader bench/peers/deferred.frag --out "$out/mesa" >>"$log"
  ${UNDER:-} "$build/tessera_workload" --workload w1 "${common[@]}" --threads "$threads" --isa "${ISA:-}" \
    --out "$out/tessera" >>"$log"
done

status=0
for variant in ${variants//,/ }; do
  words=$("$build/tessera_peer_compare" "$out/mesa_$variant.f32" "$out/tessera_$variant.f32") || status=1
  echo "$variant $words" >>"$agreement"
done
echo
python3 bench/peers/table.py "$log" "$agreement"
[[ $status == 0 ]] || fail "the pictures differ by more than 1 % of a channel: these are not times of the same work"
