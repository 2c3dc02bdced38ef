# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# How every target of the project is made: one static library a folder, all gathered in spslam::spslam.

# What concerns our own targets only; users of the library inherit none of it.
add_library(spslam_build_flags INTERFACE)
target_compile_options(spslam_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
  -fPIC -ffp-contract=off $<$<BOOL:${SPSLAM_WARNINGS_AS_ERRORS}>:-Werror>)
# gcc 12 sees overflows in its own library's strings and fills once they are inlined.
target_compile_options(spslam_build_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
if(SPSLAM_SANITIZE)
  target_compile_options(spslam_build_flags INTERFACE -fsanitize=${SPSLAM_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(spslam_build_flags INTERFACE -fsanitize=${SPSLAM_SANITIZE})
  target_compile_definitions(spslam_build_flags INTERFACE SPSLAM_SANITIZED=1)
endif()

# Folders that read what comes from outside. Their coverage guides the fuzzers, and only they have UndefinedBehaviorSanitizer's checks of
# every access: with either, arithmetic, which in Eigen is all small accesses, takes several times as long.
set(SPSLAM_FUZZED_FOLDERS base io map loop system)
if(SPSLAM_SANITIZE MATCHES "undefined")
  target_compile_options(spslam_build_flags INTERFACE
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:SPSLAM_FUZZED>>>:-fno-sanitize=alignment,null,object-size>)
endif()
# What -fsanitize=fuzzer-no-link stands for, which would ask for a precompiled header of its own.
set(SPSLAM_FUZZ_COVERAGE -fsanitize-coverage=inline-8bit-counters,indirect-calls,trace-cmp,pc-table)

if(SPSLAM_PRECOMPILED_HEADERS)
  file(WRITE ${CMAKE_BINARY_DIR}/pch/empty.cpp "// the precompiled header's own translation unit\n")
  add_library(spslam_pch OBJECT ${CMAKE_BINARY_DIR}/pch/empty.cpp)
  target_link_libraries(spslam_pch PRIVATE spslam_build_flags Eigen3::Eigen opencv_core Threads::Threads)
  set(SPSLAM_COMMON_HEADERS
    <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <optional> <span> <string>
    <string_view> <utility> <vector> <Eigen/Core> <Eigen/Geometry> <Eigen/Cholesky> <opencv2/core.hpp>)
  target_precompile_headers(spslam_pch PRIVATE ${SPSLAM_COMMON_HEADERS})
endif()

# The flags and the precompiled header of all targets, or, for tests, the one that has GoogleTest too.
function(spslam_use_build_flags target)
  set(pch spslam_pch)
  if(ARGC GREATER 1)
    set(pch ${ARGV1})
  endif()
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:spslam_build_flags>)
  if(SPSLAM_PRECOMPILED_HEADERS)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:Eigen3::Eigen> $<BUILD_INTERFACE:opencv_core>)
    target_precompile_headers(${target} REUSE_FROM ${pch})
  endif()
endfunction()

# spslam_library(FOLDER SOURCES a.cpp ... LINK spslam_base Eigen3::Eigen ...)
function(spslam_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  set(target spslam_${folder})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(spslam::${folder} ALIAS ${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # The compiler's option, not a definition, and PUBLIC: Eigen's alignment must agree between the library and its users.
  if(SPSLAM_NATIVE)
    target_compile_options(${target} PUBLIC -march=native)
  endif()
  if(SPSLAM_BUILD_FUZZ AND folder IN_LIST SPSLAM_FUZZED_FOLDERS)
    target_compile_options(${target} PRIVATE ${SPSLAM_FUZZ_COVERAGE})
    set_target_properties(${target} PROPERTIES SPSLAM_FUZZED TRUE)
  endif()
  target_link_libraries(${target} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${folder})
  spslam_use_build_flags(${target})
  set_property(GLOBAL APPEND PROPERTY SPSLAM_LIBRARIES ${target})
endfunction()

# spslam_test(NAME SOURCES a_test.cpp ... LINK spslam_base ...): one test program a folder, its cases registered with ctest.
function(spslam_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE ${ARG_LINK} GTest::gmock GTest::gtest_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE
    SPSLAM_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data" SPSLAM_SHARED_DATA="${SPSLAM_SHARED_DATA}")
  spslam_use_build_flags(${target} spslam_test_pch)
  gtest_discover_tests(${target} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 900)
endfunction()

# spslam::spslam, what a user links to, and the installation of everything behind it.
function(spslam_umbrella)
  get_property(libraries GLOBAL PROPERTY SPSLAM_LIBRARIES)
  add_library(spslam INTERFACE)
  add_library(spslam::spslam ALIAS spslam)
  target_link_libraries(spslam INTERFACE ${libraries})
  # Where scripts and documentation look for the program.
  if(TARGET spslam_cli)
    set_target_properties(spslam_cli PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  endif()
  install(TARGETS spslam ${libraries} EXPORT spslamTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ ${PROJECT_SOURCE_DIR}/src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE)
  install(EXPORT spslamTargets NAMESPACE spslam:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/spslam)
  include(CMakePackageConfigHelpers)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/spslamConfig.cmake.in ${CMAKE_BINARY_DIR}/spslamConfig.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/spslam)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/spslamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/spslamConfig.cmake ${CMAKE_BINARY_DIR}/spslamConfigVersion.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/spslam)
endfunction()
