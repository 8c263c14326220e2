// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

namespace geomend {

/// Whether this is built with the address sanitiser, whose shadow takes terabytes of addresses: no limit of memory holds then.
/// GCC says so by one name, clang of that age by another.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool with_address_sanitiser = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool with_address_sanitiser = true;
#else
constexpr bool with_address_sanitiser = false;
#endif
#else
constexpr bool with_address_sanitiser = false;
#endif

}  // namespace geomend
