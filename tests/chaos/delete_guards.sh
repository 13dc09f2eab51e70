#!/usr/bin/env bash
# Deletes the guards of guards.txt one by one, in a copy of the tree, and expects the campaign to find each
# missing within 1000 schedules. Usage: delete_guards.sh BUILD_FOLDER [PART OF "FILE: NAME" OF A GUARD]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
# shellcheck source=tests/guards/guard_list.sh
source "$here/../guards/guard_list.sh"
work=${1:?expected a folder to build in}
wanted=${2:-}
num_schedules=1000
mkdir -p "$work"
work=$(cd "$work" && pwd)
tree=$work/tree

copy_tree "$root" "$tree"
cmake -S "$tree" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DJND_WINDOW=OFF >"$work/log"
build() { cmake --build "$work/build" --target jnd_chaos_mutant >"$work/log" 2>&1; }
campaign() { "$work/build/tests/chaos/jnd_chaos_mutant" "$num_schedules" 1 --virtual-time --first >"$work/log" 2>/dev/null; }

build || { cat "$work/log"; exit 1; }
campaign || { cat "$work/log"; echo "chaos: expected no violation before a guard is deleted"; exit 1; }

num_guards=0 num_missed=0
# miss FILE NAME FROM TO
miss() {
  local file=$1 name=$2 found
  [[ "$file: $name" == *"$wanted"* ]] || return 0
  num_guards=$((num_guards + 1))
  if ! delete_guard "$tree/$file" "$3" "$4"; then
    echo "$file: $name: expected the guard of guards.txt, found other code; bring the list up to date"
    num_missed=$((num_missed + 1))
  elif ! build; then
    echo "$file: $name: expected code that compiles without it, found $(grep -m 1 -o 'error:.*' "$work/log" || true)"
    num_missed=$((num_missed + 1))
  elif campaign; then
    echo "$file: $name: deleted, and no schedule of $num_schedules finds it"
    num_missed=$((num_missed + 1))
  else
    found=$(sed -n 's/.*VIOLATION at //p' "$work/log" | head -1)
    echo "$file: $name: found by $(sed -n 's/.*again: //p' "$work/log" | head -1) ($found)"
  fi
  cp "$root/$file" "$tree/$file"
}
each_guard "$here/guards.txt" miss
echo "$((num_guards - num_missed)) of $num_guards guards are missed by the campaign when they are gone"
[[ $num_missed -eq 0 ]]
