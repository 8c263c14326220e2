// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace geomend {

/// Asks for pages of 2 MiB behind a range of memory of at least 64 MiB that is not touched yet, where the system has twice as many of
/// them free: then they cost a third of what small ones do. Where it has not it would first move memory together, which can take seconds,
/// so that small ones are better. Only advice. Cost: reading a line of the system for each zone of memory.
/// \return whether it was asked
bool ask_for_large_pages(const void* begin, std::size_t bytes);

/// The same for the memory that an array has reserved. \pre array.empty()
template <class T>
void ask_for_large_pages(const std::vector<T>& array) {
    ask_for_large_pages(array.data(), array.capacity() * sizeof(T));
}

}  // namespace geomend
