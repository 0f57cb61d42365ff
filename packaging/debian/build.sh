#!/bin/sh
# Makes Debian packages of the commit that is checked out.
# Usage: sh packaging/debian/build.sh [--paraview] [FOLDER]
#   --paraview   the plugin, for the ParaView that is installed; else the libraries for VTK
#   FOLDER       where the packages go (default: packages/ next to the sources)
set -eu
case ${1:-} in -h|--help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; exit ;; esac
profile=
if [ "${1:-}" = --paraview ]; then
  profile=pkg.vtkhaptics.paraview
  shift
fi
root=$(cd "$(dirname "$0")/../.." && pwd)
out=${1:-$root/packages}
version=$(sed -n 's/^project(VTKHaptics VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM # dash runs no EXIT trap where a signal ends it
tree=$work/vtkhaptics-$version
git -C "$root" archive --prefix="vtkhaptics-$version/" HEAD | tar -x -C "$work"
tar -C "$work" -czf "$work/vtkhaptics_$version.orig.tar.gz" "vtkhaptics-$version"
cp -r "$tree/packaging/debian" "$tree/debian"
rm "$tree/debian/build.sh" "$tree/debian/check.sh"
(cd "$tree" && DEB_BUILD_PROFILES=$profile dpkg-buildpackage -b -us -uc)
mkdir -p "$out"
mv "$work"/*.deb "$work"/*.changes "$work"/*.buildinfo "$out"
ls "$out"
