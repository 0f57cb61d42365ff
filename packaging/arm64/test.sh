#!/bin/sh
# Compiles the core and its tests for arm64 on another machine, and runs them by QEMU.
# Usage: sh packaging/arm64/test.sh BUILD-FOLDER [GTEST-FILTER]
# Needs on Debian, as root: dpkg --add-architecture arm64, and the packages crossbuild-essential-arm64
# cmake ninja-build libglm-dev libcgal-dev:arm64 libgmp-dev:arm64 libmpfr-dev:arm64 libembree-dev:arm64
# libgtest-dev:arm64 qemu-user-static
set -eu
case ${1:-} in -h|--help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0"; exit ;; esac
here=$(cd "$(dirname "$0")" && pwd)
build=$1
cmake -S "$here" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
  -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
  -DCMAKE_CROSSCOMPILING_EMULATOR=/usr/bin/qemu-aarch64-static \
  -DCMAKE_LIBRARY_ARCHITECTURE=aarch64-linux-gnu
cmake --build "$build" --target HapticsCoreTests TestOutputFile HapticsJudgeTests
cd "$build"
for test in HapticsCoreTests TestOutputFile HapticsJudgeTests; do
  HAPTICS_SOURCE_DIR=$here/../.. qemu-aarch64-static "$(find . -name $test -type f)" --gtest_brief=1 \
    ${2:+--gtest_filter="$2"}
done
