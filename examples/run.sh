#!/usr/bin/env bash
# The study: accuracy against time; see usage below.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat <<'END'
Usage: examples/run.sh [--no-install] [--benchmark] [options of the program]

Installs what the examples need (Debian, Ubuntu), builds them in build/examples and runs the study: each method
beside ray-traced truth on many scenes, with what it costs. It prints a table and writes out/study/index.html.

  --scaling     measure cost against the size of the scene instead; writes out/scaling/index.html
  --benchmark   run the benchmark of the prefilters instead; writes out/benchmark/prefilter.json
  --no-install  take the packages as they are
  --help        this text and, once built, the program's own options
Further options go to the program: `examples/run.sh --scene bunny --quick`,
`examples/run.sh --mesh teapot.obj --out /tmp/teapot`.
END
}

build=$root/build/examples
help=false
program=study
folder=study
out=
options=()
while (($#)); do
    case $1 in
        --help | -h) help=true ;;
        --benchmark) program=prefilter_benchmark ;;
        --no-install) export PENUMBRA_NO_INSTALL=1 ;;
        --scaling) folder=scaling options+=("$1") ;;
        --out) out=${2:?--out needs a folder} && shift ;;
        --out=*) out=${1#--out=} ;;
        *) options+=("$1") ;;
    esac
    shift
done
if $help; then
    usage
    if [[ -x $build/$program ]]; then "$build/$program" --help; fi
    exit 0
fi

source "$root/.ci/setup.sh"
# zlib is what assimp's CMake package asks for without depending on it; the last line is data: the bunny, and what
# pictures, plots and the page are made with.
require_packages g++ cmake ninja-build libglm-dev libembree-dev libcli11-dev nlohmann-json3-dev libfmt-dev \
    libassimp-dev zlib1g-dev libstb-dev libbenchmark-dev libopencv-imgproc-dev \
    glmark2-data fonts-dejavu-core gnuplot-nox libjs-chart.js

echo "== Building"
cmake -S "$root" -B "$build" -DPENUMBRA_BUILD_TESTS=OFF
cmake --build "$build"

if [[ $program == study ]]; then
    echo "== Running"
    "$build/study" --out "${out:-$root/out/$folder}" "${options[@]}"
else
    mkdir -p "$root/out/benchmark"
    report=$root/out/benchmark/prefilter.json
    "$build/prefilter_benchmark" --benchmark_out_format=json --benchmark_out="$report" "${options[@]}"
    echo "Written to $report"
fi
