#!/usr/bin/env bash
# packaging/build_tarball.sh INTO: makes INTO/jnd-VERSION.tar.gz of the last commit, always to the same bytes.
set -euo pipefail
mkdir -p "$1"
into=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
. packaging/versions.sh
if ! [ -e .git ]; then
  echo "tarball: expected a clone, found a tree without its history; make it where git is" >&2
  exit 1
fi
archive=$into/jnd-$version.tar.gz
git archive --format=tar --prefix="jnd-$version/" HEAD | gzip -9n >"$archive.unfinished"
mv "$archive.unfinished" "$archive"
echo "$archive"
