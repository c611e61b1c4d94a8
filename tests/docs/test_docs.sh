#!/usr/bin/env bash
# The documentation, run: every fenced block of README.md, DESIGN.md, SPEC.md, docs/*.md,
# boards/README.md and boards/*/README.md that a reader would paste into a shell.
#
#   SERVOID_PROGRAM=... tests/docs/test_docs.sh [--measured | --live]
#
# What a ```sh block is for stands behind `sh`:
#   runnable       run with `bash -eu` in an empty folder that holds examples/, one folder a document,
#                  its blocks in order; the program is on the PATH as `servoid`
#   measured       the same, and only where the measured data are (SERVOID_DATA_DIR, default
#                  ../shared/data): run by `--measured`
#   live           the same, on a machine with vcan0 (tools/with-vcan): run by `--live`
#   exit=N         with one of these: the block ends with status N
#   elsewhere      not run (it installs, builds or mounts); a `./command` in it must be there
# A ```text block shows what the last ```sh block before it printed, on either stream: its lines must be
# found there, in order, blanks aside, numbers within 2 % or one of their last digit, bars of any length
# (tests/docs/shows.awk); a line `...` or `…` stands for whatever was left out. `text elsewhere` shows
# something else, or what differs from run to run, such as seconds.
# A ```c block marked `compiles` goes through the compiler with every warning; ```c, ```cpp or ```text marked
# `from FILE` must stand in that file, line by line. A block of neither kind is an error, and so are a link to a
# file or a heading that is not there and a document without any.
set -euo pipefail
export LC_ALL=C
source_dir=$(realpath "${SERVOID_SOURCE_DIR:-$(dirname "$0")/../..}")
program=$(realpath "${SERVOID_PROGRAM:?path of the built program}")
export SERVOID_DATA_DIR
SERVOID_DATA_DIR=$(realpath -m "${SERVOID_DATA_DIR:-$source_dir/../shared/data}")
kind=runnable
case ${1-} in --measured) kind=measured ;; --live) kind=live ;; esac
if [ $kind = measured ] && [ ! -d "$SERVOID_DATA_DIR/emps" ]; then
    echo "skipped: no data in $SERVOID_DATA_DIR"
    exit 0
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$program" "$work/bin/servoid"
PATH=$work/bin:$PATH
failed=0 ran=0 shown=0 excerpts=0

fail() { # WHERE WHAT [LOG]
    echo "$1: $2"
    [ -z "${3-}" ] || tail -n 20 "$3" | sed 's/^/    /'
    failed=$((failed + 1))
}

