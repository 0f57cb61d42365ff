#!/bin/sh
# Sets up, builds and runs every test. The exit status is zero only if all of them passed.
set -eu

usage()
{
  cat <<'END'
Usage: sh Testing/test.sh [--vtk] [--slow] [--help] [CTEST-ARGUMENT...]

Installs what is missing, builds into build/ and runs the tests, on a virtual display where there is
none; names at the end what was skipped, and why. Further arguments go to ctest: "-R Core" runs the tests with Core in their name.

  --vtk   against VTK alone, without the ParaView plugin (see Testing/setup.sh --help)
  --slow  the slow tests too: the USB driver against a real kernel in a virtual machine
END
}

cd "$(dirname "$0")/.."
setup_arguments=
configuration=
while :; do
  case ${1:-} in
    --vtk) setup_arguments="$setup_arguments --vtk" ;;
    --slow) setup_arguments="$setup_arguments --slow"; configuration='-C Slow' ;;
    -h|--help) usage; exit 0 ;;
    *) break ;;
  esac
  shift
done
# ctest itself ignores options that it does not know.
for argument; do
  case $argument in
    --*)
      if command -v ctest >/dev/null && ! ctest --help | grep -q -e "${argument%%=*}"; then
        echo "test.sh: '$argument' is no option of ctest, nor one of this script in front." >&2
        usage >&2
        exit 2
      fi
      ;;
  esac
done

sh Testing/setup.sh --tests $setup_arguments

# Open MPI, which pvserver and pvpython start, refuses to run as root (as in a container) unless allowed.
if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
display=
if [ -z "${DISPLAY:-}" ]; then
  # -noreset: an X server that starts anew when a test closes its last window refuses the next test.
  display='xvfb-run -a -s "-noreset -screen 0 1280x1024x24"'
  if ! command -v xvfb-run >/dev/null; then
    echo "test.sh: no display, and xvfb-run is missing: install xvfb and xauth." >&2
    exit 1
  fi
fi

# In the background a shell has these two ignored, and all that it starts too: tests send them.
signals='env --default-signal=INT,QUIT'
$signals true 2>/dev/null || signals=

echo "==> Testing${display:+ on a virtual display}"
status=0
report=build/Testing/report.xml
rm -f "$report"
eval "$display" $signals ctest --test-dir build --output-on-failure --no-label-summary --no-tests=error \
  -j "$(nproc)" --output-junit "$PWD/$report" $configuration '"$@"' || status=$?
[ ! -f "$report" ] || /usr/bin/python3 Testing/list_skips.py "$report"
if [ "$status" -ne 0 ]; then
  echo "==> Tests failed; all output: build/Testing/Temporary/LastTest.log" >&2
fi
exit "$status"
