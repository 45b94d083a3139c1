#!/usr/bin/env bash
# All tests; see usage below.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat <<'END'
Usage: tests/run.sh [--quick] [--mutants] [--no-install] [ctest's options]

Installs what the tests need (Debian, Ubuntu), builds them below build/tests and runs them:
  g++/        C++17, -O2, the GLSL twins on a driver, every variant of compilation, the installed package
  clang++/    C++20, -O1, every variant of compilation but GLM's macros and each header alone
  fast-math/  -O3 -ffast-math
  sanitize/   address and undefined-behaviour sanitizers

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
    libgl1-mesa-dri glslang-tools spirv-tools spirv-cross "$browser"

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
    suite clang++ -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_STANDARD=20 -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DPENUMBRA_TEST_DRIVER=OFF
    suite fast-math -DCMAKE_CXX_COMPILER=g++ -DCMAKE_CXX_FLAGS=-ffast-math -DPENUMBRA_TEST_BUILDS=OFF
    # g++'s -Wmaybe-uninitialized raises a false alarm in std::regex under the sanitizers.
    suite sanitize -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Sanitize -DPENUMBRA_TEST_BUILDS=OFF -DPENUMBRA_TEST_DRIVER=OFF \
        -DCMAKE_CXX_FLAGS_SANITIZE="-O1 -g1 -D_GLIBCXX_ASSERTIONS -fno-sanitize-recover=all \
-fsanitize=address,undefined,float-divide-by-zero,float-cast-overflow" -DCMAKE_CXX_FLAGS=-Wno-maybe-uninitialized
fi

# One ctest over all of them.
printf 'subdirs("%s")\n' "${suites[@]}" >"$build/CTestTestfile.cmake"
echo "== Running; results in $build/results.xml, all output in $build/Testing/Temporary/LastTest.log"
ctest --test-dir "$build" --output-on-failure --no-tests=error --output-junit "$build/results.xml" "${ctest_options[@]}"
if $mutants; then
    echo "== Breaking the twins"
    "$root/tests/glsl/mutants.sh"
fi
