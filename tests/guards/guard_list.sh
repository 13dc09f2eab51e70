# shellcheck shell=bash
# Read by scripts that delete guards: lists of guards, and how to delete one.

# each_guard LIST FUNCTION: calls FUNCTION FILE NAME FROM TO for each guard of the list.
each_guard() {
  local list=$1 function=$2 line file='' name='' from='' to=''
  while IFS= read -r line <&3; do
    case $line in
      '@ '*)
        [[ -z $file ]] || "$function" "$file" "$name" "${from%$'\n'}" "${to%$'\n'}"
        line=${line#@ }; file=${line%%: *}; name=${line#*: }; from='' to='' ;;
      -*) from+=${line#-}$'\n' ;;
      +*) to+=${line#+}$'\n' ;;
    esac
  done 3<"$list"
  [[ -z $file ]] || "$function" "$file" "$name" "${from%$'\n'}" "${to%$'\n'}"
}

# delete_guard FILE FROM TO: false where the file has other code.
delete_guard() {
  FROM=$2 TO=$3 perl -0777 -pi -e '$n = s/\Q$ENV{FROM}\E/$ENV{TO}/; END { exit !$n }' "$1"
}

# copy_tree ROOT TREE: what git knows of it.
copy_tree() {
  rm -rf "$2"
  mkdir -p "$2"
  (cd "$1" && git ls-files -z | xargs -0 cp --parents -t "$2")
}
