#!/usr/bin/env bash
# Gain of a DBEF over an absorbing polarizer against the return eta and the depolarization d of the cavity: formula and
# trace. Writes dbef_gain.csv and dbef_gain.svg into DIR (default out/dbef_gain below the project).
#   examples/dbef_gain/run.sh [DIR]
# In the environment: PHOTONS of each run (1e6), SEED of the first run (1), EVENGLOW (another program).
set -euo pipefail

here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
root=$(dirname -- "$(dirname -- "$here")")

if ! command -v python3 >/dev/null; then
  echo "run.sh: needs python3 (its standard library is enough); on Debian: apt install python3" >&2
  exit 1
fi

exec python3 -B "$here/dbef_gain.py" --program "${EVENGLOW:-$root/evenglow}" --photons "${PHOTONS:-1e6}" \
  --seed "${SEED:-1}" --out "${1:-$root/out/dbef_gain}"
