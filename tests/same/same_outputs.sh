#!/usr/bin/env bash
# Whether this tree writes what another revision wrote: builds that revision beside this tree, has both programs
# simulate and analyse the same studies with the same seeds, and compares every file to the byte.
#
# Usage: same_outputs.sh REVISION BUILD_FOLDER PROGRAM [GLOB...]
#
# The studies and the laboratory are those of the revision, so that a study file that changed is no difference.
# A difference is allowed where a commit since the revision names it in its last paragraph:
#     Differs: */results.json  the rank tests are exact now
# or a GLOB is given, for changes that are not committed yet. Exit 0: the same, but for what is allowed; 1: something
# else differs.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
revision=$(git -C "$root" rev-parse --verify --quiet "${1:?expected a revision}^{commit}") || {
  echo "same: expected a revision of this repository, found $1" >&2
  exit 2
}
mkdir -p "${2:?expected a folder to build in}"
work=$(cd "$2" && pwd)
program=$(realpath "${3:?expected the program of this tree}")
shift 3

# The other revision's program; its tree stays for the next time.
tree=$work/tree
if [ -e "$tree/.git" ] && [ "$(git -C "$tree" rev-parse HEAD)" != "$revision" ]; then
  git -C "$tree" checkout --quiet --force --detach "$revision"
elif [ ! -e "$tree/.git" ]; then
  rm -rf "$tree"
  git -C "$root" worktree prune
  git -C "$root" worktree add --quiet --force --detach "$tree" "$revision"
fi
echo "same: building $(git -C "$root" log -1 --format='%h %s' "$revision")" >&2
log=$work/build.log
if ! { cd "$tree" && export CCACHE_BASEDIR=$tree && cmake --preset release -DJND_BUILD_TESTS=OFF &&
       cmake --build --preset release --target jnd; } >"$log" 2>&1; then
  cat "$log" >&2
  exit 3
fi

# Of this tree's program a copy is run, for somebody may go on building. What the other revision makes is always
# the same, so it is made once.
rm -rf "$work/after" "$work/jnd"
cp "$program" "$work/jnd"
program=$work/jnd
sides=after
made_by="$revision by $(sha256sum <"$here/same_outputs.sh")"
if [ "$(cat "$work/before.made_by" 2>/dev/null)" != "$made_by" ]; then
  rm -rf "$work/before" "$work/before.made_by"
  sides="before after"
fi

# What both programs are given, under the same relative paths.
for side in $sides; do
  mkdir -p "$work/$side/studies"
  cp "$tree"/protocols/*.json "$work/$side/studies/"
  rm -f "$work/$side/studies/study.schema.json"
  cp "$tree/data/laboratories/thesis.json" "$work/$side/studies/laboratory.json.given"
done

# one_study PROGRAM FOLDER NAME: everything that the program makes of a study.
one_study() {
  local jnd=$1 name=$3 seed=2018 participants=4
  cd "$2"
  mkdir "$name"
  # What was refused or warned of belongs to the output; that some commands have nothing to say of some
  # studies (exit 1) does as well.
  said() {
    local into=$1
    shift
    "$@" >"$name/$into" 2>"$name/$into.stderr" || echo "exit $?" >>"$name/$into.stderr"
    # How far it was after some seconds is of the machine.
    sed -i '/ % done, about /d' "$name/$into.stderr"
  }
  said plan.json "$jnd" plan "studies/$name.json" --participants $participants --seed $seed --json
  said simulate.txt "$jnd" simulate "studies/$name.json" --participants $participants --seed $seed --jobs 1 \
    --laboratory studies/laboratory.json.given --study "$name/study"
  # How long it took is nothing that was made.
  rm -f "$name/simulate.txt"
  said verify.json "$jnd" verify "$name/study" --json
  said csv.txt "$jnd" export csv "$name/study" --out "$name/csv" --recordings
  said bids.txt "$jnd" export bids "$name/study" --out "$name/bids"
  said hdf5.txt "$jnd" export hdf5 "$name/study" --out "$name/hdf5"
  # Of the database what it says, for the identity of a study is random.
  local database=$name/bids/sourcedata/jnd.study/study.sqlite
  if [ -f "$database" ]; then
    sqlite3 "$database" .dump | grep -v '^INSERT INTO study_identity' >"${database%.sqlite}.sql"
    rm "$database"
  fi
  # The event of an exclusion has the time of the day: only after the exports.
  "$jnd" exclude "$name/study" --participant P01 --trial 1 --reason "a phone rang" >/dev/null 2>&1 || true
  said results.json "$jnd" results "$name/study" --json
  said results.txt "$jnd" results "$name/study"
  said report.txt "$jnd" report "$name/study" --out "$name/report"
  # A browser prints the page as PDF, with the time of the day in it; the page itself is compared.
  rm -f "$name/report/report.pdf"
  # What it says was exported. Of large files, samples above all, the checksum is enough: they would fill the disk.
  rm -rf "$name/study"
  local large
  while read -r large; do
    sha256sum <"$large" >"$large.sha256"
    rm "$large"
  done < <(find "$name" -type f -size +1M)
}

studies=$(cd "$work/before/studies" && ls ./*.json | sed 's|^\./||; s|\.json$||')
for name in $studies; do
  echo "same: $name" >&2
  [ "$sides" = after ] || (one_study "$tree/build/release/jnd" "$work/before" "$name") &
  (one_study "$program" "$work/after" "$name") &
  wait
done
echo "$made_by" >"$work/before.made_by"

# The study folders hold random identifiers; what they say is compared as it is exported.
compared() { (cd "$1" && find . -type f -not -path './studies/*' -not -path './*/study/*' -printf '%P\n' | sort); }
allowed=$(git -C "$root" log --format='%(trailers:key=Differs,valueonly,separator=%x0A)' "$revision..HEAD" | sed '/^$/d')
for glob in "$@"; do allowed+=$'\n'"$glob  (given on the command line)"; done

# reason_for FILE: why it may differ; fails where nothing says that it may.
reason_for() {
  local glob reason
  while read -r glob reason; do
    # shellcheck disable=SC2053
    if [ -n "$glob" ] && [[ $1 == $glob ]]; then echo "$reason"; return 0; fi
  done <<<"$allowed"
  return 1
}

num_same=0 num_allowed=0 num_different=0
while read -r file; do
  if cmp -s "$work/before/$file" "$work/after/$file"; then
    num_same=$((num_same + 1))
    continue
  fi
  if reason=$(reason_for "${file%.sha256}"); then
    num_allowed=$((num_allowed + 1))
    echo "allowed   $file: $reason"
    continue
  fi
  num_different=$((num_different + 1))
  if [ ! -e "$work/before/$file" ]; then
    echo "DIFFERENT $file: not there before"
  elif [ ! -e "$work/after/$file" ]; then
    echo "DIFFERENT $file: not there any more"
  else
    echo "DIFFERENT $file"
    diff --text "$work/before/$file" "$work/after/$file" | head -6 | cut -c1-160 | sed 's/^/            /' || true
  fi
done < <({ compared "$work/before"; compared "$work/after"; } | sort -u)

echo "same: $num_same files the same, $num_allowed different as the commits say, $num_different different"
[ "$num_same" -gt 0 ] && [ "$num_different" -eq 0 ]
