# Compile options of every semview target; never imposed on a consumer.
add_library(semview_options INTERFACE)
target_compile_options(semview_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Wold-style-cast
  # Fused multiply-add would make scores and views differ between machines.
  -ffp-contract=off
  $<$<BOOL:${SEMVIEW_WARNINGS_AS_ERRORS}>:-Werror>)
target_include_directories(semview_options INTERFACE ${PROJECT_SOURCE_DIR}/src)

# semview_module(<name> SOURCES … HEADERS … [USES <modules>] [PUBLIC_LINKS …] [PRIVATE_LINKS …])
#
# One folder = one module = one static library `semview_<name>`, alias `semview::<name>`.
# USES names the modules whose headers this one includes, which tools/check_layers.py checks.
function(semview_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;USES;PUBLIC_LINKS;PRIVATE_LINKS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "semview_module(${name}): unknown arguments: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  set(target semview_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(semview::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src
                                  FILES ${ARG_HEADERS})
  list(TRANSFORM ARG_USES PREPEND semview::)
  target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_PUBLIC_LINKS}
                        PRIVATE $<BUILD_INTERFACE:semview_options> ${ARG_PRIVATE_LINKS})
  target_compile_features(${target} PUBLIC cxx_std_20)
endfunction()
