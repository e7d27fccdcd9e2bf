# Installs the Debian packages that are missing, by apt; through sudo only where not root. Sourced by demo.sh and test.sh.
# Usage: install_missing PACKAGE...

build_packages="g++ cmake ninja-build libgomp1 libfmt-dev libeigen3-dev libcli11-dev nlohmann-json3-dev libtomlplusplus-dev libhdf5-dev zlib1g-dev libopenturns-dev libceres-dev libnlopt-dev libcpp-httplib-dev pkg-config gnuplot-nox"
test_packages="git libgtest-dev libbenchmark-dev clang clang-format clang-tidy libomp-dev hdf5-tools libopenmpi-dev openmpi-bin"

install_missing() {
  local missing="" package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  local root=""
  [ "$(id -u)" -eq 0 ] || root="sudo"
  echo "installing:$missing"
  $root apt-get update -qq
  # shellcheck disable=SC2086
  $root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}
