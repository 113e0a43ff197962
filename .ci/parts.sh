# Sourced by .ci/run and .ci/full: parts of a run, each with its time and its share.

if [[ -z ${SCARF_DATA_DIR:-} && -d ../shared/data ]]; then
  SCARF_DATA_DIR=$(cd ../shared/data && pwd)
  export SCARF_DATA_DIR
fi

failed_parts=()
times=()

# part NAME MINUTES COMMAND...: runs it, goes on if it fails, and says at the end what it took of its share.
part() {
  local name=$1 share=$2
  shift 2
  local begin=$SECONDS
  echo "== $name"
  "$@" || failed_parts+=("$name")
  times+=("$(printf '%-28s %5d s of %d' "$name" $((SECONDS - begin)) $((share * 60)))")
}

# The times of all parts; fails if a part did.
finish_parts() {
  echo "== seconds per part"
  printf '%s\n' "${times[@]}" "$(printf '%-28s %5d s' all "$SECONDS")"
  ((${#failed_parts[@]} == 0)) && return 0
  echo "failed: ${failed_parts[*]}"
  return 1
}
