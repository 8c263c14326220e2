# SPDX-License-Identifier: AGPL-3.0-or-later
# Shared by scripts/test and scripts/demo: what has to be installed, and how to configure and build.

set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

# What the build and the tests need on Debian 12. Keep in step with the find_package calls in CMakeLists.txt.
build_packages=(g++ cmake ninja-build ccache
    libvtk9-dev libtet1.5-dev libcgns-dev libhdf5-dev libtbb-dev zlib1g-dev libcli11-dev nlohmann-json3-dev libtomlplusplus-dev
    libgtest-dev librapidcheck-dev libbenchmark-dev python3 scdoc)
# Other programs' readers, against which the tests hold our files, and what checks the formatting.
client_packages=(gmsh tetgen cgns-convert openfoam calculix-ccx python3-vtk9 clang-format-14
    libopm-simulators-bin libopm-grid-bin libopm-common-bin python3-opm-common chromium-headless-shell)
# Brings vtk.js for HTML reports while they are built. An npm from elsewhere stays.
command -v npm >/dev/null || client_packages+=(npm)

say() { printf '%s\n' "== $*"; }
fail() {
    printf '%s\n' "$0: $*" >&2
    exit 1
}

# The packages among the arguments that are not installed, one per line.
missing_packages() {
    local have
    have=$(dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' "$@" 2>/dev/null | awk '$1 == "ii" { print $2 }') || true
    for package in "$@"; do
        grep -qxF -e "$package" <<<"$have" || printf '%s\n' "$package"
    done
}

# Installs what is missing; neither asks anything nor says anything about what is there.
install_packages() {
    if ! command -v dpkg-query >/dev/null; then
        say "This is not Debian: taking it for granted that these are installed under their names here: $*"
        return
    fi
    local missing=()
    mapfile -t missing < <(missing_packages "$@")
    ((${#missing[@]})) || return 0

    local as_root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null || fail "neither root nor sudo; as root: apt-get install --no-install-recommends ${missing[*]}"
        as_root=(sudo)
    fi
    local log
    log=$(mktemp)
    say "Installing ${missing[*]}"
    if ! { "${as_root[@]}" apt-get -o Acquire::Retries=3 -qq update &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 -qq -y \
            --no-install-recommends install "${missing[@]}"; } </dev/null >"$log" 2>&1; then
        tail -n 40 "$log" >&2
        rm -f "$log"
        fail "apt-get could not install ${missing[*]}"
    fi
    rm -f "$log"
}

# As many compilers at once as there are processors and 1.5 GB of free memory each (VTK and CGAL units are large).
build_jobs() {
    local processors memory
    processors=$(nproc)
    memory=$(awk '$1 == "MemAvailable:" { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null) || true
    [[ $memory =~ ^[1-9] ]] || memory=1
    echo $((processors < memory ? processors : memory))
}

# configure_and_build PRESET [TARGET...]: all targets where none is named.
configure_and_build() {
    local preset=$1 log=build/configure-$1.log
    shift
    mkdir -p build
    cmake --preset "$preset" >"$log" 2>&1 || {
        cat "$log" >&2
        fail "cmake could not configure the preset $preset"
    }
    say "Building in build/$preset"
    cmake --build "build/$preset" --parallel "$(build_jobs)" ${1+--target "$@"}
}
