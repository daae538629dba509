#!/bin/sh
# Make the virtual environment $1 from requirements.lock; install Icarus Verilog where that is possible.
set -eu
venv=$1
python=${PYTHON:-python3}
command -v "$python" > /dev/null || { echo "setup: there is no '$python'; give one with make PYTHON=..." >&2; exit 1; }
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || {
    echo "setup: Python 3.11 or newer is needed, $python is $("$python" --version 2>&1)" >&2; exit 1; }
for tool in g++ make perl git; do
    command -v $tool > /dev/null || { echo "setup: $tool is missing; install it from your system's packages" >&2; exit 1; }
done
# an interrupted run leaves an environment without pip: begin again
"$venv/bin/python" -m pip --version > /dev/null 2>&1 || { rm -rf "$venv"; "$python" -m venv "$venv"; }
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r requirements.lock
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --editable .
if ! command -v iverilog > /dev/null; then
    sudo=
    [ "$(id -u)" = 0 ] || sudo="sudo -n"
    if command -v apt-get > /dev/null && $sudo true 2> /dev/null; then
        echo "setup: installing Icarus Verilog from the system's packages"
        $sudo apt-get -qq update > /dev/null 2>&1 || true
        DEBIAN_FRONTEND=noninteractive $sudo apt-get -qq install -y iverilog > /dev/null 2>&1 || true
    fi
    command -v iverilog > /dev/null ||
        echo "setup: Icarus Verilog is not installed and cannot be from here; the benches run on Verilator alone"
fi
