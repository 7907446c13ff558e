# Runs commands of a document in an empty folder, as they stand; to be sourced.
#   in_empty_folder CONDYLE_BINARY    a folder to run in, with `condyle` on the path
#   run COMMAND                       says and runs one, its answer left out
ran=0

in_empty_folder() {
  bin=$(mktemp -d)
  trap 'rm -rf "$bin"' EXIT
  ln -s "$1" "$bin/condyle"
  export PATH="$bin:$PATH"
  mkdir "$bin/work"
  cd "$bin/work"
}

run() {
  echo "$1"
  eval "$1" >/dev/null
  ran=$((ran + 1))
}
