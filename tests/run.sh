#!/usr/bin/env bash
# All tests; see usage below.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat <<'END'
Usage: tests/run.sh [--quick] [--mutants] [--no-install] [ctest's options]

Installs what the tests need (Debian, Ubuntu), builds them below build/tests and runs them:
  g++/        C++17, -O2, the GLSL twins and the OpenGL example on a driver, every variant of compilation, the
              installed package
  clang++/    C++20, -O1, address and undefined-behaviour sanitizers, every variant of compilation but GLM's macros
              and each header alone, the installed package
  fast-math/  g++, -O3 -ffast-math

  --quick       g++/ only
  --mutants     afterwards breaks the GLSL twins, one constant, sign or comparison at a time: do the tests notice?
  --no-install  take the packages as they are
  --help        this text
Further options go to ctest: `tests/run.sh -R n_buffer`.
END
}

quick=false mutants=false
ctest_options=()
for argument in "$@"; do
    case $argument in
        --help | -h) usage; exit 0 ;;
        --quick) quick=true ;;
        --mutants) mutants=true ;;
        --no-install) export PENUMBRA_NO_INSTALL=1 ;;
        *) ctest_options+=("$argument") ;;
    esac
done

source "$root/.ci/setup.sh"
browser=chromium
if grep -qs '^ID=ubuntu' /etc/os-release; then browser=chromium-browser; fi
require_packages g++ clang cmake ninja-build libglm-dev doctest-dev libembree-dev libepoxy-dev libegl-dev \
    libgl1 libgl1-mesa-dri glslang-tools spirv-tools spirv-cross "$browser" libcli11-dev libfmt-dev libassimp-dev zlib1g-dev \
    libstb-dev libglfw3-dev libimgui-dev glmark2-data fonts-dejavu-core xvfb xauth

# Some systems keep clang's sanitizers apart.
clang_version=$(clang++ -dumpversion)
if ! $quick && ! ls "$(clang++ -print-resource-dir)"/lib/*/libclang_rt.asan* >/dev/null 2>&1; then
    require_packages "libclang-rt-${clang_version%%.*}-dev"
fi

build=$root/build/tests
suites=()
suite() {  # name, CMake options...
    local name=$1
    suites+=("$name")
    echo "== Building $name"
    cmake -S "$root" -B "$build/$name" -DPENUMBRA_TEST_PREFIX="$name/" -DPENUMBRA_BUILD_EXAMPLES=OFF "${@:2}"
    cmake --build "$build/$name"
}
suite g++ -DCMAKE_CXX_COMPILER=g++ -DCMAKE_CXX_FLAGS_RELEASE=-O2
if ! $quick; then
    suite clang++ -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_STANDARD=20 -DPENUMBRA_TEST_DRIVER=OFF \
        -DCMAKE_BUILD_TYPE=Sanitize -DCMAKE_CXX_FLAGS_SANITIZE="-O1 -g1 -D_GLIBCXX_ASSERTIONS \
-fno-sanitize-recover=all -fsanitize=address,undefined,float-divide-by-zero,float-cast-overflow"
    suite fast-math -DCMAKE_CXX_COMPILER=g++ -DCMAKE_CXX_FLAGS=-ffast-math -DPENUMBRA_TEST_BUILDS=OFF \
        -DPENUMBRA_TEST_DRIVER=OFF
fi

# One ctest over all of them.
printf 'subdirs("%s")\n' "${suites[@]}" >"$build/CTestTestfile.cmake"
echo "== Running; results in $build/results.xml, all output in $build/Testing/Temporary/LastTest.log"
ctest --test-dir "$build" --output-on-failure --no-tests=error --output-junit "$build/results.xml" "${ctest_options[@]}"
if $mutants; then
    echo "== Breaking the twins"
    "$root/tests/glsl/mutants.sh"
fi
