#!/bin/sh
# Tries Debian packages as their users have them: installs them, uses what each has, removes all.
# Usage: sh packaging/debian/check.sh FOLDER     as root, on a system that is there for this alone, as
#                                                one made by debootstrap --variant=minbase
# FOLDER has the packages that build.sh made, of the libraries or of the plugin.
set -eu
case ${1:-} in -h|--help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; exit ;; esac
[ $# -eq 1 ] && [ -d "$1" ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
packages=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM # dash runs no EXIT trap where a signal ends it
export DEBIAN_FRONTEND=noninteractive HOME="$work" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
say() { printf '==> %s\n' "$*"; }
get() { apt-get -q -y --no-install-recommends install "$@" >"$work/apt.log" 2>&1 || { tail "$work/apt.log"; exit 1; }; }
in_window() { xvfb-run -a -s "-noreset -screen 0 1280x1024x24" "$@"; }
# What a command prints is shown where it fails.
try() { "$@" >"$work/log" 2>&1 </dev/null || { tail -n 40 "$work/log"; echo "check.sh: failed: $*" >&2; exit 1; }; }
of_ours() { find / -xdev \( -path "$work" -o -path "$packages" -o -path /proc -o -path /sys \) -prune -o \
  \( -iname '*vtkhaptics*' -o -iname '*paraview-haptics*' -o -iname '*novint-falcon*' \) -print | sort; }

of_ours >"$work/before"
say "Install"
get xvfb xauth "$packages"/*.deb
names=$(for file in "$packages"/*.deb; do dpkg-deb -f "$file" Package; done)
dpkg --verify $names
doc=/usr/share/doc/vtkhaptics
cp -r "$doc" "$work/doc" # nothing is to be written next to what is installed
cd "$work"

say "Command and manual"
try vtkhaptics --help
try vtkhaptics --list-devices
[ -s /usr/share/man/man1/vtkhaptics.1.gz ] && [ -s /usr/share/vtkhaptics/knot.vtp ]
ls /usr/share/applications/org.vtkhaptics.*.desktop /usr/share/metainfo/org.vtkhaptics.*.xml \
  /usr/share/icons/hicolor/scalable/apps/org.vtkhaptics.Viewer.svg /usr/lib/udev/rules.d/60-novint-falcon.rules
say "Viewer and demonstration"
try in_window vtkhaptics /usr/share/vtkhaptics/knot.vtp --device simulated --seconds 2 --offscreen \
  --screenshot "$work/viewer.png"
try in_window python3 -m vtkhaptics.demo --surface /usr/share/vtkhaptics/knot.vtp \
  --output "$work/demo" --seconds 3 --offscreen
[ -s "$work/viewer.png" ] && [ -s "$work/demo/touched.png" ] && [ -s "$work/demo/trace.vtp" ]
say "Examples"
for example in offline_trace scripted_stroke probe_scalars study_closed_loop study_palpation; do
  try in_window python3 "$work/doc/Interactors/Python/examples/$example.py"
done

case " $(echo $names) " in
*" libvtkhaptics-dev "*)
  say "The project of Testing/Consumer, and the template of a device"
  get cmake g++ make
  try cmake -S "$work/doc/Testing/Consumer" -B "$work/consumer" -DCMAKE_BUILD_TYPE=Release
  try cmake --build "$work/consumer"
  try "$work/consumer/consumer"
  try cmake -S /usr/share/vtkhaptics/device -B "$work/device" -DCMAKE_BUILD_TYPE=Release
  try cmake --build "$work/device"
  try "$work/device/try_pen"
  ;;
esac
case " $(echo $names) " in
*" paraview-haptics "*)
  say "ParaView: from Python, and with its window"
  try in_window pvpython --force-offscreen-rendering "$work/doc/Plugin/examples/touch_contour.py"
  cat >"$work/window.py" <<'END_OF_SCRIPT'
import os
from paraview.simple import Sphere
from vtkhaptics.paraview import touch

hand = touch(Sphere(), Device="simulated")
hand.step(500)
open(os.environ["WHAT_WAS_TOUCHED"], "w").write(str(hand.ForceMagnitude))
os._exit(0)
END_OF_SCRIPT
  WHAT_WAS_TOUCHED=$work/touched try timeout 120 xvfb-run -a -s "-noreset -screen 0 1280x1024x24" \
    paraview-haptics --dr --script="$work/window.py"
  [ -s "$work/touched" ]
  ;;
esac

say "Remove"
apt-get -q -y purge $names >"$work/apt.log" 2>&1 || { tail "$work/apt.log"; exit 1; }
of_ours | diff "$work/before" - || { echo "check.sh: that is left" >&2; exit 1; }
say "The packages are right: $(echo $names)"
