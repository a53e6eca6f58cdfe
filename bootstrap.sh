#!/usr/bin/env bash
# From a fresh clone to a picture: ./bootstrap.sh help
set -euo pipefail
started_in=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"

build_dir=build/release
log_dir=build/bootstrap

usage() {
  cat <<'TEXT'
usage: ./bootstrap.sh COMMAND

  demo [SCENE.glb [ENVIRONMENT.exr]]   renders out/demo.png, 1920 x 1080: Debian's 2CylinderEngine under a courtyard,
                                       or your own scene and environment
  test [CTEST OPTIONS]                 builds everything and runs the whole test suite
  build                                builds everything: the program is build/release/tessera
  install                              only installs the packages of packages.txt that are missing
  help                                 this text

Each command first installs the packages it misses (Debian and its relatives, as root or through sudo), then builds
what it needs in build/release. Where packages cannot be installed it says which to install, and goes on if all are there.

  TESSERA_INSTALL=no    never install anything
  TESSERA_JOBS=N        compile N files at a time (default: one per core, as memory allows)
TEXT
}

say() { printf '\n== %s\n' "$*"; }
fail() { printf 'bootstrap: error: %s\n' "$*" >&2; exit 1; }

packages_in() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$@"; }

missing_packages() {
  local package
  for package in $(packages_in "$@"); do
    [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" == installed ]] || echo "$package"
  done
}

# How to become root without a question that nobody is there to answer.
root_prefix() {
  if [[ "$(id -u)" == 0 ]]; then echo "env"
  elif ! command -v sudo >/dev/null; then return 1
  elif [[ -t 0 && -t 2 ]]; then echo "sudo env"
  elif sudo -n true 2>/dev/null; then echo "sudo -n env"
  else return 1; fi
}

install_packages() {  # files that list packages
  if ! command -v dpkg-query >/dev/null; then
    say "This is not a Debian system, so nothing is installed. Needed are, by their Debian names:"
    packages_in "$@" | paste -sd' ' | fold -s -w 110
    return 0
  fi
  local missing root
  missing=$(missing_packages "$@" | paste -sd' ')
  [[ -n "$missing" ]] || return 0
  if [[ "${TESSERA_INSTALL:-yes}" == no ]] || ! command -v apt-get >/dev/null || ! root=$(root_prefix); then
    fail "these packages are missing, and cannot be installed from here (not root, or told not to). Install them with:
  sudo apt-get install --no-install-recommends $missing"
  fi
  say "Installing packages: $missing"
  mkdir -p "$log_dir"
  local log=$log_dir/apt.log
  echo "(a few minutes at most; apt's words are in $log)"
  if ! $root DEBIAN_FRONTEND=noninteractive apt-get update >"$log" 2>&1 ||
     ! $root DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing >>"$log" 2>&1; then
    tail -n 15 "$log" >&2
    fail "apt-get could not install the packages; see above, and $log"
  fi
}

# One compiler per core, and 1.5 GB of memory for each.
jobs_for_this_machine() {
  local cores memory
  cores=$(nproc 2>/dev/null || echo 1)
  memory=$(awk '/MemAvailable/ {print int($2 / 1500000)}' /proc/meminfo 2>/dev/null || echo "$cores")
  echo $((memory < 1 ? 1 : memory < cores ? memory : cores))
}

build() {  # targets
  local jobs=${TESSERA_JOBS:-$(jobs_for_this_machine)}
  say "Building in $build_dir ($jobs at a time)"
  mkdir -p "$log_dir"
  if ! cmake --preset release >"$log_dir/cmake.log" 2>&1; then
    cat "$log_dir/cmake.log" >&2
    fail "cmake could not configure the build: see above"
  fi
  cmake --build "$build_dir" -j "$jobs" --target "$@"
}

first_existing() {
  local path
  for path in "$@"; do [[ -f "$path" ]] && { echo "$path"; return; }; done
  return 1
}

demo() {
  local scene=${1:-} environment=${2:-} framing=()
  [[ -z "$scene" || "$scene" == /* ]] || scene=$started_in/$scene
  [[ -z "$environment" || "$environment" == /* ]] || environment=$started_in/$environment
  # A view of the demo's own model; any other is framed from its bounds.
  [[ -n "$scene" ]] || framing=(--orbit 35,25,700 --env-rotation 180 --exposure -0.7 --samples 8)
  [[ -n "$scene" ]] || scene=$(first_existing \
    /usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb) ||
    fail "the demo's model is not here (Debian's package assimp-testmodels). Name one: ./bootstrap.sh demo SCENE.glb"
  [[ -n "$environment" ]] || environment=$(first_existing \
    /usr/share/blender/datafiles/studiolights/world/courtyard.exr \
    /usr/share/blender/*/datafiles/studiolights/world/courtyard.exr) ||
    fail "the demo's environment is not here (Debian's package blender-data). Name one: ./bootstrap.sh demo SCENE.glb ENVIRONMENT.exr"
  say "Rendering $scene under $environment"
  mkdir -p out
  "$build_dir/tessera" render "$scene" --env "$environment" --size 1920x1080 "${framing[@]}" --stats out/demo.json -o out/demo.png
  cat <<TEXT

The picture: $PWD/out/demo.png   (and its statistics: out/demo.json)

Try next:
  $build_dir/tessera render "$scene" --env "$environment" --orbit 215,30 --background '#202830' -o out/behind.png
  $build_dir/tessera render "$scene" --light directional:-1,-2,-1:3 --aov id,depth,normal,albedo -o out/layers.exr
  $build_dir/tessera info "$scene"
  $build_dir/tessera render --help
  ./bootstrap.sh test
TEXT
}

command=${1:-help}
[[ $# == 0 ]] || shift
case "$command" in
  demo)
    install_packages packages.txt
    build tessera
    demo "$@"
    ;;
  test)
    install_packages packages.txt
    build all
    say "Testing"
    # The long fuzz (ctest -L long) runs for hours, and only where it is asked for.
    [[ " $* " == *" -L "* ]] || set -- -LE long "$@"
    ctest --test-dir "$build_dir" --output-on-failure --parallel 2 "$@"
    ;;
  build)
    install_packages packages.txt
    build all
    say "Built: $PWD/$build_dir/tessera"
    ;;
  install) install_packages packages.txt "$@" ;;
  help | -h | --help) usage ;;
  *)
    usage >&2
    fail "unknown command '$command'"
    ;;
esac
