# Debian packages, in groups; only what is missing is installed, and it is said why.

packages_of() {
  case $1 in
    core)
      echo g++ cmake ninja-build ccache pkg-config git ca-certificates
      echo libxml2-dev libhdf5-dev zlib1g-dev libtbb-dev libopenmpi-dev openmpi-bin libhypre-dev
      echo libeigen3-dev libsundials-dev libyaml-cpp-dev
      echo libcli11-dev libfmt-dev nlohmann-json3-dev libmuparser-dev libgtest-dev libgmock-dev
      echo python3 python3-numpy python3-h5py python3-matplotlib
      ;;
    test) echo python3-paraview ;; # reads exports back, as users' ParaView will
    lint) echo clang-format-16 clang-tidy-16 ;;
    bench) echo libbenchmark-dev valgrind util-linux ;;
    verify)
      echo clang-16 libclang-rt-16-dev libomp-16-dev # SUNDIALS asks for OpenMP of any compiler
      echo xvfb xauth libgl1-mesa-dri graphviz
      echo chromium-headless-shell # opens reports of runs, as users' browsers will
      ;;
    package) echo dpkg-dev fakeroot ;; # they tell cpack which libraries a package needs
    all) for group in core test lint bench verify package; do packages_of $group; done ;;
    *) fail 2 "setup: no package group '$1' (core, test, lint, bench, verify, package, all)" ;;
  esac
}

reason_for() {
  case $1 in
    core) echo "compiler, libraries, Python for pictures" ;;
    test) echo "ParaView, to read exports back" ;;
    lint) echo "clang-format and clang-tidy" ;;
    bench) echo "instruction counts and kernel benchmarks" ;;
    verify) echo "clang for fuzzing, a screen for ParaView, dot for graphs of tasks, a browser" ;;
    package) echo "tools that make a Debian package" ;;
    *) echo "everything" ;;
  esac
}

# missing_packages NAME...: those that dpkg does not know as installed.
missing_packages() {
  local name
  declare -A have=()
  while read -r status name; do
    [[ $status == ii ]] && have[$name]=1
  done < <(dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' "$@" 2>/dev/null || true)
  for name in "$@"; do
    [[ -n ${have[$name]:-} ]] || echo "$name"
  done
}

# install_packages GROUP
install_packages() {
  local group=$1 names missing as_root=()
  names=$(packages_of "$group") || exit 2
  if ! command -v dpkg-query >/dev/null; then
    say "no dpkg here: not installing; what Debian 12 calls them:" $names
    return 0
  fi
  # shellcheck disable=SC2086
  mapfile -t missing < <(missing_packages $names)
  ((${#missing[@]} == 0)) && return 0

  say "installing ${#missing[@]} packages ($(reason_for "$group")): ${missing[*]}"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      fail 3 "these packages are missing and this user is neither root nor has sudo. Ask for:
  apt-get install ${missing[*]}"
    fi
    as_root=(sudo)
    sudo -v || fail 3 "sudo refused; ask for: apt-get install ${missing[*]}"
  fi
  command -v apt-get >/dev/null ||
    fail 3 "no apt-get here; install these by hand: ${missing[*]}"
  logged apt_update "refreshing the package lists" \
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update ||
    say "the package lists could not be refreshed; trying with the old ones"
  logged "apt_$group" "installing (log: build/logs/apt_$group.log)" \
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}" ||
    fail 3 "apt-get could not install: ${missing[*]}"
}
