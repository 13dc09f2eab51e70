#!/usr/bin/env bash
# What has to hold before a release, each in one sentence, and then its files with their sums. Changes nothing in git.
set -euo pipefail
cd "$(dirname "$0")/.."
. packaging/versions.sh
failed=0
# expect WHAT-IS-WRONG COMMAND...: tells it where the command fails.
expect() {
  local sentence=$1
  shift
  if ! "$@" >/dev/null 2>&1; then
    echo "release: $sentence" >&2
    failed=1
  fi
}
nothing() { [ -z "$("$@")" ]; }
day=$(sed -n "s/^## $version (\([0-9-]*\))\$/\1/p" CHANGELOG.md)
expect "expected a tree without changes, found some; commit them" nothing git status --porcelain
expect "CHANGELOG.md: expected a heading \`## $version (YEAR-MONTH-DAY)\`, found none; close the list of what is new" [ -n "$day" ]
expect "CHANGELOG.md: expected $version at the top; put the newest first" \
  [ "$(sed -n 's/^## \([0-9.]*\) .*/\1/p' CHANGELOG.md | head -1)" = "$version" ]
expect "CITATION.cff: expected version $version, as CMakeLists.txt has it; change it there" grep -qx "version: $version" CITATION.cff
expect "CITATION.cff: expected date-released ${day:-as CHANGELOG.md says}; change it there" grep -qx "date-released: ${day:-none}" CITATION.cff
expect "expected the tag v$version at this commit; make it by \`git tag -s v$version\` when all else holds" \
  [ "$(git rev-parse --verify --quiet "v$version^{commit}")" = "$(git rev-parse HEAD)" ]
if [ "$failed" -ne 0 ]; then exit 1; fi
cat >&2 <<'TEXT'
release: these have to pass on this commit: ./dev test, ./dev test-window, ./dev sanitize, ./dev lint, ./dev test-package
TEXT
./dev package
./dev tarball
(cd build && sha256sum "jnd_${version}_$(dpkg --print-architecture).deb" "jnd-$version.tar.gz" | tee "jnd-$version.sha256")