# The fenced blocks of a document, a file each: LINE.info, LINE.text.
extract() { # DOCUMENT FOLDER
    awk -v folder="$2" '
        /^ *```/ && !inside { inside = 1; at = folder "/" NR; sub(/^ *```/, ""); print >(at ".info")
                              printf "" >(at ".text"); next }
        /^ *```/ { inside = 0; close(at ".text"); next }
        inside { print >(at ".text") }
        END { if (inside) exit 1 }' "$1" || fail "$1" "a fence is not closed"
}

run_block() { # WHERE INFO SCRIPT FOLDER
    local wanted=0 status=0
    log=$work/log
    [[ ! " $2 " =~ \ exit=([0-9]+)\  ]] || wanted=${BASH_REMATCH[1]}
    (cd "$4" && timeout 120 bash -eu "$3") >"$log" 2>&1 </dev/null || status=$?
    ran=$((ran + 1))
    [ $status -eq "$wanted" ] || fail "$1" "exit $status, $wanted was expected" "$log"
}

compile_block() { # WHERE SCRIPT
    local log=$work/log
    ran=$((ran + 1))
    "${CC:-cc}" -std=c99 -Wall -Wextra -Werror -I"$source_dir/include" -fsyntax-only -x c "$2" \
        >"$log" 2>&1 || fail "$1" "does not compile" "$log"
}

excerpt_block() { # WHERE FILE SCRIPT: whole lines that stand in the file as they stand here
    excerpts=$((excerpts + 1))
    [ -f "$source_dir/$2" ] || { fail "$1" "there is no $2"; return; }
    [ -s "$3" ] && [[ $'\n'$(<"$source_dir/$2")$'\n' == *$'\n'"$(<"$3")"$'\n'* ]] ||
        fail "$1" "does not stand in $2 as it stands here"
}

shown_block() { # WHERE TEXT
    case $last_sh in
    "sh $kind "*) ;;
    "sh runnable "* | "sh measured "* | "sh live "*) return ;; # the other run's
    *) fail "$1" "\`\`\`text: shows no block that is run (see tests/docs/test_docs.sh)"; return ;;
    esac
    local missing
    shown=$((shown + 1))
    missing=$(awk -f "$source_dir/tests/docs/shows.awk" "$log" "$2") ||
        fail "$1" "not in the output of the block before:"$'\n'"$missing"
}

commands_exist() { # WHERE SCRIPT
    local command
    for command in $(grep -oE '^\./[^ ]+' "$2" || true); do
        [ -x "$source_dir/$command" ] || fail "$1" "there is no $command"
    done
}

block() { # WHERE INFO SCRIPT FOLDER
    [[ ! $2 =~ ^sh ]] || last_sh="$2 "
    case "$2 " in
    "text elsewhere "*) ;;
    "c from "* | "cpp from "* | "text from "*) [ $kind != runnable ] || excerpt_block "$1" "${2#* from }" "$3" ;;
    "text "*) shown_block "$1" "$3" ;;
    "sh runnable "*) [ $kind != runnable ] || run_block "$@" ;;
    "sh measured "*) [ $kind != measured ] || run_block "$@" ;;
    "sh live "*) [ $kind != live ] || run_block "$@" ;;
    "sh elsewhere "*) commands_exist "$1" "$3" ;;
    "c compiles "*) [ $kind != runnable ] || compile_block "$1" "$3" ;;
    "sh "* | "bash "* | "c "* | "cpp "*) fail "$1" "\`\`\`$2: not marked (see tests/docs/test_docs.sh)" ;;
    esac
}

prose() { awk '/^ *```/ { inside = !inside; next } !inside' "$1"; } # DOCUMENT: what is outside fenced blocks

anchors() { # DOCUMENT: what its headings are called in a link
    prose "$1" | sed -nE 's/^#+ +//p' | tr '[:upper:] ' '[:lower:]-' | tr -cd 'a-z0-9_\n-'
}

links() { # DOCUMENT: what [text](file#heading) and ![text](file) point at
    local target file
    for target in $(prose "$1" | grep -oE '\]\([^) ]+' | grep -v '(https*:' | sed 's/^](//' || true); do
        file=$(dirname "$1")/${target%%#*}
        [ -n "${target%%#*}" ] || file=$1
        [ -e "$file" ] || { fail "$1" "the link to $target leads nowhere"; continue; }
        [[ $target != *.md#* && $target != \#* ]] || anchors "$file" | grep -xF -- "${target#*#}" >/dev/null ||
            fail "$1" "the link to $target: there is no such heading"
    done
}

cd "$source_dir" # the folders' documents are looked for from here
for document in README.md DESIGN.md SPEC.md CHANGELOG.md docs/*.md boards/README.md boards/*/README.md; do
    cd "$source_dir"
    [ -f "$document" ] || continue
    blocks=$work/blocks/$document folder=$work/folder/$document
    mkdir -p "$blocks" "$folder"
    cp -r examples "$folder/"
    extract "$document" "$blocks"
    links "$document"
    last_sh=
    for info in $(find "$blocks" -name '*.info' | sort -V); do
        text=${info%.info}.text
        block "$document:$(basename "$info" .info)" "$(cat "$info")" "$text" "$folder"
    done
done

echo "$ran blocks run, $shown of their outputs compared, $excerpts excerpts held against their files, $failed failed"
((failed == 0 && ran > 0))
