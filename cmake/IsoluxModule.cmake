# One module of the library is one CMake target: isolux::NAME, its sources and headers side by side
# in src/isolux/NAME.
#
#   isolux_module(NAME SOURCES a.cpp ... [DEPENDS core ...] [LINK PUBLIC x PRIVATE y])
#
# DEPENDS names other modules; everything after LINK goes to target_link_libraries as it is.
function(isolux_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LINK" ${ARGN})
  set(target isolux_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(isolux::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:include>)
  list(TRANSFORM arg_DEPENDS PREPEND isolux_)
  target_link_libraries(${target} PUBLIC ${arg_DEPENDS})
  if(arg_LINK)
    target_link_libraries(${target} ${arg_LINK})
  endif()
  isolux_compile_options(${target})
  set_property(GLOBAL APPEND PROPERTY ISOLUX_MODULES ${target})
endfunction()

# Warnings and sanitizers, the same for library, program and tests. Floating point stays strict:
# contraction into fused operations would make results depend on the compiler's mood. That nobody
# asks for errno or traps changes no result, but lets loops run on vector units.
function(isolux_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    -Wno-sign-conversion -ffp-contract=off -fno-math-errno -fno-trapping-math)
  if(ISOLUX_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${ISOLUX_SANITIZE}
      -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${ISOLUX_SANITIZE})
  endif()
endfunction()

# One test program a module: isolux_test(NAME SOURCES a_test.cpp ... DEPENDS geometry ...)
function(isolux_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${arg_SOURCES})
  list(TRANSFORM arg_DEPENDS PREPEND isolux::)
  target_link_libraries(${target} PRIVATE ${arg_DEPENDS} GTest::gtest GTest::gmock GTest::gtest_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE
    ISOLUX_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    ISOLUX_BINARY_DIR="${PROJECT_BINARY_DIR}")
  isolux_compile_options(${target})
  gtest_discover_tests(${target} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 900)
endfunction()
