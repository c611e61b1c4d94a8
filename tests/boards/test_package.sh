#!/usr/bin/env bash
# The core as others take it: installed for a Cortex-M4 and linked into firmware that finds it by
# find_package, executed; as a Zephyr module; as a PlatformIO library.
. "$(dirname "$0")/support.sh"

quietly() { "$@" >log 2>&1 || fail "$*: $(tail -n 20 log)"; }

m4=(-DCMAKE_TOOLCHAIN_FILE="$root/examples/firmware/cortex-m4.cmake" -G Ninja)
quietly cmake -S "$root" -B core "${m4[@]}" -DCMAKE_BUILD_TYPE=Release -DSERVOID_BUILD_HOST=OFF \
    -DSERVOID_BUILD_TESTS=OFF
quietly cmake --build core
quietly cmake --install core --prefix "$work/prefix"
quietly cmake -S "$root/examples/firmware" -B firmware "${m4[@]}" -DCMAKE_PREFIX_PATH="$work/prefix"
quietly cmake --build firmware
run mps2_an386 firmware/firmware.elf
grep -q '^50 Hz: J .*, ok$' firmware/firmware.elf.txt || fail "no inertia: $(cat firmware/firmware.elf.txt)"
echo "figure: firmware that links the installed package: $(sed -n 's/, D .*//p' firmware/firmware.elf.txt | head -n 1)"

# Zephyr's own functions, as far as the module calls them: which sources, which folders.
cat >zephyr.cmake <<'END'
function(zephyr_library_named name)
endfunction()
function(zephyr_include_directories)
  message(STATUS "include ${ARGN}")
endfunction()
function(zephyr_library_sources)
  foreach(source IN LISTS ARGN)
    message(STATUS "source ${source}")
  endforeach()
endfunction()
function(zephyr_library_sources_ifdef feature)
  if(${feature})
    zephyr_library_sources(${ARGN})
  endif()
endfunction()
include(${MODULE}/zephyr/CMakeLists.txt)
END
sources_of() { # OPTION...
    cmake "$@" -DMODULE="$root" -P zephyr.cmake 2>&1 | sed -n 's,^-- source ../,,p' | sort
}
sources_of -DCONFIG_SERVOID=ON -DCONFIG_SERVOID_NODE=ON >module.txt
(cd "$root" && ls src/*.c) >all.txt
same module.txt all.txt
[ -z "$(sources_of -DCONFIG_SERVOID=OFF)" ] || fail "the Zephyr module builds unasked"
session=$(sources_of -DCONFIG_SERVOID=ON | sed "s,^,$root/,")
[ "$(wc -w <<<"$session")" -ge 10 ] || fail "Zephyr gets only $session"
quietly arm-none-eabi-gcc -std=c99 -mcpu=cortex-m4 -mthumb -Os -I"$root/include" --specs=nosys.specs \
    "$root/boards/blank/sid_hal_blank.c" $session -o session
[ "$(sed -n 's/^name: //p' "$root/zephyr/module.yml")" = servoid ] || fail "module.yml has no name"
grep -q "^config SERVOID$" "$root/zephyr/Kconfig" || fail "Kconfig has no SERVOID"

# PlatformIO reads one file; what it names must be there, and of this version.
version=$(sed -n 's/.*SID_VERSION_STRING "\(.*\)".*/\1/p' "$root/include/servoid/sid_version.h")
[ "$(jq -r .version "$root/library.json")" = "$version" ] || fail "library.json is of another version"
for path in $(jq -r '.build.includeDir, .build.srcDir, .export.include[]' "$root/library.json"); do
    [ -e "$root/$path" ] || fail "library.json names $path, which is not there"
done
[ -f "$root/include/$(jq -r .headers "$root/library.json")" ] || fail "library.json names another header"
