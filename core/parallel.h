#pragma once

#include <cstddef>
#include <functional>

namespace jnd::core {

/// Calls `work(i)` for every i below `count`, at most `jobs` (>= 1) calls at once, in the
/// calling thread and others. Once a call has thrown, no other begins. After those under way
/// have ended, the exception of the lowest i is rethrown. Not real time.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace jnd::core
