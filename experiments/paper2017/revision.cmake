# Writes OUTPUT with the commit that SOURCE is at, if that is not what it holds: run at every build.
execute_process(COMMAND git -C ${SOURCE} describe --always --exclude=* --dirty=+
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE
                RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [=[
// SPDX-License-Identifier: Apache-2.0
// Made by experiments/paper2017/revision.cmake.
#include "experiments/paper2017/revision.hpp"

namespace semview::paper2017 {

const std::string_view kRevision = "@revision@";

}  // namespace semview::paper2017
]=])
