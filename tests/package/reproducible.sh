#!/usr/bin/env bash
# tests/package/reproducible.sh [--cold]: builds the package twice, from two clones in folders with names of different length and at
# different times, and compares the bytes. With --cold the compiler's cache is not asked: twice a whole build.
set -euo pipefail
cd "$(dirname "$0")/../.."
if [ "${1:-}" = --cold ]; then export CCACHE_DISABLE=1; fi
. packaging/versions.sh
if [ -n "$(git status --porcelain --untracked-files=no)" ]; then
  echo "reproducible: what is not committed is not in it" >&2
fi
revision=$(git rev-parse HEAD)  # Somebody may commit while it builds.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
began=$SECONDS
for folder in first a/second/folder; do
  git clone --quiet --shared --no-checkout . "$work/$folder"
  (
    cd "$work/$folder"
    git checkout --quiet --detach "$revision"
    before=$SECONDS
    cmake --preset package >/dev/null
    cmake --build --preset package >"$work/log" 2>&1 || { tail -40 "$work/log" >&2; exit 1; }
    # What differs between people: the time zone, the language, the mask of new files.
    TZ=Asia/Tokyo LC_ALL=C.UTF-8 packaging/build_deb.sh build/package "$work/$folder/out" >/dev/null
    echo "$folder: $((SECONDS - before)) s"
  )
  umask 077
done
name=jnd_${version}_$(dpkg --print-architecture).deb
sha256sum "$work/first/out/$name" "$work/a/second/folder/out/$name" | sed "s|  $work/|  |"
if ! cmp -s "$work/first/out/$name" "$work/a/second/folder/out/$name"; then
  echo "reproducible: expected the same bytes of both builds, found others in:" >&2
  for folder in first a/second/folder; do
    mkdir -p "$work/unpacked/$folder"
    dpkg-deb -R "$work/$folder/out/$name" "$work/unpacked/$folder"
  done
  diff -rq "$work/unpacked/first" "$work/unpacked/a/second/folder" >&2 || true
  exit 1
fi
archives=()
for folder in first a/second/folder; do archives+=("$("$work/$folder/packaging/build_tarball.sh" "$work/$folder/out")"); done
cmp "${archives[@]}"
echo "the package and the archive are the same to the byte; $((SECONDS - began)) s in all"
