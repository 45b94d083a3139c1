#!/usr/bin/env bash
# The study, and the example in real time; see usage below.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat <<'END'
Usage: examples/run.sh [--window | --headless | --timings | --scaling | --plans | --benchmark] [--no-install]
                       [options of the program]

Installs what the examples need (Debian, Ubuntu), builds them in build/examples and runs the study: each method
beside ray-traced truth on many scenes, with what it costs. It prints a table and writes out/study/index.html.

  --window      the methods in real time, in a window, beside the truth
  --headless    the same without a window: pictures, times, comparison with the C++
  --timings     time every method on the GPU; writes out/opengl/timings.csv
  --scaling     measure cost against the size of the scene; writes out/scaling/index.html
  --plans       measure what plans save, scene by scene; writes out/plans/plans.md
  --benchmark   run the benchmark of the prefilters; writes out/benchmark/prefilter.json
  --no-install  take the packages as they are
  --help        this text and, once built, the program's own options
Further options go to the program: `examples/run.sh --scene bunny --quick`,
`examples/run.sh --mesh teapot.obj --out /tmp/teapot`, `examples/run.sh --window --scene bunny --light disk`,
`examples/run.sh --headless --scene spheres --method occlusion_texture --panels --out spheres.png`.
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
        --window) program=opengl_example ;;
        --headless) program=opengl_example options+=("$1") ;;
        --timings) program=opengl_example options+=("$1" "$root/out/opengl/timings.csv") ;;
        --scaling) folder=scaling options+=("$1") ;;
        --plans) folder=plans options+=("$1") ;;
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
    libepoxy-dev libegl-dev libgl1 libgl1-mesa-dri libglfw3-dev libimgui-dev \
    glmark2-data fonts-dejavu-core gnuplot-nox libjs-chart.js

echo "== Building"
cmake -S "$root" -B "$build" -DPENUMBRA_BUILD_TESTS=OFF
cmake --build "$build" --target "$program"

if [[ $program == study ]]; then
    echo "== Running"
    "$build/study" --out "${out:-$root/out/$folder}" "${options[@]}"
elif [[ $program == opengl_example ]]; then
    echo "== Running"
    mkdir -p "$root/out/opengl"
    if [[ $out ]]; then options+=(--out "$out"); fi
    "$build/opengl_example" "${options[@]}"
else
    mkdir -p "$root/out/benchmark"
    report=$root/out/benchmark/prefilter.json
    "$build/prefilter_benchmark" --benchmark_out_format=json --benchmark_out="$report" "${options[@]}"
    echo "Written to $report"
fi
