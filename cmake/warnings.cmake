# servoid_warnings(TARGET): the project's warnings for its own sources, C and C++.
# Libraries of others come in as imported targets, which CMake passes as system includes.
function(servoid_warnings target)
  set(common -Wall -Wextra -Wconversion -Wshadow -pedantic)
  set(c ${common} -Wdouble-promotion -Wstrict-prototypes -Wmissing-prototypes -Wundef)
  # gcc's -Wconversion leaves signedness out in C++ and clang's does not; both check the same here.
  set(cxx ${common} -Wno-sign-conversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    list(APPEND cxx -Wno-restrict) # gcc 12 sees overlap in `"text" + std::string` (GCC bug 105651)
    if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
      # and with a precompiled header forgets where its strings have switched these off; the preset
      # `plain` does without such headers
      list(APPEND cxx -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
  endif()
  if(SERVOID_WERROR)
    list(APPEND c -Werror)
    list(APPEND cxx -Werror)
  endif()
  if(SERVOID_SANITIZE AND CMAKE_C_COMPILER_ID STREQUAL "GNU")
    # The checks that sanitizers insert make gcc see uninitialised values where there are none.
    list(APPEND c -Wno-maybe-uninitialized)
    list(APPEND cxx -Wno-maybe-uninitialized)
  endif()
  target_compile_options(${target} PRIVATE
    "$<$<COMPILE_LANGUAGE:C>:${c}>" "$<$<COMPILE_LANGUAGE:CXX>:${cxx}>")
endfunction()
