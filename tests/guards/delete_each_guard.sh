#!/usr/bin/env bash
# Deletes the guards of guards.txt one by one, in a copy of the tree, and expects a test to fail each
# time. Usage: delete_each_guard.sh BUILD_FOLDER [PART OF "FILE: NAME" OF A GUARD]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tests/guards/guard_list.sh
source "$here/guard_list.sh"
root=$(cd "$here/../.." && pwd)
work=${1:?expected a folder to build in}
wanted=${2:-}
mkdir -p "$work"
work=$(cd "$work" && pwd)
tree=$work/tree

copy_tree "$root" "$tree"
cmake -S "$tree" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DJND_WINDOW=OFF -DJND_WARNINGS_AS_ERRORS=OFF >"$work/log"
build() { cmake --build "$work/build" --target core_test device_test >"$work/log" 2>&1; }
# Most guards are seen by the tests of their own file, and those by quick ones; the others come after them.
slower='*HapticLoopBadInput.*:*HapticLoopPort.*:*HapticLoopProperty.*'
slow='RealtimeTick.*:SimulatedBench.*:ExoskeletonDevice.*:MujocoWorld.*'
# own_tests FILE: as a filter; of haptic_loop.cpp also those of haptic_loop_fault_test.cpp and its like.
own_tests() {
  local tests=("$root/tests/${1%.cpp}"*_test.cpp)
  [[ -f ${tests[0]} ]] || return 0
  sed -nE 's/^TEST(_F|_P)?\((\w+).*/*\2.*/p' "${tests[@]}" | sort -u | paste -sd:
}
# passes PROGRAM FILTER: within ten minutes, for without its guard a test may wait for ever.
passes() {
  timeout 600 "$work/build/tests/$1" --gtest_brief=1 --gtest_fail_fast --gtest_filter="$2" >"$work/log" 2>&1
}
# tests_pass FILE: those that a change of this file can reach.
tests_pass() {
  local own
  own=$(own_tests "$1")
  if [[ $1 == core/* ]]; then
    passes core_test "*" || return
  elif [[ -n $own ]]; then
    passes device_test "$own-$slower:$slow" || return
  fi
  passes device_test "$slower" || return
  passes device_test "-$slower:$slow:$own" || return
  passes device_test "$slow"
}

build || { cat "$work/log"; exit 1; }
tests_pass core/ || { cat "$work/log"; echo "guards: expected the tests to pass before anything is deleted"; exit 1; }

num_guards=0 num_missed=0
# try FILE NAME FROM TO
try() {
  local file=$1 name=$2
  [[ "$file: $name" == *"$wanted"* ]] || return 0
  num_guards=$((num_guards + 1))
  if ! delete_guard "$tree/$file" "$3" "$4"; then
    echo "$file: $name: expected the guard of guards.txt, found other code; bring the list up to date"
    num_missed=$((num_missed + 1))
  elif ! build; then
    echo "$file: $name: expected code that compiles without it, found $(sed -n 's/.*\(error:.*\)/\1/p' "$work/log" | head -1)"
    num_missed=$((num_missed + 1))
  elif tests_pass "$file"; then
    echo "$file: $name: deleted, and no test fails"
    num_missed=$((num_missed + 1))
  else
    # A test by its name, or one that waits for ever without the guard; not just any red.
    local status=$? seen
    seen=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$work/log" | head -1)
    [[ -n $seen || $status -ne 124 ]] || seen="a test that did not end"
    if [[ -n $seen ]]; then
      echo "$file: $name: seen by $seen"
    else
      echo "$file: $name: expected a test that fails, found the tests ended by status $status"
      num_missed=$((num_missed + 1))
    fi
  fi
  cp "$root/$file" "$tree/$file"
}

each_guard "$here/guards.txt" try
echo "$((num_guards - num_missed)) of $num_guards guards are seen by a test"
[[ $num_missed -eq 0 ]]
