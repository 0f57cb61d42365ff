#!/bin/sh
# Makes a stand-in for vtk-sdk where that is not to be had: the development files of Debian 14's VTK,
# which is of the same version as pip's, with the libraries of pip's.
# Usage: sh packaging/wheel/standin-sdk.sh ROOT SDK PYTHON
#   ROOT    a root of Debian 14 that has libvtk9-dev and its VTK's Python modules, as by
#           debootstrap --variant=minbase --include=libvtk9-dev,libvtk9-qt-dev forky ROOT
#   SDK     the folder to make; VTK_DIR, which is printed, lies in it
#   PYTHON  a Python into which pip has installed that vtk
set -eu
case ${1:-} in -h|--help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; exit ;; esac
root=$(realpath "$1") sdk=$(realpath -m "$2") python=$3
arch=x86_64-linux-gnu
wheel=$("$python" -c 'import os, vtkmodules; print(os.path.dirname(vtkmodules.__file__))')
version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
cmake=$sdk/lib/$arch/cmake/vtk-9.6
rm -rf "$sdk"
mkdir -p "$sdk/lib/$arch/cmake" "$sdk/include" "$sdk/bin"
cp -r "$root/usr/lib/$arch/cmake/vtk-9.6" "$cmake"
cp -r "$root/usr/include/vtk-9.6" "$sdk/include/"
cp -r "$root/usr/lib/$arch/vtk-9.6" "$sdk/lib/$arch/vtk-9.6" # hierarchies, for the wrapper
ln -s "$wheel" "$sdk/wheel"

# The wrapper's programs run by that root's loader, whatever system this is.
for program in "$root"/usr/bin/vtk*-9.6; do
  name=$(basename "$program")
  cat >"$sdk/bin/$name" <<END
#!/bin/sh
exec "$root/lib64/ld-linux-x86-64.so.2" --library-path "$root/usr/lib/$arch" "$program" "\$@"
END
  chmod +x "$sdk/bin/$name"
done

cd "$cmake"
files='VTK-targets-none.cmake VTKPython-targets-none.cmake'
# Libraries and Python modules are the wheel's.
sed -i -E "s#/lib/$arch/lib(vtk[A-Za-z0-9_.]+)-9\.6\.so\.9\.6\"#/wheel/lib\1.so\"#
  s#\"lib(vtk[A-Za-z0-9_.]+)-9\.6\.so\.[0-9]+\"#\"lib\1.so\"#
  s#/lib/python3/dist-packages/vtkmodules/#/wheel/#
  s#cpython-3[0-9]+-#cpython-$(echo "$version" | tr -d .)-#g" $files
sed -i -E "s/Core3\.[0-9]+/Core$version/g" ./*.cmake
# Modules that pip's VTK lacks are there by name only: nothing here links them.
{ grep -ohE '/wheel/[^"]+|/bin/[^"]+|/lib/[^"]+\.(so|jar)[^"]*' $files VTKJava-targets-none.cmake || true; } |
  sort -u | while read -r file; do
  [ -e "$sdk$file" ] || sed -i "s#\${_IMPORT_PREFIX}$file\"#/bin/true\"#" $files VTKJava-targets-none.cmake
done
# What Debian's VTK takes from the system and pip's has inside is there by name only too; only Python
# and the system's threads are found, and the header that a public one of VTK's includes.
cat >VTK-vtk-module-find-packages.cmake <<'END'
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(Threads REQUIRED)
END
sed -i 's/_HAS_VISKORES" "ON"/_HAS_VISKORES" "OFF"/; s/_HAS_VTKm" "ON"/_HAS_VTKm" "OFF"/' vtk-config.cmake
mkdir -p "$sdk/include/system"
cp -r "$root/usr/include/nlohmann" "$sdk/include/system/"
sed -i 's/TBB::tbb;\?//g' VTK-targets.cmake
others=$(grep INTERFACE_LINK_LIBRARIES VTK-targets.cmake | grep -oE '[A-Za-z0-9_]+::[A-Za-z0-9_]+' |
  grep -vE '^(VTK|Python3|Threads|nlohmann_json)::' | sort -u | tr '\n' ' ')
cat >others.cmake <<END
foreach (target nlohmann_json::nlohmann_json $others)
  if (NOT TARGET \${target})
    add_library(\${target} INTERFACE IMPORTED GLOBAL)
  endif ()
endforeach ()
set_target_properties(nlohmann_json::nlohmann_json PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "$sdk/include/system")
END
sed -i '1i include("${CMAKE_CURRENT_LIST_DIR}/others.cmake")' vtk-config.cmake
# Debian's VTK divides work by TBB, pip's by threads of its own: templates must agree with it.
sed -i 's/define VTK_SMP_ENABLE_TBB 1/define VTK_SMP_ENABLE_TBB 0/
  s/DEFAULT_IMPLEMENTATION_TBB 1/DEFAULT_IMPLEMENTATION_TBB 0/
  s/DEFAULT_IMPLEMENTATION_SEQUENTIAL 0/DEFAULT_IMPLEMENTATION_SEQUENTIAL 1/' "$sdk/include/vtk-9.6/vtkSMP.h"
echo "VTK_DIR=$cmake"
