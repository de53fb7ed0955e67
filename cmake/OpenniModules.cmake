# Driver modules of OpenNI2. Its loader takes what is named lib*.so.0 in OpenNI2/Drivers beside
# libOpenNI2.so.0. ${CMAKE_BINARY_DIR}/openni2 is such a place of our own, with the system's drivers
# and ours, for LD_LIBRARY_PATH; `cmake --install` puts ours into the system's.

find_library(CREDO_OPENNI2_LIBRARY OpenNI2 REQUIRED)
get_filename_component(CREDO_OPENNI2_FOLDER ${CREDO_OPENNI2_LIBRARY} DIRECTORY)
set(CREDO_OPENNI2_DRIVERS ${CREDO_OPENNI2_FOLDER}/OpenNI2/Drivers)
set(CREDO_OPENNI2_PRIVATE ${CMAKE_BINARY_DIR}/openni2)

file(MAKE_DIRECTORY ${CREDO_OPENNI2_PRIVATE}/OpenNI2/Drivers)
file(CREATE_LINK ${CREDO_OPENNI2_FOLDER}/libOpenNI2.so.0 ${CREDO_OPENNI2_PRIVATE}/libOpenNI2.so.0
     SYMBOLIC)
file(GLOB system_drivers ${CREDO_OPENNI2_DRIVERS}/lib*.so.0)
list(FILTER system_drivers EXCLUDE REGEX /libcredo_)
foreach(driver ${system_drivers})
  get_filename_component(name ${driver} NAME)
  file(CREATE_LINK ${driver} ${CREDO_OPENNI2_PRIVATE}/OpenNI2/Drivers/${name} SYMBOLIC)
endforeach()

# A shared object takes position-independent code alone: the house's libraries that it links, too.
function(credo_position_independent target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  get_target_property(linked ${target} LINK_LIBRARIES)
  foreach(library ${linked})
    if(library MATCHES "^credo_" AND TARGET ${library})
      credo_position_independent(${library})
    endif()
  endforeach()
endfunction()

# credo_openni_module(NAME SOURCES a.cpp... [LINK lib...]): lib<NAME>.so.0, a driver. It shows its
# entry points alone, and stays loaded: a thread of its own may outlive OpenNI::shutdown.
function(credo_openni_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(map ${PROJECT_SOURCE_DIR}/cmake/openni_module.map)
  add_library(${name} MODULE ${ARG_SOURCES})
  credo_target_options(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  # OpenNI's headers are C++98.
  target_include_directories(${name} SYSTEM PRIVATE ${OPENNI2_INCLUDE_DIRS})
  target_link_options(${name} PRIVATE
    -Wl,--version-script=${map} -Wl,-z,nodelete -Wl,-z,defs -Wl,-soname,lib${name}.so.0)
  set_target_properties(${name} PROPERTIES
    PREFIX lib SUFFIX .so.0 LINK_DEPENDS ${map}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${CREDO_OPENNI2_PRIVATE}/OpenNI2/Drivers)
  if(CREDO_SANITIZE)
    # The sanitizers' own functions come from the program.
    target_link_options(${name} PRIVATE -Wl,-z,undefs)
  endif()
  credo_position_independent(${name})
  install(TARGETS ${name} LIBRARY DESTINATION ${CREDO_OPENNI2_DRIVERS})
endfunction()
