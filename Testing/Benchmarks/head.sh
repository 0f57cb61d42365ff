# Sourced by the scripts beside it, which set `root` and `build`.

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
