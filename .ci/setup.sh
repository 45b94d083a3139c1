# Sourced by tests/run.sh and examples/run.sh: packages, and how builds run.

# Installs those of the given Debian packages that are missing. Where that cannot be done: says what is needed and
# exits with 2.
require_packages() {
    if [[ ${PENUMBRA_NO_INSTALL:-} ]]; then return; fi
    local needed="This needs (names as in Debian): $*
Install them by hand, then run again with --no-install."
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        echo "$needed" >&2
        exit 2
    fi

    local package missing=()
    for package in "$@"; do
        if [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
            missing+=("$package")
        fi
    done
    if ((${#missing[@]} == 0)); then return; fi

    local as_root=()
    if ((EUID != 0)); then
        if ! command -v sudo >/dev/null; then
            echo "$needed" >&2
            exit 2
        fi
        as_root=(sudo)
    fi
    echo "== Installing ${missing[*]}"
    "${as_root[@]}" apt-get update
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}

# Defaults that the caller's environment may override. A compiler takes up to 1 GB.
processors=$(getconf _NPROCESSORS_ONLN)
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja}
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$((processors < 16 ? processors : 16))}
export CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$CMAKE_BUILD_PARALLEL_LEVEL}
