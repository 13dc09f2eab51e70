# Sourced at the top of the tree: what a package is called and when it was made, from one place each.
version=$(sed -n 's/^project(jnd VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
if [ -e .git ] && git rev-parse HEAD >/dev/null 2>&1; then
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
else
  # A source archive: git wrote the time of its commit into this file.
  SOURCE_DATE_EPOCH=$(cat packaging/source_date)
fi
export SOURCE_DATE_EPOCH
if ! [[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ && $SOURCE_DATE_EPOCH =~ ^[0-9]+$ ]]; then
  echo "packaging: expected a version in CMakeLists.txt and the time of a commit, found \`$version\` and" \
    "\`$SOURCE_DATE_EPOCH\`; build from a clone or from an archive of ./dev tarball" >&2
  exit 1
fi
