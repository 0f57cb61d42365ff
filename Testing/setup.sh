#!/bin/sh
# Installs what is missing, configures and builds. Run by demo.sh and test.sh.
set -eu

usage()
{
  cat <<'END'
Usage: sh Testing/setup.sh [--vtk] [--slow] [--help]

Installs the packages that are missing (Debian 12 and 13; with sudo where not root), configures and
builds into build/, and leaves build/env.sh to source. What is done already is not done again.

  --vtk   build against VTK alone, without the ParaView plugin. Where ParaView's packages are
          installed, against the VTK that comes with them: Debian's two stacks exclude each other,
          and this script never removes a package.
  --slow  install what the slow tests need as well: a virtual machine for the USB driver
END
}

cd "$(dirname "$0")/.."
preset=paraview
slow=
for argument in "$@"; do
  case $argument in
    --vtk) preset=vtk ;;
    --slow) slow=yes ;;
    -h|--help) usage; exit 0 ;;
    *) echo "setup.sh: unknown argument '$argument'" >&2; usage >&2; exit 2 ;;
  esac
done
mkdir -p build

say() { printf '==> %s\n' "$*"; }
warn() { printf '==> Warning: %s\n' "$*" >&2; }

installed()
{
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# The packages of a list that are not installed.
missing_of()
{
  dpkg-query -W -f '${Package} ${db:Status-Status}\n' | awk '
    NR == FNR { if ($2 == "installed") have[$1] = 1; next }
    /^[^#]/ && !($1 in have) { print $1 }' - "$1"
}

# Runs a long command with its output in a log, and says every ten seconds that it goes on.
run_logged()
{
  log=$1
  shift
  "$@" >"$log" 2>&1 </dev/null &
  pid=$!
  seconds=0
  while kill -0 "$pid" 2>/dev/null; do
    sleep 1
    seconds=$((seconds + 1))
    if [ $((seconds % 10)) -eq 0 ]; then
      printf '    %4d s  %s\n' "$seconds" "$(tail -n 1 "$log" | tr -d '\r' | cut -c 1-80)"
    fi
  done
  wait "$pid"
}

# Sets as_root to what runs a command as root: nothing, or sudo. Fails where neither is possible.
find_root()
{
  as_root=
  [ "$(id -u)" -eq 0 ] && return 0
  command -v sudo >/dev/null || return 1
  as_root=sudo
  if [ -t 0 ]; then
    sudo -v
  else
    sudo -n true 2>/dev/null
  fi
}

install_packages()
{
  missing=$(missing_of "$1")
  if [ -z "$missing" ]; then
    say "Packages: all installed"
    return 0
  fi
  say "Packages: $(echo "$missing" | wc -l) missing:" $missing
  if ! find_root; then
    warn "installing needs root, and sudo is not to be had. As root, run"
    echo "      apt-get install --no-remove" $missing >&2
    warn "going on with what is found."
    return 0
  fi
  say "Installing them (some minutes the first time; log: build/packages.log)"
  # --no-remove: rather no package than one less.
  if run_logged build/packages.log $as_root apt-get -q update &&
    run_logged build/packages.log $as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get -q -y --no-install-recommends --no-remove install $missing; then
    say "Packages: installed"
  else
    tail -n 20 build/packages.log >&2
    warn "apt-get failed (see above). Is the network up? Going on with what is found."
  fi
}

# --- packages -------------------------------------------------------------------------------------
release=
if [ -r /etc/os-release ] && command -v dpkg-query >/dev/null; then
  release=$(. /etc/os-release && echo "${ID:-}-${VERSION_ID:-}")
fi
case $release in
  debian-12|debian-13)
    list=Testing/packages-$release.txt
    if installed paraview-dev || installed python3-paraview; then
      [ $preset = paraview ] || say "ParaView is installed: building against its VTK"
    elif [ $preset = vtk ]; then
      list=Testing/packages-$release-vtk.txt
    elif installed libvtk9-dev || installed python3-vtk9; then
      warn "VTK's packages are installed, which exclude ParaView's: building without the plugin."
      preset=vtk
      list=Testing/packages-$release-vtk.txt
    fi
    install_packages "$list"
    if [ $preset = paraview ] && ! installed paraview-dev; then
      warn "ParaView is not to be had here: building against VTK alone, without the plugin."
      preset=vtk
      install_packages "Testing/packages-$release-vtk.txt"
    fi
    [ -z "$slow" ] || install_packages Testing/packages-slow.txt
    ;;
  *)
    if [ $preset = paraview ] && ! command -v pvpython >/dev/null; then
      preset=vtk
    fi
    say "Not Debian 12 or 13: nothing gets installed here. Needed are a C++17 compiler, CMake 3.22,"
    say "Ninja, Python 3 with its headers, VTK 9.1 or ParaView 5.11 (or later) with development files"
    say "and Python, GLM, Embree 3 or 4, CGAL, GoogleTest and Xvfb; by Debian's names:"
    grep -v '^#' Testing/packages-debian-12-vtk.txt | tr '\n' ' '
    echo
    say "Going on with what is found, preset $preset."
    ;;
esac

# --- configure ------------------------------------------------------------------------------------
plugin=OFF
[ $preset = paraview ] && plugin=ON
if [ -f build/CMakeCache.txt ] &&
  ! grep -qx "HAPTICS_BUILD_PARAVIEW_PLUGIN:[A-Z]*=$plugin" build/CMakeCache.txt; then
  say "build/ was of the other kind: configuring it anew"
  rm -rf build/CMakeCache.txt build/CMakeFiles build/build.ninja
fi
if [ ! -f build/build.ninja ] || [ CMakePresets.json -nt build/build.ninja ]; then
  say "Configuring (preset $preset; log: build/configure.log)"
  if ! run_logged build/configure.log cmake --preset "$preset"; then
    cat build/configure.log >&2
    echo "==> Configuring failed: the first error above names what is missing." >&2
    exit 1
  fi
fi

# --- build ----------------------------------------------------------------------------------------
say "Building"
cmake --build build
say "Built. To use it from a shell:  . build/env.sh"
