// Finds out which module is at fault: the one whose code is on the stack where something was thrown, or on that of a
// thread that does not return.
#pragma once

#include <vector>

#include "dspm/session/modules/load.h"

namespace dspm {

/// Returns the innermost module on this thread's stack; null if there is none.
const LoadedModule* module_on_stack();

/// Returns the module that was on the stack where the exception was thrown; null if there was none. Call it in a catch
/// clause.
const LoadedModule* module_that_threw();

/// Records for module_that_threw() which module is throwing this exception.
void note_throw(const void* object);

/// Returns the modules whose code other threads of the process are running right now. Interrupts each thread for a
/// moment, by a real-time signal.
std::vector<const LoadedModule*> modules_at_work();

}  // namespace dspm
