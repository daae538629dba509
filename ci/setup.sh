#!/bin/sh
# Make the virtual environment $1 from requirements.lock; install Icarus Verilog where that is possible.
set -eu
venv=$1
python=${PYTHON:-python3}
fail() { echo "setup: $*" >&2; exit 1; }

case $PWD in *[[:space:]]*)
    fail "the path '$PWD' has a space, with which make and Verilator cannot work; move the checkout" ;; esac
# root may write into anything but a read-only file system: try it
( : > .writable ) 2> /dev/null ||
    fail "$PWD cannot be written to; .venv and build belong there: copy or clone it to where you may write"
rm -f .writable

command -v "$python" > /dev/null || fail "there is no '$python'; give a Python 3.11 or newer with make PYTHON=..."
version=$("$python" -c 'import sys; print("python", *sys.version_info[:2])' 2> /dev/null < /dev/null) || version=
case $version in
    "python 3 "*) [ "${version#python 3 }" -ge 11 ] || fail "Python 3.11 or newer is needed, '$python' is $version" ;;
    *) fail "'$python' is no Python 3; give a Python 3.11 or newer with make PYTHON=..." ;;
esac
command -v g++ > /dev/null || command -v c++ > /dev/null || command -v clang++ > /dev/null ||
    fail "a C++ compiler (g++, c++ or clang++) is missing; install it from your system's packages"
for tool in make perl git; do
    command -v $tool > /dev/null || fail "$tool is missing; install it from your system's packages"
done

icarus() {  # from the system's packages, where one may
    case ${SIM:-} in verilator) return ;; esac
    command -v iverilog > /dev/null && return
    sudo=
    [ "$(id -u)" = 0 ] || sudo="sudo -n"
    if command -v apt-get > /dev/null && $sudo true 2> /dev/null; then
        echo "setup: installing Icarus Verilog from the system's packages"
        $sudo apt-get -qq update > /dev/null 2>&1 || true
        DEBIAN_FRONTEND=noninteractive $sudo apt-get -qq install -y iverilog > /dev/null 2>&1 || true
    fi
}

# an interrupted run leaves an environment without pip: begin again
"$venv/bin/python" -m pip --version > /dev/null 2>&1 || {
    rm -rf "$venv"
    "$python" -m venv "$venv" > /dev/null 2>&1 ||
        fail "'$python -m venv' does not work; install the venv module (Debian: apt-get install python3-venv)"
}
pip() { "$venv/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }
mkdir -p build
icarus &  # while the packages come
# the lock names every package: nothing to resolve
pip install --no-compile --no-deps -r requirements.lock 2> build/setup.log || {
    tail -n 2 build/setup.log >&2
    fail "packages of requirements.lock could not be installed (build/setup.log); the first time needs the network"
}
pip install --no-deps --no-build-isolation --editable . 2> build/setup.log || {
    tail -n 2 build/setup.log >&2
    fail "the package itself could not be installed (build/setup.log)"
}
wait
[ "${SIM:-}" = verilator ] || command -v iverilog > /dev/null ||
    echo "setup: Icarus Verilog is not installed and cannot be from here; the benches run on Verilator alone"
