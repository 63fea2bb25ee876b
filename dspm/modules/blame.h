// Which module is at fault: the one whose code is on the stack where something was thrown, or of a thread that does not
// come back.
#pragma once

#include <vector>

#include "dspm/modules/load.h"

namespace dspm {

/// The innermost module on this thread's stack; null where there is none.
const LoadedModule* module_on_stack();

/// In a catch clause: the module that was on the stack where the exception was thrown; null where there was none.
const LoadedModule* module_that_threw();

/// Keeps for module_that_threw() who throws this exception just now.
void note_throw(const void* object);

/// The modules that other threads of the process are busy in right now. Interrupts each thread for a moment, by a
/// real-time signal.
std::vector<const LoadedModule*> modules_at_work();

}  // namespace dspm
