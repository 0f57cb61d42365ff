#!/bin/sh
# Installs what is missing, configures and builds. Run by demo.sh and test.sh.
set -eu

usage()
{
  cat <<'END'
Usage: sh Testing/setup.sh [--vtk] [--tests] [--slow] [--ci] [--strict] [--packages] [--help]

Installs the packages that are missing (Debian 12, 13 and 14; with sudo where not root), configures
and builds into build/, and leaves build/env.sh to source. What is done already is not done again.

  --vtk   build against VTK alone, without the ParaView plugin. Where ParaView's packages are
          installed, against the VTK that comes with them: on Debian 12 and 13 the two stacks exclude
          each other, and this script never removes a package.
  --tests build the tests too, and install what they need
  --slow  install what the slow tests need as well: a virtual machine for the USB driver
  --ci    install what .ci/tidy and .ci/sanitizers need as well: clang
  --strict
          warnings are errors, in a build that is configured anew
  --packages
          end there, before anything is configured
END
}

cd "$(dirname "$0")/.."
preset=paraview
tests=
strict=
more=
packages_only=
for argument in "$@"; do
  case $argument in
    --vtk) preset=vtk ;;
    --tests) tests=yes ;;
    --slow|--ci) more="$more Testing/packages-${argument#--}.txt" ;;
    --strict) strict=-DCMAKE_COMPILE_WARNING_AS_ERROR=ON ;;
    --packages) packages_only=yes ;;
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

# The packages of a list that are wanted: those under "# Tests" only where tests are built.
packages_of()
{
  awk -v tests="$tests" '/^# Tests/ && !tests { exit } /^[^#]/' "$1"
}

missing_of()
{
  packages_of "$1" >build/packages.wanted
  dpkg-query -W -f '${Package} ${db:Status-Status}\n' | awk '
    NR == FNR { if ($2 == "installed") have[$1] = 1; next }
    !($1 in have) { print $1 }' - build/packages.wanted
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

# Whether nothing is missing but what some tests or documents need.
can_build()
{
  development=libvtk9-dev
  [ $preset = vtk ] || development=paraview-dev
  for package in g++ cmake ninja-build libglm-dev libembree-dev libcgal-dev libusb-1.0-0-dev \
    $development; do
    installed $package || return 1
  done
}

apt_install() { $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q --no-install-recommends \
  --no-remove install "$@"; } # --no-remove: rather no package than one less

install_packages()
{
  missing=$(missing_of "$1")
  if [ -z "$missing" ]; then
    say "Packages: all installed"
    return 0
  fi
  say "Packages: $(echo "$missing" | wc -l) missing:" $missing
  if ! find_root; then
    cat >&2 <<END
==> These packages are missing, and installing them needs root or sudo, which this user does not
    have. Ask somebody who has to run, as root,

      apt-get update
      apt-get install --no-install-recommends --no-remove $(echo $missing)

    and run this again. (0.6 to 1.3 GB are downloaded; installed and built they take 4 to 6 GB.)
END
    [ $preset = vtk ] ||
      echo "    Without the ParaView plugin fewer are needed: --vtk names them." >&2
    if can_build; then
      say "Going on without them: what the build itself needs is here."
      return 0
    fi
    exit 1
  fi
  run_logged build/packages.log $as_root apt-get -q update ||
    warn "apt-get update failed (log: build/packages.log). Going on with the lists that are there."
  size=$(apt_install --assume-no $missing 2>/dev/null |
    grep -E '^(Need to get|After this operation|  Download size|  Space needed)' | tr '\n' ' ') || true
  say "Installing them, in some minutes (log: build/packages.log). ${size:-}"
  if run_logged build/packages.log apt_install -y $missing; then
    say "Packages: installed"
    new_packages=yes
  else
    tail -n 20 build/packages.log >&2
    warn "apt-get failed (see above). Is the network up? Going on with what is found."
  fi
}

# --- packages -------------------------------------------------------------------------------------
new_packages=
release=
if [ -r /etc/os-release ] && command -v dpkg-query >/dev/null; then
  # A Debian has no number before its release.
  release=$(. /etc/os-release && case ${VERSION_CODENAME:-} in
    forky) echo "${ID:-}-14" ;;
    *) echo "${ID:-}-${VERSION_ID:-}" ;;
  esac)
fi
list=Testing/packages-$release.txt
case $release in
  debian-12|debian-13)
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
    ;;
  debian-14)
    # Its ParaView is made with its VTK: both can be installed.
    [ $preset = paraview ] || list=Testing/packages-$release-vtk.txt
    install_packages "$list"
    ;;
  *)
    say "This is not Debian 12, 13 or 14: nothing gets installed here. Needed are a C++17 compiler,"
    say "CMake 3.22, Ninja, Python 3 with its headers, GLM, Embree 3 or 4, CGAL 5.5 and libusb, with"
    say "VTK 9.1 or ParaView 5.11 (or later), their development files and Python modules, and for"
    say "the tests GoogleTest and Xvfb. By the names of Debian 14,"
    tests=yes # all names
    say "with ParaView (for the plugin):" $(packages_of Testing/packages-debian-14.txt)
    say "with VTK alone (--vtk):" $(packages_of Testing/packages-debian-14-vtk.txt)
    if [ $preset = paraview ] && ! command -v pvpython >/dev/null; then
      say "There is no pvpython here, so no ParaView: building against VTK alone."
      preset=vtk
    fi
    ;;
esac
if [ -r "$list" ]; then # a Debian that is known
  for list in $more; do
    install_packages "$list"
  done
fi
[ -z "$packages_only" ] || exit 0

needed=
for tool in cmake ninja c++ /usr/bin/python3; do
  command -v $tool >/dev/null || needed="$needed $tool"
done
if [ -n "$needed" ]; then
  echo "==> Cannot build: there is no$needed here (see above for the packages)." >&2
  exit 1
fi

# --- configure ------------------------------------------------------------------------------------
plugin=OFF
[ $preset = paraview ] && plugin=ON
if [ -f build/CMakeCache.txt ] &&
  ! grep -qx "HAPTICS_BUILD_PARAVIEW_PLUGIN:[A-Z]*=$plugin" build/CMakeCache.txt; then
  say "build/ was of the other kind: configuring it anew" # objects that are the same stay
  rm -f build/CMakeCache.txt build/build.ninja
fi
if [ ! -f build/build.ninja ] || [ CMakePresets.json -nt build/build.ninja ] ||
  [ -n "$new_packages" ]; then
  say "Configuring (preset $preset; log: build/configure.log)"
  if ! run_logged build/configure.log cmake --preset "$preset" $strict; then
    cat build/configure.log >&2
    echo "==> Configuring failed: the first error above names what is missing." >&2
    exit 1
  fi
fi

# --- build ----------------------------------------------------------------------------------------
say "Building${tests:+, with the tests}"
cmake --build build --target all ${tests:+tests}
say "Built. To use it from a shell:  . build/env.sh"
