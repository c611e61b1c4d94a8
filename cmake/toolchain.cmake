# What every compilation shares: sanitizers and the compiler cache.
if(SERVOID_SANITIZE)
  add_compile_options(-fsanitize=${SERVOID_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SERVOID_SANITIZE})
endif()

if(SERVOID_CCACHE)
  find_program(SERVOID_CCACHE_PROGRAM ccache)
  mark_as_advanced(SERVOID_CCACHE_PROGRAM)
  if(SERVOID_CCACHE_PROGRAM)
    foreach(language C CXX)
      if(NOT CMAKE_${language}_COMPILER_LAUNCHER)
        # a precompiled header is part of what is compared
        set(CMAKE_${language}_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
            CCACHE_SLOPPINESS=pch_defines,time_macros "${SERVOID_CCACHE_PROGRAM}")
      endif()
    endforeach()
  endif()
endif()
