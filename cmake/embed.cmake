# The page of the report and the studio into the program: host_sim/page/parts.txt lists its styles and
# scripts in their order, dygraphs comes from the distribution.
find_path(DYGRAPHS_DIR dygraph.min.js PATHS /usr/share/javascript/dygraphs NO_DEFAULT_PATH)
if(NOT DYGRAPHS_DIR)
  message(FATAL_ERROR "dygraphs is missing: apt-get install libjs-dygraphs, or set DYGRAPHS_DIR")
endif()

# All files of `parts` (below `folder`) that end in `ending`, one after the other.
function(servoid_join out folder ending)
  set(text "")
  foreach(part ${ARGN})
    if(part MATCHES "\\.${ending}$")
      file(READ "${folder}/${part}" one)
      string(APPEND text "${one}\n")
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${folder}/${part}")
    endif()
  endforeach()
  file(WRITE "${out}.new" "${text}")
  configure_file("${out}.new" "${out}" COPYONLY) # its time changes only where its text does
endfunction()

function(servoid_embed_page target folder)
  set(out "${CMAKE_CURRENT_BINARY_DIR}/page")
  file(STRINGS "${folder}/parts.txt" parts)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${folder}/parts.txt")
  servoid_join("${out}/style.css" "${folder}" css ${parts})
  servoid_join("${out}/scripts.js" "${folder}" js ${parts})
  set(PAGE_HTML "${folder}/page.html")
  set(PAGE_STYLE "${out}/style.css")
  set(PAGE_SCRIPTS "${out}/scripts.js")
  configure_file("${folder}/assets.cpp.in" "${out}/assets.cpp" @ONLY)
  set_source_files_properties("${out}/assets.cpp" PROPERTIES
    SKIP_PRECOMPILE_HEADERS ON
    OBJECT_DEPENDS "${PAGE_HTML};${PAGE_STYLE};${PAGE_SCRIPTS};${DYGRAPHS_DIR}/dygraph.min.js;${DYGRAPHS_DIR}/dygraph.min.css")
  target_sources(${target} PRIVATE "${out}/assets.cpp")
endfunction()
