#!/usr/bin/env bash
# Installs the Debian or Ubuntu packages that the build and its tests need, and those named as arguments; does
# nothing if all are there.
set -euo pipefail

packages=(
  g++ cmake ninja-build git
  libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers glslang-tools spirv-tools
  libeigen3-dev libopencv-dev libcli11-dev libssl-dev nlohmann-json3-dev libtomlplusplus-dev
  libopenmpi-dev openmpi-bin slurm-wlm munge
  libgtest-dev libgmock-dev libbenchmark-dev
  libhdf5-dev hdf5-filter-plugin-blosc-serial hdf5-filter-plugin libzip-dev libpng-dev
  python3-h5py python3-numpy
  liblz4-dev libzstd-dev libbz2-dev libpugixml-dev libsqlite3-dev python3-lz4 python3-zstandard
)
packages+=("$@")

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "install_packages: no apt-get here; the build needs the counterparts of ${packages[*]}" >&2
  exit 0 # they may be there: the build tells
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "install_packages: run this as root, or install sudo; missing packages: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

update() { "${as_root[@]}" apt-get update -q; }
install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

echo "Installing ${missing[*]}"
# Package lists may be missing, or so old that what they name is gone.
apt-get install --simulate -q "${missing[@]}" &>/dev/null || update
install || { update && install; }
