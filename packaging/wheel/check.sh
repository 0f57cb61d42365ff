#!/bin/sh
# Tries a wheel as its users have it: in a new environment with pip's VTK and PyVista, away from the
# sources and from what the system has.
# Usage: sh packaging/wheel/check.sh WHEEL [PYTHON]
set -eu
case ${1:-} in -h|--help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; exit ;; esac
wheel=$(realpath "$1")
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM # dash runs no EXIT trap where a signal ends it
say() { printf '==> %s\n' "$*"; }
[ "$(wc -c <"$wheel")" -lt 20000000 ] || { echo "check.sh: $wheel is over 20 MB" >&2; exit 1; }

say "Install"
"${2:-/usr/bin/python3}" -m venv "$work/venv"
python=$work/venv/bin/python
"$python" -m pip --disable-pip-version-check -q install "$wheel" pyvista
unset PYTHONPATH LD_LIBRARY_PATH
cd "$work"
in_window() { xvfb-run -a -s "-noreset -screen 0 1280x1024x24" "$@"; }

say "Licences of what is inside"
"$python" - <<'END'
import importlib.metadata as metadata

files = [str(file) for file in metadata.files("vtkhaptics")]
bundled = [name for name in files if "vtkhaptics.libs/" in name]
listed = next(file for file in metadata.files("vtkhaptics") if file.name == "BUNDLED.txt").read_text()
assert bundled
for name in bundled:
    assert name.rpartition("/")[2] in listed, name
print(listed)
END
HAPTICS_SOURCE_DIR=$root # for the README and the examples
export HAPTICS_SOURCE_DIR
for test in Import Readme Trace Errors Devices Stubs Viewer Demo Examples Enable Files Touch \
  Headless PyVista PyVistaWindow; do
  say "Test$test.py"
  in_window "$python" "$root/Testing/Python/Test$test.py" >"$work/log" 2>&1 ||
    { tail -n 40 "$work/log"; exit 1; }
  tail -n 1 "$work/log"
done
in_window "$work/venv/bin/vtkhaptics" --help >/dev/null
say "Without VTK, and with another"
"$python" -m pip -q uninstall -y vtk
"$python" -c 'import vtkhaptics' 2>&1 | grep -q "python3 -m pip install 'vtk==" || exit 1
say "The wheel is right"
