#pragma once

#include <cstddef>
#include <functional>

namespace jnd::core {

/// Does `work(i)` for every i below `count`, at most `jobs` (>= 1) of them at once, on the
/// calling thread and others. Once one has thrown no other is begun, and when those under way
/// are over the exception of the lowest i is thrown on. Not real time.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace jnd::core
