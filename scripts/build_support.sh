# shellcheck shell=bash disable=SC2034,SC2154
# What ./evenglow and ./test share: Debian packages, one build at a time, how many jobs. Sourced, not run.
# The caller sets `root` (the folder that holds CMakeLists.txt). Everything printed here goes to stderr: stdout belongs
# to the program that is started afterwards.

# What a build depends on, besides the packages.
readonly build_inputs=(core tracer design app CMakeLists.txt CMakePresets.json)
# Memory that one compiler may take (Eigen and Ceres headers), in KiB.
readonly job_memory_kib=1572864

say() { printf 'evenglow: %s\n' "$*" >&2; }

die() {
  say "$@"
  exit 1
}

# read_packages LIST...: the package names of the lists, one a line.
read_packages() {
  local list
  for list in "$@"; do
    grep -v -e '^#' -e '^[[:space:]]*$' -- "$root/scripts/packages_$list.txt"
  done
}

# missing_packages LIST...: those of the lists that are not installed, one a line.
missing_packages() {
  local wanted installed
  wanted=$(read_packages "$@" | sort -u)
  # dpkg-query complains (and fails) for a name it has never seen: that one is missing.
  # shellcheck disable=SC2086,SC2016  # one word a package; ${...} is dpkg-query's own
  installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
    sed -n 's/^installed //p' | sort -u) || true
  comm -23 <(printf '%s\n' "$wanted") <(printf '%s\n' "$installed")
}

# show_log FILE: a failure's log.
show_log() {
  cat -- "$1" >&2
  say "the log above is in $1"
}

# install_packages LIST...: installs what is missing; does nothing if nothing is.
install_packages() {
  local log="$root/build/packages.log" missing
  if ! command -v dpkg-query >/dev/null; then
    say "not a Debian system: install what corresponds to $(read_packages "$@" | tr '\n' ' ')"
    return
  fi
  mapfile -t missing < <(missing_packages "$@")
  if [ "${#missing[@]}" -eq 0 ]; then return; fi

  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300)
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      die "Debian packages are missing and there is no sudo; as root, run: apt-get install ${missing[*]}"
    apt=(sudo "${apt[@]}")
  fi
  say "installing Debian packages: ${missing[*]}"
  local install=("${apt[@]}" install --yes --no-install-recommends "${missing[@]}")
  # The package lists may be absent or out of date: only then are they fetched.
  if "${install[@]}" >"$log" 2>&1 </dev/null; then return; fi
  say "fetching the package lists"
  if "${apt[@]}" update >>"$log" 2>&1 </dev/null && "${install[@]}" >>"$log" 2>&1 </dev/null; then return; fi
  show_log "$log"
  die "these packages could not be installed; as root, run: apt-get install ${missing[*]}"
}

# build_jobs: as many compilers as there are processors and memory for.
build_jobs() {
  local memory limit jobs
  memory=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || true)
  if [[ $limit =~ ^[0-9]+$ ]] && [ $((limit / 1024)) -lt "$memory" ]; then memory=$((limit / 1024)); fi
  jobs=$((memory / job_memory_kib))
  if [ "$jobs" -gt "$(nproc)" ]; then jobs=$(nproc); fi
  if [ "$jobs" -lt 1 ]; then jobs=1; fi
  echo "$jobs"
}

# with_build_lock COMMAND...: no two of these at a time in one checkout.
with_build_lock() {
  mkdir -p -- "$root/build" || die "cannot write to $root"
  (
    if ! flock --nonblock 9; then
      say "waiting for another build in $root/build"
      flock 9
    fi
    "$@"
  ) 9>"$root/build/.lock"
}

# compiler_cache: ccache if there is one that can write somewhere; else nothing.
compiler_cache() {
  if [ -w "${CCACHE_DIR:-${HOME:-/nonexistent}}" ]; then command -v ccache || true; fi
}

# configure PRESET: also after the checkout was moved, which CMake by itself refuses.
configure() {
  local cache="$root/build/$1/CMakeCache.txt" fresh=()
  if [ -e "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then fresh=(--fresh); fi
  cd -- "$root" && cmake --preset "$1" "${fresh[@]}" "-DCMAKE_CXX_COMPILER_LAUNCHER=$(compiler_cache)"
}

# build_preset PRESET TARGET: configures and builds; quiet unless it fails.
build_preset() {
  local directory="$root/build/$1" jobs
  local log="$directory/build.log"
  jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(build_jobs)}
  mkdir -p -- "$directory"
  say "building ($1, $jobs jobs; log in build/$1/build.log)"
  # 9>&-: the lock must not live on in a child of the build (a compiler cache's server).
  if ! (configure "$1" && cmake --build "$directory" --target "$2" --parallel "$jobs") >"$log" 2>&1 9>&-; then
    show_log "$log"
    die "the build failed"
  fi
}
