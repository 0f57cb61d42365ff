#!/bin/sh
# Sets up, builds, and touches a real surface with the simulated device for about ten seconds.
set -eu

usage()
{
  cat <<'END'
Usage: sh Testing/demo.sh [--vtk] [--surface NAME-OR-FILE] [--output DIR] [--offscreen] [--help]

Touches a surface with the simulated device through the 1 kHz servo thread, in a window where there
is a display, off screen where there is none. Leaves in DIR a picture (.png) and a trace (.vtp, one
point a tick), and prints a table of what was measured.

  --surface   a name out of "python3 Data/get_surfaces.py --list", or a file (STL, PLY, OBJ, VTP,
              VTK); default: gearbox, a CAD model, or a knot of this project's own where the gearbox
              cannot be had
  --output    default: build/demo
  --offscreen open no window
  --vtk       against VTK alone, without the ParaView plugin (see Testing/setup.sh --help)
END
}

here=$PWD
cd "$(dirname "$0")/.."
setup_arguments=
surface=
output=build/demo
offscreen=
from_here() { case $1 in /*) echo "$1" ;; *) echo "$here/$1" ;; esac; }
while [ $# -gt 0 ]; do
  case $1 in
    --vtk) setup_arguments=--vtk ;;
    --offscreen) offscreen=--offscreen ;;
    --surface|--output)
      if [ $# -lt 2 ]; then
        echo "demo.sh: $1 needs a value" >&2
        exit 2
      fi
      if [ "$1" = --output ]; then
        output=$(from_here "$2")
      else
        surface=$2
        # A name has neither a folder nor a suffix.
        case $surface in */*|*.*) surface=$(from_here "$surface") ;; esac
      fi
      shift
      ;;
    -h|--help) usage; exit 0 ;;
    *) echo "demo.sh: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done

sh Testing/setup.sh $setup_arguments
. build/env.sh

case $surface in
  /*) ;;
  '')
    echo "==> Getting the surface 'gearbox'"
    surface=$(/usr/bin/python3 Data/get_surfaces.py --fallback gearbox)
    ;;
  *)
    echo "==> Getting the surface '$surface'"
    surface=$(/usr/bin/python3 Data/get_surfaces.py "$surface")
    ;;
esac

if [ -z "${DISPLAY:-}" ]; then
  offscreen=--offscreen # under a virtual display, where VTK needs one
fi
echo "==> Touching $surface; picture and trace go to $output"
# In the place of this shell, so that what ends this ends that, with its results written.
exec /usr/bin/python3 -m vtkhaptics.demo --surface "$surface" --output "$output" $offscreen
