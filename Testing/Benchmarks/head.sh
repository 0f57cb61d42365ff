# Sourced by the scripts in this folder, which set `root` and `build`.

# Prints one value of the build folder's cache.
cached()
{
  sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"
}

# Prints on what machine, with what compiler and from what commit a table is about to be made.
print_head()
{
  echo "# machine: $(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | sort -u | head -1), $(nproc) cores"
  echo "# system: $(sed -n 's/^PRETTY_NAME="\(.*\)"/\1/p' /etc/os-release)"
  echo "# compiler: $("$(cached CMAKE_CXX_COMPILER)" --version | head -1), $(cached CMAKE_BUILD_TYPE)"
  echo "# commit: $(git -C "$root" rev-parse --short HEAD 2>/dev/null || echo unknown)"
  echo "# date: $(date +%Y-%m-%d), load when started: $(cut -d ' ' -f 1 /proc/loadavg)"
}

# Sets the variables of these names to files that are gone when the script ends, or is ended.
make_scratch()
{
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  trap 'exit 1' HUP INT TERM # dash runs no EXIT trap where a signal ends it
  for name; do
    eval "$name=\$scratch/$name"
  done
}

# write_whole TARGET SOURCE: puts a copy of a file in place of another, as a whole or not at all.
# write_whole TARGET: fails where that would, before work is lost.
write_whole()
{
  /usr/bin/python3 - "$root/Interactors/Python/vtkhaptics" "$@" <<'END'
import sys
folder, target, *sources = sys.argv[1:]
sys.path.append(folder)
from output import OutputError, check_outputs, write_bytes
try:
    check_outputs([target])
    for source in sources:
        with open(source, "rb") as file:
            write_bytes(target, file.read())
except OutputError as error:
    sys.exit(str(error))
END
}
