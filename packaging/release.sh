#!/bin/sh
# Makes and checks what a release consists of, of the commit that is checked out.
# Usage: sh packaging/release.sh [--wheel PYTHON]... [--standin ROOT] [--paraview] [--root ROOT]
#                                [--since FOLDER] OUT
#   --wheel     a wheel for pip's VTK and that Python too, and the sdist; once for each Python
#   --standin   a root of Debian 14 for the wheels, where pip has no vtk-sdk (wheel/build.sh)
#   --paraview  the Debian package of the plugin; else those of the libraries. The two stacks exclude
#               each other on Debian 12 and 13: run it once on a system of each
#   --root      a root of the same Debian that has nothing in it but /proc and /dev, as by debootstrap:
#               the packages are installed, used and removed there, as root (debian/check.sh)
#   --since     the Debian packages of an earlier release of the same major version, with those of
#               its debugging symbols: what was linked to it has to run with this one (abipkgdiff)
# OUT gets the sources, packages, wheels and SHA256SUMS. Run the tests first: sh Testing/test.sh --slow.
set -eu
case ${1:-} in -h|--help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; exit ;; esac
pythons=
standin=
paraview=
clean=
since=
while [ $# -gt 1 ]; do
  case $1 in
    --wheel) pythons="$pythons $2"; shift ;;
    --standin) standin=$(realpath "$2"); shift ;;
    --paraview) paraview=--paraview ;;
    --root) clean=$(realpath "$2"); shift ;;
    --since) since=$(realpath "$2"); shift ;;
    *) sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
  shift
done
[ $# -eq 1 ] && [ "${1#-}" = "$1" ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
out=$(realpath -m "$1")
say() { printf '==> %s\n' "$*"; }

# Before anything takes long.
missing=
for tool in dpkg-buildpackage=dpkg-dev dh=debhelper dh_python3=dh-python lintian=lintian \
  desktop-file-validate=desktop-file-utils appstreamcli=appstream man=man-db ${since:+abipkgdiff=abigail-tools}; do
  command -v "${tool%=*}" >/dev/null || missing="$missing ${tool#*=}"
done
[ -z "$missing" ] || { echo "release.sh: first: apt-get install$missing" >&2; exit 1; }

say "Versions agree, and the tree is what is committed"
/usr/bin/python3 "$root/Testing/TestVersions.py" "$root"
[ -z "$(git -C "$root" status --porcelain)" ] || { echo "release.sh: commit first" >&2; exit 1; }
version=$(sed -n 's/^project(VTKHaptics VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
mkdir -p "$out"

say "Sources"
git -C "$root" archive --prefix="vtkhaptics-$version/" -o "$out/vtkhaptics-$version-source.tar.gz" HEAD
for python in $pythons; do
  say "Wheel and sdist, $("$python" --version)"
  sh "$root/packaging/wheel/build.sh" ${standin:+--standin "$standin"} "$python" "$out"
  tag=$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
  sh "$root/packaging/wheel/check.sh" "$out"/vtkhaptics-"$version-$tag"-*.whl "$python"
done
say "Debian packages"
sh "$root/packaging/debian/build.sh" $paraview "$out"
lintian --fail-on error "$out"/*.changes
if [ -n "$since" ] && [ -z "$paraview" ]; then
  say "Interface of the libraries, against $since"
  status=0
  abipkgdiff --fail-no-dbg --no-added-syms \
    --d1 "$since"/libvtkhaptics-dbgsym_*.deb --devel1 "$since"/libvtkhaptics-dev_*.deb \
    --d2 "$out"/libvtkhaptics-dbgsym_*.deb --devel2 "$out"/libvtkhaptics-dev_*.deb \
    "$since"/libvtkhaptics_*.deb "$out"/libvtkhaptics_*.deb || status=$?
  # Its bits: 1 and 2 are errors, 4 is any change, 8 one that breaks what was linked before.
  [ $((status & 11)) -eq 0 ] || { echo "release.sh: that is no version $version" >&2; exit 1; }
fi
if [ -n "$clean" ]; then
  say "Debian packages, in $clean"
  tried=$(mktemp -d "$clean/tmp/packages.XXXXXX")
  cp "$root/packaging/debian/check.sh" "$out"/*.deb "$tried"
  cp /etc/resolv.conf "$clean/etc/"
  env -i LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$clean" \
    sh -c 'apt-get -q update >/dev/null && sh "$0/check.sh" "$0"' "/tmp/$(basename "$tried")"
  rm -r "$tried"
fi
say "Recipes and desktop data"
desktop-file-validate "$root"/packaging/linux/*.desktop
# AppStream 1.0 fails where there is no homepage, which the project does not have.
case $(appstreamcli --version) in
  *\ 0.*) no_homepage= ;;
  *) no_homepage='--override url-homepage-missing=info' ;;
esac
appstreamcli validate --no-net $no_homepage "$root"/packaging/linux/*.metainfo.xml
for page in "$root"/packaging/linux/*.1; do
  [ -z "$(man --warnings -l "$page" 2>&1 >/dev/null)" ] || { echo "release.sh: $page has warnings" >&2; exit 1; }
done
/usr/bin/python3 -B -c 'import ast, sys; ast.parse(open(sys.argv[1]).read())' \
  "$root/packaging/spack/packages/vtk_haptics/package.py"
if /usr/bin/python3 -c 'import rattler_build' 2>/dev/null; then
  /usr/bin/python3 "$root/packaging/conda/check.py"
else
  say "conda/recipe.yaml was not read: there is no py-rattler-build"
fi
(cd "$out" && sha256sum ./*.tar.gz ./*.deb $(ls ./*.whl 2>/dev/null) >SHA256SUMS)
say "In $out:"
cat "$out/SHA256SUMS"
